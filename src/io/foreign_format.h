#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace bruma::io {

/// A format of other programs that is not read here.
struct ForeignFormat {
    std::string name;     ///< with its article: "an OpenVDB grid"
    std::string way_out;  ///< what to do, as the end of a sentence
};

/// The format of a file by its content, whatever its name: volumes, meshes, pictures, archives, and what stands where a
/// download went wrong. Nothing for what is not known, for empty files and for those that cannot be read.
std::optional<ForeignFormat> foreign_format(const std::filesystem::path& path);

/// Throws InputError with the format's name and the way out if the content is of a known one.
void refuse_foreign_format(const std::filesystem::path& path);

}  // namespace bruma::io
