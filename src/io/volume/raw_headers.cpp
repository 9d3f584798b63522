#include "io/volume/raw_headers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace bruma::io {
namespace {

constexpr std::int64_t longest_header = 65536;

/// Lengths that formats with a fixed header have (NIfTI 352, Analyze and NIfTI pairs 348, MRC 1024, ...) and powers of
/// two to which writers pad; the usual ones first.
constexpr std::array<std::int64_t, 22> usual_lengths{128, 256, 352, 512, 1024, 2048, 4096, 8192, 348,  1536,  3072,
                                                     6,   12,  16,  32,  64,   80,   192,  768,  1000, 16384, 65536};
constexpr std::size_t most_usual = 5;

double offset_penalty(std::int64_t offset) {
    if (offset == 0) {
        return 0.0;
    }
    const auto* const found = std::find(usual_lengths.begin(), usual_lengths.end(), offset);
    return found < usual_lengths.begin() + most_usual ? 0.5 : 0.7;
}

template <class Word>
std::int64_t word_at(const std::byte* at, bool swap) {
    Word word{};
    std::memcpy(&word, at, sizeof word);
    if (swap) {
        word = sizeof word == 2 ? Word(__builtin_bswap16(std::uint16_t(word))) : Word(__builtin_bswap32(word));
    }
    return std::int64_t(word);
}

/// Sizes that stand in the file's first bytes and fit its length.
template <class Word>
void add_described(std::span<const std::byte> bytes, std::int64_t width, bool swap, std::vector<HeaderGuess>& guesses) {
    constexpr std::size_t searched = 1024;
    constexpr std::int64_t longest_edge = 1 << 16;
    const auto length = std::int64_t(bytes.size());
    for (std::size_t at = 0; at + 3 * sizeof(Word) <= std::min(searched, bytes.size()); at += 2) {
        std::array<std::int64_t, 3> edges{};
        for (std::size_t n = 0; n < 3; ++n) {
            edges[n] = word_at<Word>(bytes.data() + at + n * sizeof(Word), swap);
        }
        if (std::any_of(edges.begin(), edges.end(), [](std::int64_t e) { return e < 2 || e > longest_edge; })) {
            continue;
        }
        const std::int64_t left = length - edges[0] * edges[1] * edges[2] * width;
        if (left >= std::int64_t(at + 3 * sizeof(Word)) && left <= longest_header) {
            constexpr double likely = -0.3;  // three numbers seldom fit by chance, but in small files they do
            guesses.push_back({left, glm::ivec3(edges[0], edges[1], edges[2]), likely});
        }
    }
}

}  // namespace

std::vector<HeaderGuess> guess_headers(std::span<const std::byte> bytes, const scene::VolumeSource& hints,
                                       std::int64_t width) {
    const auto length = std::int64_t(bytes.size());
    std::vector<HeaderGuess> guesses;
    if (hints.offset || hints.size) {
        std::int64_t offset = hints.offset.value_or(0);
        if (hints.size) {
            const std::int64_t needed = std::int64_t(hints.size->x) * hints.size->y * hints.size->z * width;
            offset = hints.offset.value_or(length - needed);
            if (length - offset != needed) {
                return {};
            }
        }
        guesses.push_back({offset, hints.size, offset_penalty(offset)});
    } else {
        guesses.push_back({});
        for (const bool swap : {false, true}) {
            add_described<std::uint16_t>(bytes, width, swap, guesses);
            add_described<std::uint32_t>(bytes, width, swap, guesses);
        }
        for (const std::int64_t offset : usual_lengths) {
            guesses.push_back({offset, {}, offset_penalty(offset)});
        }
        for (const std::int64_t edge : {32, 64, 128, 256, 512, 1024}) {
            const std::int64_t left = length - edge * edge * edge * width;
            if (left > 0 && left <= longest_header) {
                guesses.push_back({left, {}, offset_penalty(left)});
            }
        }
    }
    std::erase_if(guesses, [&](const HeaderGuess& guess) {
        const bool mostly_header = guess.offset > length / 4 && !hints.offset && !hints.size;
        return mostly_header || guess.offset < 0 || guess.offset >= length || (length - guess.offset) % width != 0;
    });
    return guesses;
}

}  // namespace bruma::io
