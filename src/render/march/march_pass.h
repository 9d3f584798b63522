#pragma once
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gl/full_screen.h"
#include "gl/shader_library.h"
#include "render/clouds/cloud_march_pass.h"
#include "render/clouds/cloud_shafts_pass.h"
#include "render/light/light_passes.h"
#include "render/products/opaque_picture.h"
#include "render/products/picture.h"
#include "render/sky/sky_passes.h"
#include "render/view.h"
#include "render/volume/volume_passes.h"

namespace bruma::render {

/// Marches all shown volumes, up to the surfaces that the opaque pass found, over these and the background.
class MarchPass {
  public:
    MarchPass(FrameGraph& graph, gl::ShaderLibrary& shaders);

    using Volumes = std::map<std::string, std::unique_ptr<VolumePasses>>;
    using Lights = std::map<std::string, std::unique_ptr<LightPasses>>;
    /// Hands the graph this frame's sources and parameters. `lights`: of the volumes that scatter.
    /// `opaque`: the surfaces of all meshes; an empty handle where there are none. `clouds`: one picture for each
    /// layer. `sky`: surfaces and what is behind them, in place of the background; empty indoors. `shafts`: what the
    /// air before them misses, if anything. `shadows`: of clouds, on volumes.
    void update(const scene::Scene& scene, const Volumes& volumes, const Lights& lights, Handle<OpaquePicture> opaque,
                const std::vector<Handle<CloudPicture>>& clouds, const View& view, double step_world,
                Handle<SkyPicture> sky = {}, Handle<CloudShafts> shafts = {}, const CloudShadows& shadows = {});
    /// Whether gradients come from a texture of their own, or from the samples at each look. From the next update on.
    void store_gradients(bool stored) { gradients_stored_ = stored; }

    /// Whether the volume's surfaces are shaded by the gradient of its data.
    static bool reflects(const scene::VolumeOptics& optics);

    Handle<Picture> picture;
    Handle<SampleCounts> counts;

  private:
    struct VolumeInput {
        Handle<VolumeTexture> voxels;
        Handle<GradientTexture> gradients;
        Handle<TableTextures> tables;
        Handle<EmptinessTexture> emptiness;
        glm::dmat4 world_from_texture{1.0};
        scene::ClipBox clip;
        scene::VolumeOptics optics;
        std::array<double, 2> window{0.0, 1.0};
        double tau_per_sigma_metre = 1.0;  ///< density / reference length
        double shading_range = 1.0;
        scene::LightVolumeSettings light_volume;
        LightGrid light_grid;
        Handle<LightTextures> light;   ///< index -1: none, or the volume does not scatter
        Handle<LightTextures> beside;  ///< index -1: nothing beside direct light
        bool operator==(const VolumeInput&) const = default;
    };
    struct Parameters {
        View view;
        scene::RenderSettings settings;
        double step_world = 1.0;
        double skipped_distance = 0.0;  ///< metres, before parallel rays start
        Handle<OpaquePicture> opaque;
        std::vector<Handle<CloudPicture>> clouds;
        std::vector<VolumeInput> volumes;
        std::vector<scene::Light> lights;
        bool lit = false;              ///< lights matter
        bool gradients_stored = true;  ///< else they are worked out from the voxels
        Handle<SkyPicture> sky;
        Handle<CloudShafts> shafts;
        CloudShadows shadows;  ///< none where no volume is lit
        bool operator==(const Parameters&) const = default;
    };

    void draw(const PassAccess& access, const Parameters& parameters, bool counting);
    gl::Program& program(const PassAccess& access, const Parameters& parameters, bool counting);
    void bind_light(const PassAccess& access, gl::Program& program, const Parameters& parameters, int index,
                    GLuint& unit) const;
    void bind_volume(const PassAccess& access, gl::Program& program, const Parameters& parameters, int index,
                     GLuint& unit, const scene::Camera& camera);

    FrameGraph& graph_;
    gl::ShaderLibrary& shaders_;
    gl::FullScreen full_screen_;
    gl::Texture blue_noise_;
    Handle<scene::Camera> camera_;
    Handle<scene::Background> background_;
    Handle<int> shader_revision_;
    PassId march_, count_;
    bool gradients_stored_ = true;
};

}  // namespace bruma::render
