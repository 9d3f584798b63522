#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "scene/volume/volume_grid.h"

namespace bruma::scene {

/// The finite samples of a grid in order of size, exactly, without sorting them: counts by the upper half of a sample's
/// bits, and by the lower half where a question needs it (one look at all samples for each such upper half). The grid
/// must outlive it.
class SampleRanks {
  public:
    explicit SampleRanks(const VolumeGrid& grid);

    std::uint64_t count() const { return count_; }  ///< finite samples that were not left out
    std::uint64_t nonfinite() const { return nonfinite_; }
    bool is_of_bytes() const { return bytes_per_voxel(grid_->type) == 1; }

    struct Value {
        double value = 0.0;
        std::uint64_t count = 0;
    };
    /// The smallest and the largest value and the next ones to a value; empty where there is none.
    std::optional<Value> smallest();
    std::optional<Value> largest();
    std::optional<Value> next_above(double value);
    std::optional<Value> next_below(double value);
    /// The sample that has rank - 1 others before it; `rank` from 1 to count().
    double at_rank(std::uint64_t rank);
    /// All samples beyond a value, nearest to it first.
    std::vector<double> above(double value) const;
    std::vector<double> below(double value) const;

    void leave_out(double value);

  private:
    using Counts = std::vector<std::uint64_t>;
    const Counts& lower_half(std::uint32_t upper);
    std::optional<Value> first_from(std::uint64_t key);
    std::optional<Value> last_until(std::int64_t key);
    std::vector<double> beyond(double value, bool above) const;

    const VolumeGrid* grid_;
    std::uint64_t count_ = 0, nonfinite_ = 0;
    Counts upper_;
    std::map<std::uint32_t, Counts> lower_;
    std::vector<std::uint32_t> left_out_;  ///< keys
};

}  // namespace bruma::scene
