#pragma once
#include <span>
#include <string>
#include <string_view>

namespace bruma {

/// Letters to add, drop, change or swap with a neighbour to turn one word into the other; case does not count.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate with the smallest edit distance to `word` (Damerau, transpositions count one), or an empty string
/// when none is closer than about half the word.
std::string nearest_name(std::string_view word, std::span<const std::string> candidates);

/// "; did you mean 'X'?" or "; known are A, B, C" — the tail of every 'unknown name' message.
std::string suggestion(std::string_view word, std::span<const std::string> candidates);

/// Whether two words are the same when '-' and '_' are: people write blue-noise and blue_noise.
bool same_word(std::string_view a, std::string_view b);

}  // namespace bruma
