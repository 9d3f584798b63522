#include "scene/volume/robust_window.h"

#include <algorithm>
#include <cmath>

namespace bruma::scene {
namespace {

/// Ends of the types, and the numbers that scanners, geographic data and simulations write for 'nothing here'; the
/// fourth from the end is netCDF's default for floats.
constexpr std::array known_fills{-32768.0, 32767.0,  -2147483648.0, 2147483647.0, 65535.0,      -999.0,
                                 -9999.0,  -99999.0, 1e20,          -1e20,        1e30,         -1e30,
                                 1e34,     -1e34,    9.96921e36,    -9.96921e36,  3.4028235e38, -3.4028235e38};

bool is_known_fill(double value) {
    return std::any_of(known_fills.begin(), known_fills.end(),
                       [value](double known) { return std::abs(value - known) <= 1e-6 * std::abs(known); });
}

std::uint64_t lower_rank(std::uint64_t count) {
    return (count + 999) / 1000;
}
std::uint64_t upper_rank(std::uint64_t count) {
    return (999 * count + 999) / 1000;
}

bool has_four_values(SampleRanks& ranks) {
    auto value = ranks.smallest();
    for (int n = 1; n < 4 && value; ++n) {
        value = ranks.next_above(value->value);
    }
    return value.has_value();
}

/// Whether the value at an end is a fill; `rank_shift`: how many samples of it lie before the others.
bool is_fill(SampleRanks& ranks, const SampleRanks::Value& end, double neighbour, std::uint64_t rank_shift) {
    const std::uint64_t others = ranks.count() - end.count;
    const double spread =
        ranks.at_rank(rank_shift + upper_rank(others)) - ranks.at_rank(rank_shift + lower_rank(others));
    const double gap = std::abs(end.value - neighbour);
    const bool frequent = 100 * end.count >= ranks.count();
    return (is_known_fill(end.value) && gap > spread) || (frequent && gap > 10.0 * spread);
}

bool leave_out_an_end(SampleRanks& ranks, bool lower, std::vector<FillValue>& fills) {
    const auto end = lower ? ranks.smallest() : ranks.largest();
    const auto neighbour = !end ? end : lower ? ranks.next_above(end->value) : ranks.next_below(end->value);
    if (!neighbour || !is_fill(ranks, *end, neighbour->value, lower ? end->count : 0)) {
        return false;
    }
    fills.push_back({end->value, end->count});
    ranks.leave_out(end->value);
    return true;
}

/// The last of some values that can be reached from `from` without a gap wider than `widest_gap`.
double reachable(double from, const std::vector<double>& values, double widest_gap) {
    for (const double value : values) {
        if (std::abs(value - from) > widest_gap) {
            break;
        }
        from = value;
    }
    return from;
}

}  // namespace

RobustWindow robust_window(SampleRanks& ranks, Fills fills) {
    constexpr int most_turns = 4;
    constexpr std::uint64_t least_samples = 1000;
    RobustWindow result;
    if (fills == Fills::left_out && !ranks.is_of_bytes() && ranks.count() >= least_samples && has_four_values(ranks)) {
        for (int turn = 0; turn < most_turns; ++turn) {
            const bool lower = leave_out_an_end(ranks, true, result.fills);
            const bool upper = leave_out_an_end(ranks, false, result.fills);
            if (!lower && !upper) {
                break;
            }
        }
    }
    const auto smallest = ranks.smallest();
    if (!smallest) {
        return result;
    }
    result.smallest = smallest->value;
    result.largest = ranks.largest()->value;
    result.core = {result.smallest, result.largest};
    result.window = {ranks.at_rank(lower_rank(ranks.count())), ranks.at_rank(upper_rank(ranks.count()))};
    const double spread = result.window[1] - result.window[0];
    if (spread > 0.0) {
        if (!ranks.is_of_bytes() && result.largest - result.window[1] > spread) {
            result.core[1] = reachable(result.window[1], ranks.above(result.window[1]), spread);
        }
        if (!ranks.is_of_bytes() && result.window[0] - result.smallest > spread) {
            result.core[0] = reachable(result.window[0], ranks.below(result.window[0]), spread);
        }
    } else if (result.largest > result.smallest) {
        result.window = result.core;
    } else {
        result.window = {result.smallest - 0.5, result.smallest + 0.5};
    }
    return result;
}

}  // namespace bruma::scene
