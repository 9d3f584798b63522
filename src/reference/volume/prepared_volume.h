#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reference/volume/gradient_shading.h"
#include "reference/volume/optical_curves.h"
#include "reference/volume/trilinear_field.h"

namespace bruma::reference {

/// A shown volume of a scene in the form in which rays meet it.
class PreparedVolume {
  public:
    PreparedVolume(const scene::Scene& scene, const std::string& node_name);

    const std::string& name() const { return name_; }

    glm::dvec3 size() const { return glm::dvec3(field.grid().size); }
    /// u of a data value, not clamped.
    double u_of_value(double value) const { return (value - window_low_) * u_per_value_; }
    /// Whether all cells of a block (see BlockRanges) are transparent.
    bool block_is_transparent(glm::ivec3 block) const { return transparent_[block_index(block)] != 0; }
    /// An extinction, 1/m, that none in the cells of a block exceeds; 0 for transparent blocks.
    double majorant(glm::ivec3 block) const { return majorants_[block_index(block)]; }
    glm::ivec3 blocks() const { return blocks_; }
    /// The number of collisions with nothing that delta tracking makes in crossing a block, for the worst of them.
    double largest_null_depth() const { return largest_null_depth_; }

    /// Share of the light met that matter of this colour scatters, per channel, in [0, 1].
    glm::dvec3 albedo_of(glm::dvec3 color) const { return glm::clamp(albedo_ * color, 0.0, 1.0); }

    TrilinearField field;
    OpticalCurves curves;
    glm::dmat4 texture_from_world;
    scene::ClipBox clip;
    std::optional<GradientShading> shading;  ///< of surfaces, alone or beside scattering; empty: none
    scene::VolumeLighting lighting;
    bool scatters;  ///< by the phase function; otherwise its colour is a radiance
    double g;

  private:
    std::size_t block_index(glm::ivec3 block) const {
        return (std::size_t(block.z) * blocks_.y + block.y) * blocks_.x + block.x;
    }

    std::string name_;
    glm::dvec3 albedo_;
    double window_low_, u_per_value_;
    glm::ivec3 blocks_{0};
    std::vector<std::uint8_t> transparent_;
    std::vector<double> majorants_;
    double largest_null_depth_ = 0.0;
};

/// All shown volumes of a scene that is seen by a camera. Throws InputError for a scene that fails scene::check, has
/// no camera, or holds a volume without samples.
std::vector<PreparedVolume> prepare_volumes(const scene::Scene& scene);

}  // namespace bruma::reference
