#pragma once
#include "measure/bench/mesh/bench_mesh_sampling.h"
#include "measure/bench/volume/bench_volume.h"
#include "measure/metrics/display_error.h"

/// What light inside of translucent meshes costs and how far it is from the truth, over all that trades the two.
namespace bruma::measure {

/// Three bodies made by code in black surroundings under one parallel light: a ball of potato lit from the side, a knot
/// of skin lit from the front, a ball of marble lit from behind.
std::vector<BenchScene> default_mesh_scenes(double aspect);
/// Gives a scene what the suite asks of all: one translucent mesh in black surroundings without highlight, and parallel
/// light in place of its own. Throws InputError for a scene that does not show exactly one mesh.
void make_mesh_scene(const std::string& name, scene::Scene& scene);

struct MeshBenchOptions {
    glm::ivec2 pixels{24, 24};          ///< of the pictures that are compared: the truth is slow
    glm::ivec2 frame_pixels{512, 512};  ///< of the frames that are timed
    int repeats = 3;
    bool quick = false;                 ///< fewer settings
    double reference_tolerance = 5e-3;  ///< of the quadrature, relative, per pixel
    std::uint64_t photons = 200'000;    ///< of the random walk, per channel
    std::function<void(const std::string&)> say = {};
};

/// One setting after some passes; evaluations and times are those of all passes up to here.
struct MeshBenchRow {
    scene::SubsurfaceModel model{};
    int maps = 0, map_size = 0, passes = 0;
    int samples = 0;                ///< points of light per texel
    std::uint64_t evaluations = 0;  ///< of the BSSRDF: counted where they are started
    DisplayError quadrature;        ///< against quadrature of the same model
    DisplayError walk;              ///< against photons
    double build_ms = 0.0;          ///< light maps, exit maps and passes
    double build_over_frame = 0.0;  ///< against a Blinn-Phong frame
};

/// A frame whose view alone is new, between two whose texels are there: maps are blended into a picture.
struct MeshCombination {
    int maps = 0, map_size = 0;
    double pass_ms = 0.0;           ///< all that draws the mesh, the look for missing texels included
    double pass_over_opaque = 0.0;  ///< against the same with Blinn-Phong shading
    double frame_over_frame = 0.0;  ///< whole frames
    std::uint64_t read_texels = 0;  ///< that the frame looks up: light is worked out there
    std::uint64_t all_texels = 0;   ///< of the maps, that see the body
    double read_share() const { return double(read_texels) / double(all_texels); }
};

struct MeshBenchScene {
    std::string name;
    double white = 1.0;                 ///< radiance that is display range
    std::size_t pixels = 0;             ///< that are compared: those whose neighbours show the body too
    double quadrature_rms_error = 0.0;  ///< stated, largest of the models; display range
    double walk_rms_error = 0.0;        ///< standard error of a pixel, RMS; display range
    double walk_bias_error = 0.0;       ///< standard error of the mean; display range
    double lost_share = 0.0;            ///< of the photons, through seams
    double quadrature_seconds = 0.0, walk_seconds = 0.0;
    double frame_ms = 0.0, opaque_ms = 0.0;  ///< Blinn-Phong at `frame_pixels`: the frame, its pass alone; medians
    std::vector<MeshBenchRow> rows;
    std::vector<MeshCombination> combinations;
};

struct MeshBench {
    Machine machine;
    MeshBenchOptions options;
    std::vector<MeshBenchScene> scenes;
    std::vector<SamplingNoise> noise;
    std::vector<SamplingRace> races;
};
MeshBench run_mesh_bench(const std::vector<BenchScene>& scenes, const MeshBenchOptions& options);

}  // namespace bruma::measure
