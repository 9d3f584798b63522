#pragma once
#include <memory>
#include <optional>
#include <set>

#include "base/image.h"
#include "gl/shader_library.h"
#include "render/clouds/clouds.h"
#include "render/frame_graph.h"
#include "render/march/march_pass.h"
#include "render/paths/path_trace_pass.h"
#include "render/sky/sky_passes.h"
#include "render/surfaces/map_reads_pass.h"
#include "render/surfaces/opaque_pass.h"
#include "render/volume_needs.h"
#include "scene/scene.h"

namespace bruma::render {

/// Sums over all pixels of the counting march.
struct SampleTotals {
    std::uint64_t samples = 0;
    std::uint64_t emptiness_queries = 0;
    double samples_per_pixel = 0.0;
};

/// Sums over all pixels and layers of the counting march of clouds.
struct CloudTotals {
    std::uint64_t turns = 0, weather = 0, noise = 0, light = 0;
};

/// How far path tracing has come.
struct PathStanding {
    int samples = 0;  ///< paths that every pixel has
    /// Root mean square over pixels and colours of the mean's standard error, radiance: about the picture's RMSE from
    /// the truth. Nothing below two paths.
    std::optional<double> standard_error;
};

/// How far the light inside translucent meshes has come: the mesh that is furthest behind.
struct TranslucentStanding {
    int passes = 0;                   ///< over its maps
    double noise = 0.0;               ///< standard error, share of the local value; 1e30: not known yet
    bool settled = false;             ///< all of them are below the noise that was asked for
    std::uint64_t evaluations = 0;    ///< of the BSSRDF, in the passes over the maps of all of them
    std::uint64_t read_texels = 0;    ///< of their maps, that the camera's pixels look up: no others are worked out
    std::uint64_t all_texels = 0;     ///< that see them
    std::uint32_t unseen_pixels = 0;  ///< that no map sees well, so that their light is worked out one by one
};

/// Pictures of a scene. Keeps a frame graph between pictures, so that each one costs only what changed.
class Renderer {
  public:
    explicit Renderer(gl::ShaderLibrary& shaders);

    /// Bytes that volumes may take; without a call, what the driver tells to be free.
    void set_texture_budget(std::uint64_t bytes) { fitting_.set_budget(bytes); }

    /// Brings the picture up to date; the scene needs a camera, its volumes their grids and its meshes their triangles.
    /// With `measure_gpu` the GPU is drained around each pass, so that its time is known.
    const RunReport& render(const scene::Scene& scene, const View& view, bool measure_gpu = false);

    /// The last picture, still on the GPU.
    const Picture& picture() const;
    /// The last picture in memory, top row first, linear.
    Image read_picture() const;
    /// Counts the samples of the last view by drawing it once more; `picture` is not touched.
    SampleTotals count_samples(const scene::Scene& scene, const View& view);

    /// Clouds with reprojection: pictures to be drawn until a still one is as if all of it had been marched.
    int missing_cloud_turns() const { return clouds_ ? clouds_->missing_turns() : 0; }
    /// Whether clouds of the last picture were made from those of the one before it.
    bool clouds_from_last() const { return clouds_ && clouds_->from_last(); }
    /// What each layer of clouds adds to the last picture, still on the GPU.
    std::vector<const CloudPicture*> cloud_pictures() const;
    /// Lookups of the clouds' march, all layers together, by drawing it once more.
    CloudTotals count_clouds(const scene::Scene& scene, const View& view);

    /// Paths that every pixel of the last picture has; nothing when it was not path traced.
    std::optional<int> path_samples() const;
    /// The same with the error, which is read back from the GPU.
    std::optional<PathStanding> path_standing() const;
    /// How far the light inside translucent meshes has come; nothing when none is shown.
    std::optional<TranslucentStanding> translucent_standing() const;
    /// Standard error of each channel of a path traced picture, top row first; 0 below two paths.
    Image read_standard_error() const;

    const FrameGraph& graph() const { return graph_; }
    /// World length of a step for this scene, metres.
    static double step_world(const scene::Scene& scene);

  private:
    void update(const scene::Scene& scene, const View& view);
    /// All lamps, the sun of an outdoor scene too, are among the scene's lights, and its volumes fit.
    void update_passes(const scene::Scene& scene, const View& view);
    void update_meshes(const scene::Scene& scene, const std::vector<std::string>& shown, const View& view,
                       const CloudShadows& clouds);
    void update_translucent(const scene::Scene& scene, const std::vector<std::string>& shown,
                            const std::vector<scene::Light>& lights, const View& view);
    /// Makes or forgets the passes of clouds; what their shadows fall on comes next.
    CloudShadows prepare_clouds(const scene::Scene& scene);
    /// The pictures of all shown layers of clouds.
    std::vector<Handle<CloudPicture>> update_clouds(const scene::Scene& scene, const View& view);
    void update_lights(const scene::Scene& scene, const std::vector<std::string>& shown, double step_world);
    int wanted_picture() const { return path_traced_ ? path_trace_.paths.index : march_.picture.index; }

    FrameGraph graph_;
    gl::ShaderLibrary& shaders_;
    VolumeFitting fitting_;
    MarchPass march_;
    PathTracePass path_trace_;
    bool path_traced_ = false;
    MarchPass::Volumes volumes_;
    MarchPass::Lights lights_;  ///< of the volumes that scatter
    OpaquePass::Meshes meshes_;
    std::unique_ptr<ShadowPass> shadows_;      ///< none while no lamp casts any
    std::unique_ptr<SkyPasses> sky_;           ///< none indoors
    std::unique_ptr<MapReadsPass> map_reads_;  ///< none while no map waits for being read
    OpaquePass::Translucents translucents_;    ///< of the meshes that light enters
    std::unique_ptr<OpaquePass> opaque_;       ///< none while no mesh is shown
    std::unique_ptr<Clouds> clouds_;           ///< none while no clouds are shown
    bool said_no_meshes_ = false, said_no_sky_ = false;
    std::string said_shadows_left_out_;  ///< the last warning of that kind
};

}  // namespace bruma::render
