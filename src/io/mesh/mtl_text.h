#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace bruma::io {

/// One line of a material.
struct MtlStatement {
    std::string keyword;    ///< as written
    std::string arguments;  ///< all that stands behind it, a comment included, without blanks around it
    std::size_t line = 0;   ///< counted from 1
};

/// A material of a library (.mtl), not yet understood.
struct MtlEntry {
    std::string name;
    std::vector<MtlStatement> statements;
};

/// A material library in its materials.
struct MtlText {
    std::vector<MtlEntry> materials;
    std::size_t without_name = 0;  ///< materials that `newmtl` gives no name: left out
};

/// Parts a library at its `newmtl` lines. Lines end in LF, CR LF or CR; a byte order mark, comment lines and blanks
/// around everything are passed over.
MtlText split_mtl_text(std::string_view text);

/// Whether two keywords are the same: programs disagree on capitals ("map_Kd", "map_kd", "Map_Kd").
bool is_same_keyword(std::string_view a, std::string_view b);

/// The text up to a comment: `#` at its beginning or behind a blank. Blanks around it are cut off.
std::string_view without_comment(std::string_view text);

/// Numbers of a statement.
struct MtlNumbers {
    std::vector<double> values;  ///< those before the first word that is no number; may be infinite or no number
    bool decimal_commas = false;
    bool complete = true;  ///< whether there was nothing else
};

/// Reads all numbers of a text. A comma between digits is a decimal comma, unless a word has several or a point stands
/// somewhere in the text: then commas part numbers.
MtlNumbers read_mtl_numbers(std::string_view text);

}  // namespace bruma::io
