#pragma once
#include <array>
#include <optional>

#include "gl/full_screen.h"
#include "render/clouds/cloud_history.h"
#include "render/clouds/cloud_passes.h"
#include "render/clouds/cloud_sky_pass.h"
#include "render/clouds/cloud_uniforms.h"
#include "render/products/opaque_picture.h"
#include "render/sky/sky_air.h"
#include "render/view.h"

namespace bruma::render {

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
        std::optional<AirTables> air;  ///< none indoors
    };
    void update(const scene::Scene& scene, const scene::Clouds& clouds, const Inputs& inputs, const View& view);
    void remove();

    Handle<CloudPicture> picture;
    Handle<CloudCounts> counts;

    /// With reprojection: turns that are missing until the picture is as if all of it had been marched.
    int missing_turns() const { return history_.missing(); }
    /// Whether the last picture was made from the one before it.
    bool from_last() const { return from_last_; }

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
        std::optional<AirTables> air;
        CloudSight sight;
        bool reprojects = false;
        int turn = 0;  ///< with reprojection another one while turns are missing
        bool operator==(const Parameters&) const = default;
    };
    /// What the last picture was made with; history serves only pictures that differ by sight alone.
    struct Made {
        Parameters parameters;
        std::array<Revision, 4> inputs{};  ///< map, weather, light, depths
        bool operator==(const Made&) const = default;
    };
    struct Handles {
        Handle<CloudWeatherTextures> weather;
        Handle<CloudColumns> columns;
        Handle<CloudSunDepths> sun;
        Handle<CloudNoise> noise;
        Handle<SkyLight> light;
    };
    void draw(const PassAccess& access, const Parameters& parameters, const Handles& handles, bool counting);
    Made made_with(Parameters parameters, const Handles& handles) const;
    gl::Program& prepared_program(const PassAccess& access, const Parameters& parameters, const Handles& handles,
                                  const gl::Defines& defines);
    static gl::Defines defines_of(const Parameters& parameters, bool counting);
    void set_march(const PassAccess& access, gl::Program& program, const Parameters& parameters,
                   const scene::Camera& camera, GLuint& unit);
    static void set_optics(gl::Program& program, const Parameters& parameters);
    static void set_sun_path(const PassAccess& access, gl::Program& program, const Parameters& parameters,
                             const Handles& handles, GLuint& unit);

    FrameGraph& graph_;
    gl::ShaderLibrary& shaders_;
    gl::FullScreen full_screen_;
    gl::Texture blue_noise_;
    CloudHistory history_;
    bool from_last_ = false;
    std::optional<Made> made_;
    int turn_ = 0;
    Handle<scene::Camera> camera_;
    Handle<CloudPasses::Map> map_;
    Handle<int> shader_revision_;
    PassId march_, count_;
};

}  // namespace bruma::render
