#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reference/gradient_shading.h"
#include "reference/optical_curves.h"
#include "reference/trilinear_field.h"

namespace bruma::reference {

/// A shown volume of a scene in the form in which rays meet it.
class PreparedVolume {
  public:
    PreparedVolume(const scene::Scene& scene, const std::string& node_name);

    glm::dvec3 size() const { return glm::dvec3(field.grid().size); }
    /// u of a data value, not clamped.
    double u_of_value(double value) const { return (value - window_low_) * u_per_value_; }
    /// Whether all cells of a block (see BlockRanges) are transparent.
    bool block_is_transparent(glm::ivec3 block) const {
        return transparent_[(std::size_t(block.z) * blocks_.y + block.y) * blocks_.x + block.x] != 0;
    }

    TrilinearField field;
    OpticalCurves curves;
    glm::dmat4 texture_from_world;
    scene::ClipBox clip;
    std::optional<GradientShading> shading;  ///< empty: colour as it is

  private:
    double window_low_, u_per_value_;
    glm::ivec3 blocks_{0};
    std::vector<std::uint8_t> transparent_;
};

}  // namespace bruma::reference
