#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/progress.h"

namespace bruma::io {

/// What an ASCII triangle file holds: one triangle a line as nine numbers (three corners), the other meaning of '.raw'.
struct AsciiTriangles {
    std::int64_t count = 0;           ///< triangles in good lines
    glm::dvec3 low{0.0}, high{0.0};   ///< box around all corners, in the file's own unit
    std::int64_t first_bad_line = 0;  ///< counted from 1; 0 when every line is good
    std::string first_bad_text;       ///< at most 60 characters of that line
    std::vector<glm::dvec3> corners;  ///< three for each triangle, one after the other
};

/// Reads the file if it is text whose first line that is neither blank nor a comment (#) has exactly nine numbers;
/// otherwise nothing, after reading a few kilobytes. Blank lines, comments and CRLF are tolerated.
/// Throws InputError only when the file cannot be opened or read; what `progress` throws passes through.
std::optional<AsciiTriangles> read_ascii_triangles(const std::filesystem::path& path, const Progress& progress = {});

/// Whether `read_ascii_triangles` would find any; mostly known after four kilobytes.
bool holds_ascii_triangles(const std::filesystem::path& path);

}  // namespace bruma::io
