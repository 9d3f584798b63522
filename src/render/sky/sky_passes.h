#pragma once
#include <glm/glm.hpp>

#include "gl/full_screen.h"
#include "gl/shader_library.h"
#include "render/products/opaque_picture.h"
#include "render/products/sky_light.h"
#include "render/products/sky_picture.h"
#include "render/sky/sky_air.h"
#include "scene/scene.h"

namespace bruma::render {

/// The sky around the camera for a sun of irradiance 1.
struct SkyViewTables {
    gl::Texture clear;  ///< all but
    gl::Texture haze;   ///< what haze scatters directly, without its phase function
};

/// Sky, air and ground around a scene. Three tables depend on the air alone (that of light on the ground on the sky's
/// model, too), the sky view on the sun's elevation and the camera's altitude too, the light on the sun.
class SkyPasses {
  public:
    SkyPasses(FrameGraph& graph, gl::ShaderLibrary& shaders);
    ~SkyPasses();
    SkyPasses(const SkyPasses&) = delete;
    SkyPasses& operator=(const SkyPasses&) = delete;

    /// Hands the graph this frame's sources and parameters; the scene is outdoors. `opaque`: its surfaces, if any.
    void update(const scene::Scene& scene, Handle<OpaquePicture> opaque, glm::ivec2 pixels);
    /// For other passes that see through this air.
    AirTables air(const scene::Outdoors& outdoors) const;

    Handle<SkyPicture> picture;
    Handle<SkyLight> light;
    Handle<SkyTable> transmittance, multiple_scattering, irradiance;
    Handle<SkyViewTables> view;

  private:
    /// What the light of the whole sky depends on beside the air: nothing where the model is the atmosphere.
    struct ModelParameters {
        scene::SkyModel model = scene::SkyModel::atmosphere;
        double turbidity = 0.0;
        glm::dvec3 look{0.0};  ///< strengths of air and haze, asymmetry of haze
        bool operator==(const ModelParameters&) const = default;
    };
    static ModelParameters model_parameters(const scene::Sky& sky);
    static void set_model(gl::Program& program, const ModelParameters& parameters);

    struct ViewParameters {
        double altitude_m = 1.0;  ///< rounded: the sky changes slowly with it
        double sun_climb = 0.0;
        bool operator==(const ViewParameters&) const = default;
    };
    struct PictureParameters {
        glm::ivec2 pixels{0};
        scene::Sky sky;
        scene::Sun sun;
        Handle<OpaquePicture> opaque;
        double skipped_distance = 0.0;  ///< metres that parallel rays to surfaces start later
        bool operator==(const PictureParameters&) const = default;
    };
    void make_transmittance(const PassAccess& access);
    void make_multiple_scattering(const PassAccess& access);
    void make_irradiance(const PassAccess& access, const ModelParameters& parameters, bool multiple);
    void make_view(const PassAccess& access, const ViewParameters& parameters, bool multiple);
    void make_light(const PassAccess& access, const scene::Sun& sun, bool multiple);
    void draw(const PassAccess& access, const PictureParameters& parameters, bool marched);
    /// Sets air and tables of sky/sky_tables.glsl; returns the first texture unit that is free.
    GLuint bind_tables(const PassAccess& access, gl::Program& program, bool multiple, bool irradiance_too) const;

    FrameGraph& graph_;
    gl::ShaderLibrary& shaders_;
    gl::FullScreen full_screen_;
    Handle<scene::Atmosphere> atmosphere_;
    Handle<scene::Camera> camera_;
    Handle<int> shader_revision_;
    PassId transmittance_pass_, multiple_pass_, irradiance_pass_, view_pass_, light_pass_, picture_pass_;
};

}  // namespace bruma::render
