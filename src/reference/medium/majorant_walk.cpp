#include "reference/medium/majorant_walk.h"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

namespace bruma::reference {

MajorantWalk::MajorantWalk(const PreparedVolume& volume, const scene::Ray& ray, double t_far)
    : in_volume_(volume, ray, t_far), t0_(in_volume_.t_in), finished_(in_volume_.misses()) {
    if (!finished_) {
        const glm::ivec3 cell = glm::clamp(in_volume_.cell_at(t0_), glm::ivec3(-1), volume.field.grid().size - 1);
        block_ = (cell + 1) / BlockRanges::edge;
        enter_block();
        if (!(majorant_ > 0.0 && t1_ > t0_)) {
            advance();
        }
    }
}

void MajorantWalk::enter_block() {
    exit_ = in_volume_.nearest_plane(in_volume_.planes_ahead(block_ * BlockRanges::edge - 1, BlockRanges::edge));
    t1_ = std::min(exit_.t, in_volume_.t_out);
    majorant_ = in_volume_.volume->majorant(block_);
}

void MajorantWalk::advance() {
    do {
        t0_ = std::max(t0_, t1_);
        block_[exit_.axis] += in_volume_.direction_voxel[exit_.axis] > 0.0 ? 1 : -1;
        const int at = block_[exit_.axis];
        finished_ = t0_ >= in_volume_.t_out || at < 0 || at >= in_volume_.volume->blocks()[exit_.axis];
        if (finished_) {
            return;
        }
        enter_block();
    } while (!(majorant_ > 0.0 && t1_ > t0_));
}

OpticalPoint MajorantWalk::optics_at(double t) const {
    const PreparedVolume& volume = *in_volume_.volume;
    const glm::dvec3 at = in_volume_.voxel_at(t);
    const glm::ivec3 first = block_ * BlockRanges::edge - 1;
    const glm::ivec3 last = glm::min(first + BlockRanges::edge, volume.field.grid().size) - 1;
    const glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor(at)), first, last);
    if (volume.field.is_hole(cell)) {
        return {};
    }
    const glm::dvec3 f = glm::clamp(at - glm::dvec3(cell), 0.0, 1.0);
    const std::array<double, 8> s = volume.field.corners(cell);
    const auto mix = [](double a, double b, double x) { return a + x * (b - a); };
    const double value = mix(mix(mix(s[0], s[1], f.x), mix(s[2], s[3], f.x), f.y),
                             mix(mix(s[4], s[5], f.x), mix(s[6], s[7], f.x), f.y), f.z);
    // A mean that rounding moved out of the corners' range could meet another stretch of the transfer function.
    const auto [low, high] = std::minmax_element(s.begin(), s.end());
    const OpticalPoint optics = volume.curves.at(volume.u_of_value(std::clamp(value, *low, *high)));
    if (!(optics.extinction <= majorant_)) {
        throw std::logic_error(fmt::format("delta tracking: {} has an extinction of {} per metre in a block of {}",
                                           volume.name(), optics.extinction, majorant_));
    }
    return optics;
}

}  // namespace bruma::reference
