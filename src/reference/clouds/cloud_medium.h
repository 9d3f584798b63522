#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "reference/clouds/cloud_field.h"
#include "reference/clouds/cloud_geometry.h"
#include "scene/clouds/cloud_optics.h"

namespace bruma::reference {

/// A layer as light sees it: bounds, a density in them, and what that does to light.
struct CloudMedium {
    CloudGeometry geometry;
    std::function<double(const glm::dvec3&)> density;  ///< at (x, altitude, z); never above the majorant
    double majorant = 0.0;
    scene::CloudOptics optics;

    double extinction_per_m(const glm::dvec3& point_world) const {
        return optics.extinction_per_m * density(geometry.pattern_point(point_world));
    }
    double majorant_per_m() const { return optics.extinction_per_m * majorant; }
};

/// A field in its bounds; keeps the field.
CloudMedium medium_of(const CloudField& field, const CloudGeometry& geometry, const scene::CloudOptics& optics);

/// A part of a ray with the same layers all along it.
struct CloudStretch {
    double begin_m = 0.0, end_m = 0.0;
    std::vector<const CloudMedium*> media;
};

/// The parts of a ray (unit direction) that lie in any layer, near to far, up to `longest_m`. Layers may overlap.
std::vector<CloudStretch> stretches(std::span<const CloudMedium> media, const glm::dvec3& origin_world,
                                    const glm::dvec3& direction_world,
                                    double longest_m = std::numeric_limits<double>::infinity());

}  // namespace bruma::reference
