#include "reference/volume/mixture_walk.h"

#include <algorithm>
#include <cmath>

namespace bruma::reference {

MixtureWalk::MixtureWalk(const std::vector<PreparedVolume>& volumes, const scene::Ray& ray, bool leap)
    : first_(std::numeric_limits<double>::infinity()), last_(-first_) {
    walks_.reserve(volumes.size());
    present_.reserve(volumes.size());
    for (const PreparedVolume& volume : volumes) {
        walks_.emplace_back(volume, ray, leap);
        if (!walks_.back().finished()) {
            first_ = std::min(first_, walks_.back().t_in());
            last_ = std::max(last_, walks_.back().t_out());
        }
    }
    t1_ = first_;
}

bool MixtureWalk::next() {
    do {
        // To the next place where a piece of any volume begins or ends.
        t0_ = t1_;
        t1_ = std::numeric_limits<double>::infinity();
        present_.clear();
        for (PieceWalk& walk : walks_) {
            while (!walk.finished() && walk.piece().t1 <= t0_) {
                walk.advance();
            }
            if (walk.finished()) {
                continue;
            }
            if (walk.piece().t0 <= t0_) {
                present_.push_back(&walk);
                t1_ = std::min(t1_, walk.piece().t1);
            } else {
                t1_ = std::min(t1_, walk.piece().t0);
            }
        }
    } while (present_.empty() && std::isfinite(t1_));
    return !present_.empty();
}

}  // namespace bruma::reference
