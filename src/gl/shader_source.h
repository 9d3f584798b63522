#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace bruma::gl {

/// Preprocessor definitions by name, in the order of names, so that equal sets are equal.
using Defines = std::map<std::string, std::string>;

/// GLSL text with its includes in place. `files[n]` is the file that `#line ... n` speaks of.
struct ShaderSource {
    std::string text;
    std::vector<std::filesystem::path> files;
};

/// Reads a shader and replaces each `#include "path"` (relative to `root`) by that file, once per shader, with #line
/// directives around it; puts the definitions behind the #version line. Throws InputError naming file and line.
ShaderSource read_shader(const std::filesystem::path& root, const std::string& file, const Defines& defines);

/// A driver's compile log with its "source:line" places turned into "file:line".
std::string map_compile_log(const std::string& log, const std::vector<std::filesystem::path>& files);

}  // namespace bruma::gl
