#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/obj_colors.h"
#include "io/mesh/obj_statements.h"

namespace bruma::io {

/// The text of an OBJ file, and what the parser behind it would pass over in silence.
struct ObjText {
    std::string text;  ///< continued lines joined
    /// Ordinals, from 0, of the `v` lines that are not three or more finite numbers; in order.
    std::vector<std::size_t> broken_vertices;
    std::vector<std::size_t> broken_normals;      ///< the same of `vn`
    std::vector<std::size_t> broken_coordinates;  ///< the same of `vt`, one or more numbers
    std::vector<std::string> material_libraries;  ///< what stands behind each `mtllib`, as written
    ObjColors colors;                             ///< of `v` lines
    ObjStatements others;                         ///< what is passed over
    double unit_mm = 0.0;                         ///< from a comment at the head of the file; 0: it tells none
};

/// Reads a file. Throws InputError when it cannot be read, is no text, or would not fit into memory.
ObjText read_obj_text(const std::filesystem::path& path);

/// The number, from 1, of the line that holds statement `ordinal` (from 0) with this keyword; 0 when there is none.
std::size_t line_of_statement(std::string_view text, std::string_view keyword, std::size_t ordinal);

}  // namespace bruma::io
