#pragma once
#include "render/cloud_uniforms.h"
#include "render/passes/cloud_passes.h"
#include "render/passes/cloud_sky_pass.h"
#include "render/passes/opaque_pass.h"

namespace bruma::render {

/// What one layer of clouds adds to each pixel. Bottom row first.
struct CloudPicture {
    gl::Texture radiance;  ///< linear, added; alpha: transmittance
    gl::Texture distance;  ///< mean along the ray, metres, weighted by what each part hides; 0: nothing is hidden
    gl::Framebuffer framebuffer;
};

/// Turns of the march and lookups of weather, noise and light, per pixel.
struct CloudCounts {
    gl::Texture counts;
    gl::Texture radiance, distance;
    gl::Framebuffer framebuffer;
};

/// Marches one layer of clouds, up to the surfaces that the opaque pass found.
class CloudMarchPass {
  public:
    CloudMarchPass(FrameGraph& graph, gl::ShaderLibrary& shaders, const std::string& name);

    struct Inputs {
        const CloudPasses& passes;
        Handle<CloudNoise> noise;
        Handle<SkyLight> light;
        Handle<OpaquePicture> opaque;  ///< index -1: none
    };
    void update(const scene::Scene& scene, const scene::Clouds& clouds, const Inputs& inputs, glm::ivec2 pixels,
                double step_scale);
    void remove();

    Handle<CloudPicture> picture;
    Handle<CloudCounts> counts;

  private:
    struct Parameters {
        glm::ivec2 pixels{0};
        double step_scale = 1.0;
        scene::CloudLayer layer;
        scene::CloudOptics optics;
        scene::CloudMarch march;
        CloudOrigins origins;
        glm::dvec2 lean{0.0};
        Handle<OpaquePicture> opaque;
        bool operator==(const Parameters&) const = default;
    };
    struct Handles {
        Handle<CloudWeatherTextures> weather;
        Handle<CloudColumns> columns;
        Handle<CloudSunDepths> sun;
        Handle<CloudNoise> noise;
        Handle<SkyLight> light;
    };
    void draw(const PassAccess& access, const Parameters& parameters, const Handles& handles, bool counting);
    static gl::Defines defines_of(const Parameters& parameters, bool counting);
    void set_march(const PassAccess& access, gl::Program& program, const Parameters& parameters,
                   const scene::Camera& camera, GLuint& unit);
    static void set_optics(gl::Program& program, const Parameters& parameters);
    static void set_sun_path(const PassAccess& access, gl::Program& program, const Parameters& parameters,
                             const Handles& handles, GLuint& unit);

    FrameGraph& graph_;
    gl::ShaderLibrary& shaders_;
    gl::VertexArray no_vertices_{"no vertices"};
    gl::Texture blue_noise_;
    Handle<scene::Camera> camera_;
    Handle<CloudPasses::Map> map_;
    Handle<int> shader_revision_;
    PassId march_, count_;
};

}  // namespace bruma::render
