#pragma once
#include "gl/program.h"
#include "gl/texture.h"
#include "render/frame_graph.h"
#include "scene/sky/sky.h"

namespace bruma::render {

/// A table of shaders/sky/sky_tables.glsl: linear values at texel centres, the first and last at the ends.
struct SkyTable {
    gl::Texture texture;
};

/// The air of an outdoor scene and its sun, for passes that see through that air.
struct AirTables {
    scene::Atmosphere atmosphere;
    glm::dvec3 sun_irradiance{0.0};  ///< above the air
    Handle<SkyTable> transmittance;
    Handle<SkyTable> multiple_scattering;  ///< index -1: light is scattered once
    bool operator==(const AirTables&) const = default;
};

/// Sets the air of shaders/sky/sky_air.glsl.
void set_air(gl::Program& program, const scene::Atmosphere& atmosphere);
/// The same, with what sky/sky_tables.glsl looks up there (but the light on the ground); binds textures from `unit`
/// on, which is moved.
void set_air(const PassAccess& access, gl::Program& program, const AirTables& air, GLuint& unit);

}  // namespace bruma::render
