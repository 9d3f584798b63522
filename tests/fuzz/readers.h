#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace bruma::fuzz {

/// One way by which files come in.
struct Reader {
    std::string name;
    std::vector<std::string> sound;       ///< small inputs that are read without complaint
    std::vector<std::string> dictionary;  ///< words that matter to it
    /// Writes the input below an empty folder of its own, as the files that it stands for, and reads it. May throw
    /// bruma::Error and nothing else.
    std::function<void(const std::string& input, const std::filesystem::path& folder)> read;
};

/// All readers: scenes, settings, sidecars, curves, headerless volumes and their names, meshes and pictures.
std::vector<Reader> all_readers();
/// Readers of text, and of pictures; parts of the above.
std::vector<Reader> text_readers();
std::vector<Reader> picture_readers();
/// Readers with a fault each, of every sort that a run must find: the end of an array left, undefined arithmetic, a
/// pointer to nowhere, an exception of another kind, an endless loop and memory without measure.
std::vector<Reader> planted_readers();

/// Writes a file below `folder` and gives its path.
std::filesystem::path put(const std::filesystem::path& folder, const std::string& name, const std::string& content);
/// Calls each of `ways` to read the same input; that one refuses does not keep the next from trying.
void each(const std::vector<std::function<void()>>& ways);

}  // namespace bruma::fuzz
