#include "io/mesh/mtl_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>

#include "io/blanks.h"

namespace bruma::io {
namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Whether commas stand for decimal points.
bool has_decimal_commas(std::string_view text) {
    bool found = false;
    std::size_t in_word = 0;
    for (std::size_t n = 0; n < text.size(); ++n) {
        if (text[n] == '.') {
            return false;
        }
        in_word = blanks.find(text[n]) != std::string_view::npos ? 0 : in_word;
        if (text[n] == ',' && n + 1 < text.size() && is_digit(text[n + 1])) {
            found = true;
            if (++in_word > 1) {
                return false;
            }
        }
    }
    return found;
}

}  // namespace

bool is_same_keyword(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::string_view without_comment(std::string_view text) {
    for (std::size_t n = 0; n < text.size(); ++n) {
        if (text[n] == '#' && (n == 0 || blanks.find(text[n - 1]) != std::string_view::npos)) {
            return trimmed(text.substr(0, n));
        }
    }
    return trimmed(text);
}

MtlText split_mtl_text(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) {
        text.remove_prefix(3);
    }
    MtlText result;
    bool is_named = false;
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::size_t length = std::min(text.find_first_of("\n\r"), text.size());
        const std::string_view line = trimmed(text.substr(0, length));
        text.remove_prefix(std::min(length + (text.substr(length, 2) == "\r\n" ? 2 : 1), text.size()));
        if (line.empty() || line.front() == '#') {
            continue;
        }
        const std::size_t end = std::min(line.find_first_of(blanks), line.size());
        const std::string_view keyword = line.substr(0, end);
        const std::string_view rest = trimmed(line.substr(end));
        if (is_same_keyword(keyword, "newmtl")) {
            is_named = !rest.empty();
            result.without_name += is_named ? 0 : 1;
            if (is_named) {
                result.materials.push_back({std::string(rest), {}});
            }
        } else if (is_named) {
            result.materials.back().statements.push_back({std::string(keyword), std::string(rest), number});
        }
    }
    return result;
}

MtlNumbers read_mtl_numbers(std::string_view text) {
    MtlNumbers result;
    result.decimal_commas = has_decimal_commas(text);
    std::string plain(text);
    std::replace(plain.begin(), plain.end(), ',', result.decimal_commas ? '.' : ' ');
    const char* at = plain.data();
    const char* const end = at + plain.size();
    while ((at = std::find_if_not(at, end, [](char c) { return is_blank(c); })) != end) {
        at += *at == '+' ? 1 : 0;
        double value = 0.0;
        const auto [after, error] = std::from_chars(at, end, value);
        if (error == std::errc::invalid_argument || (after != end && !is_blank(*after))) {
            result.complete = false;
            break;
        }
        result.values.push_back(error == std::errc() ? value : std::numeric_limits<double>::infinity());
        at = after;
    }
    return result;
}

}  // namespace bruma::io
