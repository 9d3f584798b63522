#include "scene/volume/sample_ranks.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace bruma::scene {
namespace {

constexpr std::size_t halves = 1 << 16;

/// Whole numbers in the order of the samples; +0 and -0 are one. The samples must be finite.
std::uint32_t key_of(float sample) {
    const auto bits = std::bit_cast<std::uint32_t>(sample + 0.0F);
    return (bits >> 31) != 0 ? ~bits : bits | 0x8000'0000U;
}
std::uint32_t key_of(std::integral auto sample) {
    return std::uint32_t(std::int32_t(sample) + (std::is_signed_v<decltype(sample)> ? 32768 : 0)) << 16;
}

double value_of(std::uint32_t key, VoxelType type) {
    if (type == VoxelType::float32) {
        return double(std::bit_cast<float>((key >> 31) != 0 ? key & 0x7FFF'FFFFU : ~key));
    }
    const bool has_sign = type == VoxelType::int8 || type == VoxelType::int16;
    return double(key >> 16) - (has_sign ? 32768.0 : 0.0);
}

std::uint32_t key_of_value(double value, VoxelType type) {
    if (type == VoxelType::float32) {
        return key_of(float(value));
    }
    const bool has_sign = type == VoxelType::int8 || type == VoxelType::int16;
    return has_sign ? key_of(std::int16_t(value)) : key_of(std::uint16_t(value));
}

/// Calls `add(counts, key)` for every finite sample.
template <class Counts, class Add>
Counts count_keys(const VolumeGrid& grid, std::size_t size, const Add& add) {
    return visit_voxels(grid, [&](auto samples) {
        const std::size_t grain = std::max<std::size_t>(std::size_t(1) << 20, samples.size() / 64);
        return tbb::parallel_reduce(
            tbb::blocked_range<std::size_t>(0, samples.size(), grain), Counts(size, 0),
            [&](const auto& part, Counts counts) {
                for (std::size_t n = part.begin(); n != part.end(); ++n) {
                    if (std::isfinite(double(samples[n]))) {
                        add(counts, key_of(samples[n]));
                    }
                }
                return counts;
            },
            [](Counts a, const Counts& b) {
                for (std::size_t n = 0; n < a.size(); ++n) {
                    a[n] += b[n];
                }
                return a;
            });
    });
}

}  // namespace

SampleRanks::SampleRanks(const VolumeGrid& grid) : grid_(&grid) {
    upper_ = count_keys<Counts>(grid, halves, [](Counts& counts, std::uint32_t key) { ++counts[key >> 16]; });
    for (const std::uint64_t n : upper_) {
        count_ += n;
    }
    nonfinite_ = grid.voxel_count() - count_;
}

const SampleRanks::Counts& SampleRanks::lower_half(std::uint32_t upper) {
    if (const auto found = lower_.find(upper); found != lower_.end()) {
        return found->second;
    }
    Counts counts;
    if (grid_->type == VoxelType::float32) {
        counts = count_keys<Counts>(*grid_, halves, [upper](Counts& lower, std::uint32_t key) {
            if (key >> 16 == upper) {
                ++lower[key & 0xFFFFU];
            }
        });
        for (const std::uint32_t key : left_out_) {
            if (key >> 16 == upper) {
                counts[key & 0xFFFFU] = 0;
            }
        }
    } else {
        counts = {upper_[upper]};
    }
    return lower_.emplace(upper, std::move(counts)).first->second;
}

std::optional<SampleRanks::Value> SampleRanks::first_from(std::uint64_t key) {
    std::size_t low = key & 0xFFFFU;
    for (std::size_t upper = key >> 16; upper < halves; ++upper, low = 0) {
        if (upper_[upper] == 0) {
            continue;
        }
        const Counts& lower = lower_half(std::uint32_t(upper));
        for (; low < lower.size(); ++low) {
            if (lower[low] > 0) {
                return Value{value_of(std::uint32_t(upper << 16 | low), grid_->type), lower[low]};
            }
        }
    }
    return std::nullopt;
}

std::optional<SampleRanks::Value> SampleRanks::last_until(std::int64_t key) {
    for (std::int64_t upper = key >> 16, low = key & 0xFFFF; upper >= 0; --upper, low = 0xFFFF) {
        if (upper_[std::size_t(upper)] == 0) {
            continue;
        }
        const Counts& lower = lower_half(std::uint32_t(upper));
        for (auto n = std::min(low, std::int64_t(lower.size()) - 1); n >= 0; --n) {
            if (lower[std::size_t(n)] > 0) {
                return Value{value_of(std::uint32_t(upper << 16 | n), grid_->type), lower[std::size_t(n)]};
            }
        }
    }
    return std::nullopt;
}

std::optional<SampleRanks::Value> SampleRanks::smallest() {
    return first_from(0);
}

std::optional<SampleRanks::Value> SampleRanks::largest() {
    return last_until(0xFFFF'FFFF);
}

std::optional<SampleRanks::Value> SampleRanks::next_above(double value) {
    return first_from(std::uint64_t(key_of_value(value, grid_->type)) + 1);
}

std::optional<SampleRanks::Value> SampleRanks::next_below(double value) {
    return last_until(std::int64_t(key_of_value(value, grid_->type)) - 1);
}

double SampleRanks::at_rank(std::uint64_t rank) {
    std::uint64_t before = 0;
    std::size_t upper = 0;
    while (upper + 1 < halves && before + upper_[upper] < rank) {
        before += upper_[upper++];
    }
    const Counts& lower = lower_half(std::uint32_t(upper));
    std::size_t low = 0;
    while (low + 1 < lower.size() && before + lower[low] < rank) {
        before += lower[low++];
    }
    return value_of(std::uint32_t(upper << 16 | low), grid_->type);
}

std::vector<double> SampleRanks::beyond(double value, bool above) const {
    std::vector<double> found;
    visit_voxels(*grid_, [&](auto samples) {
        for (const auto sample : samples) {
            const auto number = double(sample);
            if (std::isfinite(number) && (above ? number > value : number < value) &&
                std::find(left_out_.begin(), left_out_.end(), key_of(sample)) == left_out_.end()) {
                found.push_back(number);
            }
        }
    });
    std::sort(found.begin(), found.end());
    if (!above) {
        std::reverse(found.begin(), found.end());
    }
    return found;
}

std::vector<double> SampleRanks::above(double value) const {
    return beyond(value, true);
}

std::vector<double> SampleRanks::below(double value) const {
    return beyond(value, false);
}

void SampleRanks::leave_out(double value) {
    const std::uint32_t key = key_of_value(value, grid_->type);
    lower_half(key >> 16);
    std::uint64_t& counted = lower_.at(key >> 16)[grid_->type == VoxelType::float32 ? key & 0xFFFFU : 0];
    upper_[key >> 16] -= counted;
    count_ -= counted;
    counted = 0;
    left_out_.push_back(key);
}

}  // namespace bruma::scene
