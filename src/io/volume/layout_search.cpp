#include "io/volume/layout_search.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bruma::io {
namespace {

constexpr std::int64_t longest_edge = 1 << 16;
constexpr double deepest_valley = 0.7;    ///< a factor of two: what is deeper tells no more than that
constexpr double roughness_floor = 1e-3;  ///< keeps constant data from an infinite score: usual sizes then lead

/// How unusual an edge length is; 0 for powers of two.
double edge_penalty(int edge) {
    if ((edge & (edge - 1)) == 0) {
        return 0.0;
    }
    return edge % 64 == 0 ? 0.03 : edge % 8 == 0 ? 0.06 : edge % 2 == 0 ? 0.1 : 0.13;
}

/// How unusual a size is, in the unit of the score (natural logarithm of the roughness). The weights only order what
/// smoothness leaves nearly even: factors of two in the roughness outweigh all of them but extreme shapes.
double size_penalty(glm::ivec3 size) {
    const int longest = std::max({size.x, size.y, size.z});
    const int shortest = std::min({size.x, size.y, size.z});
    double penalty = edge_penalty(size.x) + edge_penalty(size.y) + edge_penalty(size.z);
    penalty += 0.08 * std::log2(double(longest) / shortest);
    if (size.x == size.y && size.y == size.z) {
        penalty -= 0.1;
    } else if (size.x != size.y) {
        // Scanners make square slices; odd slices are mostly cropped ones.
        penalty += 0.2;
    }
    return shortest < 4 ? penalty + 2.0 : penalty;
}

std::vector<std::int64_t> divisors(std::int64_t n) {
    std::vector<std::int64_t> found;
    for (std::int64_t d = 1; d * d <= n; ++d) {
        if (n % d == 0) {
            found.push_back(d);
            if (d != n / d) {
                found.push_back(n / d);
            }
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

/// How much of a valley the roughness is after `edge` steps, in an eighth of the way to both sides.
double valley_score(SampleRoughness& roughness, std::int64_t step, std::int64_t edge) {
    const double valley = roughness.valley(step * edge, step * std::max<std::int64_t>(1, edge / 8));
    return std::clamp(valley, -deepest_valley, deepest_valley);
}

double mean_roughness(SampleRoughness& roughness, glm::ivec3 size) {
    const std::array<std::int64_t, 3> lags{1, size.x, std::int64_t(size.x) * size.y};
    double sum = 0.0;
    int axes = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (size[axis] > 1) {
            sum += roughness.at_lag(lags[std::size_t(axis)]);
            ++axes;
        }
    }
    return axes > 0 ? sum / axes : 0.0;
}

/// The score without the valley of the slices, which costs the most to find; false when it cannot get below `bound`.
bool judge_rows(SampleRoughness& roughness, glm::ivec3 size, double bound, SizeGuess& guess) {
    guess = {size, mean_roughness(roughness, size), 0.0};
    guess.score = std::log(guess.roughness + roughness_floor) + size_penalty(size);
    guess.score += size.y * size.z > 1 ? valley_score(roughness, 1, size.x) : 0.0;
    return guess.score - deepest_valley <= bound;
}

/// The least score that any size with rows of `x` samples can have.
double least_score(SampleRoughness& roughness, std::int64_t x) {
    // As if slices were all alike, and the size the most usual one.
    const double mean = (roughness.at_lag(1) + roughness.at_lag(x)) / 3.0;
    return std::log(mean + roughness_floor) + valley_score(roughness, 1, x) + edge_penalty(int(x)) - 0.1 -
           deepest_valley;
}

}  // namespace

SizeGuess judge_size(SampleRoughness& roughness, glm::ivec3 size) {
    SizeGuess guess;
    judge_rows(roughness, size, 0.0, guess);
    guess.score += size.z > 1 ? valley_score(roughness, size.x, size.y) : 0.0;
    return guess;
}

std::vector<SizeGuess> guess_sizes(SampleRoughness& roughness, std::int64_t count, double bound, double of_interest) {
    const std::vector<std::int64_t> lengths = divisors(count);
    std::vector<std::pair<double, std::int64_t>> rows;
    for (const std::int64_t x : lengths) {
        if (x <= longest_edge) {
            rows.emplace_back(x > 1 && x < count ? least_score(roughness, x) : -1e9, x);
        }
    }
    // The likeliest first, so that the bound falls early.
    std::sort(rows.begin(), rows.end());
    std::vector<SizeGuess> guesses;
    for (const auto& [least, x] : rows) {
        if (least > bound) {
            break;
        }
        for (const std::int64_t y : lengths) {
            if (y > longest_edge || (count / x) % y != 0 || count / x / y > longest_edge) {
                continue;
            }
            const glm::ivec3 size(x, y, count / x / y);
            SizeGuess guess;
            if (judge_rows(roughness, size, bound, guess)) {
                guess.score += size.z > 1 ? valley_score(roughness, size.x, size.y) : 0.0;
                bound = std::min(bound, guess.score + of_interest);
                guesses.push_back(guess);
            }
        }
    }
    return guesses;
}

}  // namespace bruma::io
