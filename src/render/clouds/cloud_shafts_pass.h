#pragma once
#include "gl/shader_library.h"
#include "render/clouds/cloud_shadows.h"
#include "render/sky/sky_air.h"

namespace bruma::render {

/// Light that air would scatter towards the eye, were there no clouds before the sun: over the picture and the
/// distance, for irradiance 1 of the sun, as shaders/clouds/cloud_shafts.glsl looks it up.
struct CloudShafts {
    gl::Texture missing;
    gl::Texture missing_share;  ///< of all the air's light
    gl::Texture ground;         ///< the sun's light from ground at a distance, were it there
    double first_m = 0.0;       ///< where a ray can first be below the clouds' top
    double near_m = 1.0;        ///< beyond it by this much its steps are twice as long
    double growth = 1.0;
    int cell = 1;  ///< edge in pixels
    glm::dvec3 sun_irradiance{0.0};
    double planet_radius_m = 0.0;

    /// Everything but the shader's view, which it shares. Binds three textures from `unit` on, which is moved.
    void set(gl::Program& program, const scene::Camera& camera, glm::ivec2 pixels, GLuint& unit) const;
};

/// Sums that light along one ray of each cell of the picture (after the volumes of Hillaire 2020, section 5.4, and
/// Wronski 2014, "Volumetric Fog"). Only outdoors, with clouds.
class CloudShaftsPass {
  public:
    CloudShaftsPass(FrameGraph& graph, gl::ShaderLibrary& shaders);
    /// `reach_m`: beyond there are no clouds.
    void update(const scene::Scene& scene, const CloudShadows& shadows, const AirTables& air, double reach_m,
                glm::ivec2 pixels);
    void remove();

    Handle<CloudShafts> shafts;

  private:
    struct Parameters {
        glm::ivec2 pixels{0};
        CloudShadows shadows;
        AirTables air;
        glm::dvec3 to_sun_world{0.0, 1.0, 0.0};
        double reach_m = 0.0;
        bool operator==(const Parameters&) const = default;
    };
    void draw(const PassAccess& access, const Parameters& parameters);

    FrameGraph& graph_;
    gl::ShaderLibrary& shaders_;
    Handle<scene::Camera> camera_;
    Handle<int> shader_revision_;
    PassId pass_;
};

}  // namespace bruma::render
