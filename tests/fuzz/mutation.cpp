#include "mutation.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace bruma::fuzz {
namespace {

using namespace std::string_view_literals;

constexpr std::array extreme_texts{"0"sv,
                                   "-1"sv,
                                   "1"sv,
                                   "2147483647"sv,
                                   "-2147483648"sv,
                                   "4294967296"sv,
                                   "9223372036854775807"sv,
                                   "18446744073709551616"sv,
                                   "1e308"sv,
                                   "-1e308"sv,
                                   "1e-320"sv,
                                   "1e999999"sv,
                                   "nan"sv,
                                   "-inf"sv,
                                   "0x7fffffff"sv,
                                   "0.5"sv,
                                   "65536"sv,
                                   ""sv,
                                   "1,5"sv,
                                   "00000000000000000000000000000000000000001"sv};
constexpr std::array<std::uint64_t, 14> extreme_numbers{0,
                                                        1,
                                                        0x7F,
                                                        0x80,
                                                        0xFF,
                                                        0x7FFF,
                                                        0x8000,
                                                        0xFFFF,
                                                        0x10000,
                                                        0x7FFFFFFF,
                                                        0x80000000,
                                                        0xFFFFFFFF,
                                                        0x7FFFFFFFFFFFFFFF,
                                                        0xFFFFFFFFFFFFFFFF};

struct Piece {
    std::size_t begin, length;
};
/// Mostly short ones.
Piece piece_of(const std::string& text, Random& random) {
    const std::size_t begin = random.below(text.size() + 1);
    const std::size_t longest = random.below(4) == 0 ? text.size() : std::min<std::size_t>(text.size(), 32);
    return {begin, std::min(text.size() - begin, random.below(longest + 1))};
}

void write_number(std::string& text, Random& random) {
    const std::size_t width = std::size_t(1) << random.below(4);
    const std::uint64_t near = random.below(3);
    const std::uint64_t number = extreme_numbers[random.below(extreme_numbers.size())] + near - 1;
    const bool is_little = random.below(2) == 0;
    const std::size_t at = random.below(text.size());
    for (std::size_t n = 0; n < width && at + n < text.size(); ++n) {
        text[at + n] = char(number >> 8 * (is_little ? n : width - 1 - n));
    }
}

bool is_of_number(char c) {
    return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+';
}

void replace_decimal(std::string& text, Random& random) {
    const std::size_t from = random.below(text.size());
    const auto begin = std::find_if(text.begin() + std::ptrdiff_t(from), text.end(), is_of_number);
    const auto end = std::find_if_not(begin, text.end(), is_of_number);
    const std::string_view extreme = extreme_texts[random.below(extreme_texts.size())];
    text.replace(begin, end, extreme.begin(), extreme.end());
}

/// What stands between two delimiters of text becomes a number, a word or what stands so elsewhere: the syntax remains.
void replace_token(std::string& text, const std::string& other, std::span<const std::string> dictionary,
                   Random& random) {
    constexpr std::string_view delimiters = ",:;[]{}=/ \t\r\n";
    const auto token_of = [&](const std::string& from) {
        const std::size_t before = from.find_last_of(delimiters, random.below(from.size()));
        const std::size_t begin = before == std::string::npos ? 0 : before + 1;
        return Piece{begin, std::min(from.size(), from.find_first_of(delimiters, begin)) - begin};
    };
    const Piece token = token_of(text);
    const std::size_t sort = random.below(3);
    if (sort == 0 && !dictionary.empty()) {
        text.replace(token.begin, token.length, dictionary[random.below(dictionary.size())]);
    } else if (sort == 1) {
        const Piece taken = token_of(other);
        text.replace(token.begin, token.length, other, taken.begin, taken.length);
    } else {
        text.replace(token.begin, token.length, extreme_texts[random.below(extreme_texts.size())]);
    }
}

void swap_pieces(std::string& text, Random& random) {
    const Piece a = piece_of(text, random);
    const std::string moved = text.substr(a.begin, a.length);
    text.erase(a.begin, a.length);
    text.insert(random.below(text.size() + 1), moved);
}

void change(std::string& text, const std::string& other, std::span<const std::string> dictionary, Random& random) {
    const std::size_t at = random.below(text.size());
    const Piece piece = piece_of(text, random);
    switch (text.empty() ? 7 : random.below(15)) {
        case 0:
            text[at] = char(text[at] ^ 1 << random.below(8));
            break;
        case 1:
            text[at] = char(random.next());
            break;
        case 2:
            text.resize(at);
            break;
        case 3:
            text.erase(piece.begin, piece.length);
            break;
        case 4: {
            const std::string copy = text.substr(piece.begin, piece.length);
            for (std::size_t n = random.below(random.below(8) == 0 ? 300 : 3) + 1; n > 0; --n) {
                text.insert(piece.begin, copy);
                if (text.size() > most_input_bytes) {
                    break;
                }
            }
            break;
        }
        case 5:
            swap_pieces(text, random);
            break;
        case 6:
        case 8:
            write_number(text, random);
            break;
        case 9:
            replace_decimal(text, random);
            break;
        case 10: {
            const Piece taken = piece_of(other, random);
            text.replace(piece.begin, random.below(2) * piece.length, other, taken.begin, taken.length);
            break;
        }
        case 11:
            for (std::size_t n = at; n < std::min(text.size(), at + 4); ++n) {
                text[n] = char(random.next());
            }
            break;
        case 12:
        case 13:
        case 14:
            replace_token(text, other, dictionary, random);
            break;
        default:
            if (!dictionary.empty()) {
                const std::string& word = dictionary[random.below(dictionary.size())];
                text.replace(piece.begin, random.below(2) * piece.length, word);
            }
    }
}

}  // namespace

std::string mutated(std::string input, const std::string& other, std::span<const std::string> dictionary,
                    Random& random) {
    // Half of the inputs have one change: what is nearly sound comes furthest.
    constexpr std::size_t most_changes = 6;
    for (std::size_t n = random.below(2) == 0 ? 1 : random.below(most_changes) + 1; n > 0; --n) {
        change(input, other, dictionary, random);
        input.resize(std::min(input.size(), most_input_bytes));
    }
    return input;
}

}  // namespace bruma::fuzz
