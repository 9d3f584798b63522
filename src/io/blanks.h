#pragma once
#include <string_view>

/// Blanks between the words of text files, in any country's locale the same.
namespace bruma::io {

constexpr std::string_view blanks = " \t\v\f\r\n";

constexpr bool is_blank(char c, std::string_view among = blanks) {
    return among.find(c) != std::string_view::npos;
}

/// A text without the blanks at its ends.
constexpr std::string_view trimmed(std::string_view text, std::string_view without = blanks) {
    const std::size_t from = text.find_first_not_of(without);
    return from == std::string_view::npos ? std::string_view()
                                          : text.substr(from, text.find_last_not_of(without) - from + 1);
}

}  // namespace bruma::io
