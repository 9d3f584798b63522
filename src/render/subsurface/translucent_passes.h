#pragma once
#include <string>
#include <vector>

#include "gl/shader_library.h"
#include "render/mesh/mesh_passes.h"
#include "render/subsurface/body_frame.h"
#include "render/subsurface/radiosity_gather.h"
#include "render/subsurface/translucent_maps.h"

namespace bruma::render {

/// The lamps' light inside one translucent body, none of it dependent on the camera unless a lamp is. Everything is in
/// the body's own frame: a body that moves under parallel light reruns nothing.
class TranslucentPasses {
  public:
    TranslucentPasses(FrameGraph& graph, gl::ShaderLibrary& shaders, std::string node_name, const MeshPasses& mesh);
    ~TranslucentPasses();
    TranslucentPasses(const TranslucentPasses&) = delete;
    TranslucentPasses& operator=(const TranslucentPasses&) = delete;

    /// A mesh that may stand in the body's light.
    struct Occluder {
        Handle<MeshPasses::Triangles> triangles;
        Handle<MeshBuffers> buffers;
        glm::dmat4 world_from_model{1.0};
    };
    /// Hands the graph this frame's parameters. `lights`: those that shine. `reads`: which texels the camera looks up,
    /// or empty, for light at all of them.
    void update(const scene::Mesh& mesh, const glm::dmat4& world_from_model, const std::vector<Occluder>& occluders,
                const std::vector<scene::Light>& lights, glm::dvec3 camera_back_world, const PathGoal& goal,
                Handle<MapReads> reads);
    static bool needs_reads(const scene::SubsurfaceSettings& settings) {
        return settings.maps > 0 && !settings.whole_maps;
    }

    /// What a shader needs that shows or continues the result.
    struct Shown {
        Handle<LightMaps> light;
        Handle<ExitMaps> exits;
        Handle<RadiosityMaps> radiosity;
        SubsurfaceConstants constants;
        BodyFrame frame;
        scene::SubsurfaceSettings settings;
        std::vector<glm::dvec3> powers;  ///< of the lamps
    };
    const Shown& shown() const { return shown_; }
    /// Null before the first picture.
    const RadiosityMaps* standing() const { return graph_.product(shown_.radiosity); }
    bool settled() const {
        return standing() != nullptr && (standing()->noise <= shown_.settings.noise ||
                                         (shown_.settings.maps > 0 && standing()->read_texels == 0));
    }

  private:
    struct Shade {
        Handle<MeshBuffers> buffers;
        glm::dmat4 body_from_model{1.0};  ///< of the model's own coordinates, metres
        bool operator==(const Shade&) const = default;
    };
    struct LightParameters {
        glm::dmat3 body_from_model{1.0};
        std::vector<Shade> shades;  ///< what may stand in the light
        std::vector<BodyLamp> lamps;
        double eta = 1.3;
        int size = 0;
        bool operator==(const LightParameters&) const = default;
    };
    struct ExitParameters {
        glm::dmat3 body_from_model{1.0};
        int maps = 0, size = 0;
        bool operator==(const ExitParameters&) const = default;
    };
    struct StartParameters {
        scene::SubsurfaceMedium medium;
        scene::SubsurfaceModel model{};
        scene::SubsurfaceSampling sampling{};
        int samples = 0;
        std::vector<glm::dvec3> powers;
        bool operator==(const StartParameters&) const = default;
    };
    struct Start {
        Revision revision = 0;
    };
    SeenBody body(const PassAccess& access, const glm::dmat3& body_from_model) const;
    void look_from_lamps(const PassAccess& access, const LightParameters& parameters);
    void look_from_around(const PassAccess& access, const ExitParameters& parameters);
    void gather(const PassAccess& access, const Shown& shown, Handle<MapReads> reads, const PathGoal& goal);

    FrameGraph& graph_;
    gl::ShaderLibrary& shaders_;
    std::string node_name_;
    const MeshPasses& mesh_;
    Handle<int> shader_revision_;
    Handle<Start> start_;
    PassId light_, exits_, begin_, gather_;
    Shown shown_;
    int turn_ = 0;  ///< differs from the last one's while passes are missing
    bool said_coarse_ = false;
};

}  // namespace bruma::render
