#include "io/mesh/obj_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/memory.h"
#include "io/blanks.h"
#include "io/input_file.h"
#include "scene/mesh/mesh_unit.h"

namespace bruma::io {
namespace {

/// Takes one line off the text. Lines end in LF, CR LF or CR.
std::string_view take_line(std::string_view& text) {
    const std::size_t length = std::min(text.find_first_of("\n\r"), text.size());
    const std::string_view line = text.substr(0, length);
    const bool is_pair = text.substr(length, 2) == "\r\n";
    text.remove_prefix(std::min(length + (is_pair ? 2 : 1), text.size()));
    return line;
}

/// What stands behind a keyword; nothing when the line begins otherwise.
bool begins_with(std::string_view line, std::string_view keyword, std::string_view& rest) {
    line = trimmed(line);
    if (!line.starts_with(keyword) || line.size() == keyword.size() || !is_blank(line[keyword.size()])) {
        return false;
    }
    rest = line.substr(keyword.size());
    return true;
}

/// Whether the text begins with this many finite numbers.
bool has_numbers(std::string_view text, int count) {
    const char* at = text.data();
    const char* const end = at + text.size();
    for (int n = 0; n < count; ++n) {
        while (at != end && is_blank(*at)) {
            ++at;
        }
        at += at != end && *at == '+' ? 1 : 0;
        double number = 0.0;
        const auto [after, error] = std::from_chars(at, end, number);
        // What is too large for a double becomes infinite in the parser, and is found out there.
        if (error == std::errc::invalid_argument || !std::isfinite(number) || (after != end && !is_blank(*after))) {
            return false;
        }
        at = after;
    }
    return true;
}

/// Numbers beyond what the parser's integers hold would come back as others: they become 0, which names nothing.
void clear_huge_indices(char* from, char* const to) {
    constexpr std::ptrdiff_t most_digits = 9;
    const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
    while ((from = std::find_if(from, to, is_digit)) != to) {
        char* const end = std::find_if_not(from, to, is_digit);
        if (end - from > most_digits) {
            std::fill(from, end, '0');
        }
        from = end;
    }
}

/// A backslash at the end of a line continues it: the two are blanked out, which leaves all else where it is.
void join_continued_lines(std::string& text) {
    for (std::size_t at = text.find('\\'); at != std::string::npos; at = text.find('\\', at + 1)) {
        const std::size_t end = text.find_first_not_of(" \t", at + 1);
        if (end != std::string::npos && (text[end] == '\n' || text[end] == '\r')) {
            const std::size_t next = text.compare(end, 2, "\r\n") == 0 ? end + 2 : end + 1;
            std::fill(text.begin() + std::ptrdiff_t(at), text.begin() + std::ptrdiff_t(next), ' ');
        }
    }
}

}  // namespace

ObjText read_obj_text(const std::filesystem::path& path) {
    // Text, lists and finished mesh together: 8.3 was measured on a bare grid of 980 000 triangles.
    constexpr std::int64_t memory_per_byte = 10;
    ObjText obj;
    obj.text = read_text_file(path, std::int64_t(available_memory() / memory_per_byte));
    if (obj.text.find('\0') != std::string::npos) {
        throw InputError(
            fmt::format("{}: holds zero bytes and is no text; is it a Wavefront OBJ file?", path.string()));
    }
    if (obj.text.starts_with("\xef\xbb\xbf")) {
        obj.text.replace(0, 3, "   ");  // a byte order mark would hide the first statement
    }
    join_continued_lines(obj.text);
    obj.unit_mm = scene::commented_unit_mm(std::string_view(obj.text).substr(0, 4096));
    std::size_t vertices = 0;
    std::size_t normals = 0;
    std::size_t coordinates = 0;
    const auto note = [](bool good, std::size_t& ordinal, std::vector<std::size_t>& broken) {
        if (!good) {
            broken.push_back(ordinal);
        }
        ++ordinal;
    };
    for (std::string_view left = obj.text; !left.empty();) {
        const std::string_view line = take_line(left);
        std::string_view rest;
        if (begins_with(line, "v", rest)) {
            obj.colors.add(vertices, rest);
            note(has_numbers(rest, 3), vertices, obj.broken_vertices);
        } else if (begins_with(line, "vn", rest)) {
            note(has_numbers(rest, 3), normals, obj.broken_normals);
        } else if (begins_with(line, "vt", rest)) {
            note(has_numbers(rest, 1), coordinates, obj.broken_coordinates);
        } else if (begins_with(line, "mtllib", rest)) {
            obj.material_libraries.emplace_back(trimmed(rest));
        } else if (begins_with(line, "f", rest)) {
            char* const from = obj.text.data() + (rest.data() - obj.text.data());
            char* const to = from + rest.size();
            // The parser would take the words of a comment for corners.
            std::fill(std::find(from, to, '#'), to, ' ');
            clear_huge_indices(from, to);
        } else if (!begins_with(line, "usemtl", rest)) {
            obj.others.add(line);
        }
    }
    return obj;
}

std::size_t line_of_statement(std::string_view text, std::string_view keyword, std::size_t ordinal) {
    std::size_t number = 0;
    while (!text.empty()) {
        ++number;
        std::string_view rest;
        if (begins_with(take_line(text), keyword, rest) && ordinal-- == 0) {
            return number;
        }
    }
    return 0;
}

}  // namespace bruma::io
