#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace bruma::io {

/// A file that another file names.
struct NamedFile {
    std::filesystem::path path;  ///< empty: not found
    bool is_as_told = true;      ///< false: another folder or other capitals than told
    explicit operator bool() const { return !path.empty(); }
};

/// Where files may lie that `file` names: its folder and, where it is a symbolic link, that of what it leads to.
std::vector<std::filesystem::path> folders_beside(const std::filesystem::path& file);

/// The name as a path of this system: without quotes and `file://`, backslashes turned into slashes, or dropped before
/// blanks.
std::filesystem::path path_of_name(std::string name);

/// Finds exactly the named file in one of the folders.
NamedFile find_as_named(const std::string& name, std::span<const std::filesystem::path> folders);

/// Finds the named file or else, by whatever capitals, the longest end of its path that leads to a file: other systems
/// know no capitals, and absolute paths of another machine often end in what lies beside the file.
NamedFile find_named_file(const std::string& name, std::span<const std::filesystem::path> folders);

}  // namespace bruma::io
