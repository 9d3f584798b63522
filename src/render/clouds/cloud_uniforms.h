#pragma once
#include "gl/program.h"
#include "render/clouds/cloud_noise_pass.h"
#include "scene/clouds/clouds.h"

/// What all shaders that look up clouds/cloud_field.glsl must agree on.
namespace bruma::render {

/// The switches of a layer's field.
gl::Defines cloud_field_defines(const scene::CloudLayer& layer);

/// Texture coordinates, in tiles in [0,1), of the point that shaders call (0, 0, 0).
struct CloudOrigins {
    glm::dvec2 weather{0.0};
    glm::dvec3 shape{0.0}, detail{0.0};
    bool operator==(const CloudOrigins&) const = default;
};
/// For points counted from `place_world` (its y is not used) at a time: reduced in double, so that nothing swims
/// however late it is or far away.
CloudOrigins cloud_origins(const scene::CloudLayer& layer, const glm::dvec3& place_world, double time_s);
/// Of the corner of the tile of the weather map. Grids of one tile are made for it; they are right everywhere and at
/// any time when the edge of the weather map is a multiple of those of the noise.
inline CloudOrigins tile_origins() {
    return {};
}

/// Binds textures from `unit` on, which is moved, and sets the layer's uniforms.
void set_cloud_field(gl::Program& program, const scene::CloudLayer& layer, const CloudOrigins& origins,
                     const gl::Texture& weather, const CloudNoise& noise, GLuint& unit);

}  // namespace bruma::render
