#pragma once
#include <string>

#include "gl/shader_library.h"
#include "render/clouds/cloud_noise_pass.h"
#include "scene/scene.h"

namespace bruma::render {

struct CloudWeatherTextures {
    gl::Texture map;        ///< as scene::WeatherMap, in 16 bits
    gl::Texture emptiness;  ///< Chebyshev distance of CloudCells
};

/// Optical depths over one tile of the weather map, nodes from the lowest altitude of cloud to the highest.
struct CloudColumns {
    gl::Texture up;
};
struct CloudSunDepths {
    gl::Texture depths;  ///< towards the sun, up, down; columns lean towards the sun
    scene::CloudBand band;
};

/// How far columns lean: x and z per metre of altitude. A sun lower than 3.4 degrees is taken for one that stands
/// there, else columns would lean across half the world.
glm::dvec2 sun_lean(const glm::dvec3& to_sun_world);

/// What one layer needs before it is marched: nothing of it depends on the camera, and nothing but the last on the sun.
class CloudPasses {
  public:
    using Map = std::shared_ptr<const scene::WeatherMap>;
    CloudPasses(FrameGraph& graph, gl::ShaderLibrary& shaders, const std::string& name);

    void update(const scene::Clouds& clouds, Handle<CloudNoise> noise, const glm::dvec3& to_sun_world);
    void remove();

    Handle<CloudWeatherTextures> weather;
    Handle<CloudColumns> columns;
    Handle<CloudSunDepths> sun;

  private:
    /// The part of a layer that grids over its tile depend on.
    struct Field {
        scene::CloudLayer layer;
        double extinction_per_m = 0.0;
        int edge = 0, slices = 0;
        bool operator==(const Field&) const = default;
    };
    struct SunParameters {
        Field field;
        glm::dvec3 to_sun_world{0.0, 1.0, 0.0};
        bool operator==(const SunParameters&) const = default;
    };
    void upload(const PassAccess& access, const scene::CloudLayer& layer);
    void make_columns(const PassAccess& access, const Field& field, Handle<CloudNoise> noise);
    void make_sun(const PassAccess& access, const SunParameters& parameters, Handle<CloudNoise> noise);

    FrameGraph& graph_;
    gl::ShaderLibrary& shaders_;
    Handle<Map> map_;
    Handle<int> shader_revision_;
    PassId upload_, columns_, sun_;
};

}  // namespace bruma::render
