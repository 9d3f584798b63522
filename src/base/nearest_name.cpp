#include "base/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace bruma {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    const std::size_t columns = b.size() + 1;
    std::vector<std::size_t> two_back(columns), previous(columns), row(columns);
    for (std::size_t j = 0; j < columns; ++j) {
        previous[j] = j;
    }
    const auto same = [](char x, char y) {
        return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
    };
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j < columns; ++j) {
            const std::size_t change = same(a[i - 1], b[j - 1]) ? 0 : 1;
            row[j] = std::min({previous[j] + 1, row[j - 1] + 1, previous[j - 1] + change});
            if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1])) {
                row[j] = std::min(row[j], two_back[j - 2] + 1);
            }
        }
        two_back.swap(previous);
        previous.swap(row);
    }
    return previous.back();
}

std::string nearest_name(std::string_view word, std::span<const std::string> candidates) {
    std::string nearest;
    std::size_t smallest = word.size() / 2 + 2;
    for (const std::string& candidate : candidates) {
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < smallest) {
            smallest = distance;
            nearest = candidate;
        }
    }
    return nearest;
}

std::string suggestion(std::string_view word, std::span<const std::string> candidates) {
    const std::string nearest = nearest_name(word, candidates);
    if (!nearest.empty()) {
        return "; did you mean '" + nearest + "'?";
    }
    if (candidates.empty()) {
        return "; none is known here";
    }
    std::string tail = "; known are ";
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        tail += (i == 0 ? "" : ", ") + candidates[i];
    }
    return tail;
}

bool same_word(std::string_view a, std::string_view b) {
    const auto plain = [](char c) { return c == '-' ? '_' : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return plain(x) == plain(y); });
}

}  // namespace bruma
