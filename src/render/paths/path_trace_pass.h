#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/march/march_pass.h"
#include "render/paths/path_volume_passes.h"

namespace bruma::render {

/// Whether a scene is path traced: as soon as one shown volume asks for it, all are, in one medium.
bool is_path_traced(const scene::Scene& scene);

/// Means over paths so far. Bottom row first. Rows below `next_row` hold one path more than the others.
struct PathTracing {
    Picture picture;     ///< the mean, once each pixel has a path
    gl::Texture mean;    ///< linear radiance; alpha = 1 - transmittance
    gl::Texture spread;  ///< sum of squared differences from the mean, per channel
    int samples = 0;     ///< paths that every pixel has
    int next_row = 0;
    Revision start = 0;   ///< of what the paths began with
    double row_ms = 0.0;  ///< what a row of paths takes, the dearest of late; 0: not measured
};

/// Progressive path tracing of all shown volumes: what is asked for again with more samples is continued, bit for bit
/// as if all had been asked for at once; what anything has changed for begins anew.
class PathTracePass {
  public:
    PathTracePass(FrameGraph& graph, gl::ShaderLibrary& shaders);

    void update(const scene::Scene& scene, const MarchPass::Volumes& volumes, const View& view);
    /// Forgets the passes of volumes: before these are removed, or when the scene is not path traced any more.
    void forget(const std::string& node_name);
    void forget_all();

    Handle<PathTracing> paths;

  private:
    struct VolumeInput {
        Handle<VolumeTexture> voxels;
        Handle<ScatteringTextures> tables;
        Handle<BoundsTexture> bounds;
        glm::dmat4 world_from_texture{1.0};
        scene::ClipBox clip;
        double g = 0.0;
        std::array<double, 2> window{0.0, 1.0};
        double sigma_per_metre = 1.0;  ///< density / reference length
        bool operator==(const VolumeInput&) const = default;
    };
    struct Parameters {
        glm::ivec2 pixels{0};
        int scatterings = 0;
        std::vector<VolumeInput> volumes;
        std::vector<scene::Light> lights;
        bool operator==(const Parameters&) const = default;
    };
    struct Turn {
        int samples = 0;
        int number = 0;  ///< differs from the last one's while paths are missing
        bool operator==(const Turn&) const = default;
    };
    /// What begins anew when any input is newer.
    struct Start {
        Revision revision = 0;
    };
    struct Medium;

    void trace(const PassAccess& access, const Parameters& parameters, const PathGoal& goal);
    gl::Program& prepare(const PassAccess& access, const Parameters& parameters);
    static void set_camera(gl::Program& program, const Medium& medium, const scene::Camera& camera, glm::ivec2 pixels);
    static void set_lights(gl::Program& program, const Medium& medium, const std::vector<scene::Light>& lights,
                           const scene::Camera& camera);
    static void bind_volume(const PassAccess& access, gl::Program& program, const Medium& medium,
                            const VolumeInput& input, int index);

    FrameGraph& graph_;
    gl::ShaderLibrary& shaders_;
    std::map<std::string, std::unique_ptr<PathVolumePasses>> volumes_;
    Handle<scene::Camera> camera_;
    Handle<scene::Background> background_;
    Handle<scene::Environment> environment_;
    Handle<int> shader_revision_;
    Handle<Start> start_;
    PassId begin_, trace_;
    int turn_ = 0;
};

}  // namespace bruma::render
