#include "reference/medium/delta_tracking.h"

#include <cmath>
#include <limits>

#include "reference/medium/majorant_walk.h"

namespace bruma::reference {
namespace {

/// Calls `meet(t, extinction share, optics)` at each tentative collision, until it returns false.
template <class Meet>
void visit_tentative_collisions(const PreparedVolume& volume, const scene::Ray& ray, double t_far, RandomStream& random,
                                Meet&& meet) {
    const auto flight = [&] { return -std::log1p(-random.uniform()); };  // optical depth under the majorant
    double depth = -1.0;  // left until the next tentative collision; below 0: not drawn
    for (MajorantWalk walk(volume, ray, t_far); !walk.finished(); walk.advance()) {
        depth = depth < 0.0 ? flight() : depth;
        double t = walk.t0();
        double left = walk.majorant() * (walk.t1() - t);
        while (depth <= left) {
            left -= depth;
            t = std::min(t + depth / walk.majorant(), walk.t1());
            const OpticalPoint optics = walk.optics_at(t);
            if (!meet(t, optics.extinction / walk.majorant(), optics)) {
                return;
            }
            depth = flight();
        }
        depth -= left;
    }
}

}  // namespace

std::optional<Collision> next_collision(const std::vector<PreparedVolume>& volumes, const scene::Ray& ray,
                                        RandomStream& random) {
    std::optional<Collision> nearest;
    for (const PreparedVolume& volume : volumes) {
        const double t_far = nearest ? nearest->t : std::numeric_limits<double>::infinity();
        visit_tentative_collisions(volume, ray, t_far, random, [&](double t, double share, const OpticalPoint& optics) {
            if (random.uniform() >= share) {
                return true;
            }
            nearest = {&volume, t, optics};
            return false;
        });
    }
    return nearest;
}

double tracked_transmittance(const std::vector<PreparedVolume>& volumes, const scene::Ray& ray, double t_far,
                             RandomStream& random) {
    constexpr double little = 0.05;
    double transmittance = 1.0;
    for (const PreparedVolume& volume : volumes) {
        visit_tentative_collisions(volume, ray, t_far, random, [&](double, double share, const OpticalPoint&) {
            transmittance *= 1.0 - share;
            if (transmittance < little) {
                transmittance = random.uniform() * little < transmittance ? little : 0.0;
            }
            return transmittance > 0.0;
        });
        if (transmittance == 0.0) {
            break;
        }
    }
    return transmittance;
}

}  // namespace bruma::reference
