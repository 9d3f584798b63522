#pragma once
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "base/image.h"
#include "measure/bench/bench_machine.h"
#include "scene/scene.h"

namespace bruma::measure {

struct FramesBenchOptions {
    glm::ivec2 pixels{512, 512};
    double azimuth_step_deg = 3.0;  ///< between one frame and the next
    int repeats = 9;                ///< frames that count
    int warmup = 2;                 ///< frames before them
    bool passes = false;            ///< as many frames again, timed pass by pass
};

/// Frames along an orbit, as benchmarks of other programs measure them: no picture is reused, since each is seen from
/// elsewhere; what does not depend on the view (textures, tables) is built before.
struct FramesBench {
    std::string scene;
    double ms_median = 0.0, ms_min = 0.0, ms_max = 0.0;
    double cpu_ms_median = 0.0;
    int frames = 0;
    double samples_per_pixel = 0.0;         ///< of the first frame
    std::map<std::string, double> pass_ms;  ///< medians of those that ran in more than half of the frames
    Image first_frame;                      ///< from the scene's own camera; linear
};
FramesBench run_frames_bench(const std::string& name, const scene::Scene& scene, const FramesBenchOptions& options);

/// On one line.
nlohmann::json to_json(const FramesBench& bench);

/// The camera turned about its target around the world's +y, to the right-hand side.
scene::Camera orbited(const scene::Camera& camera, double azimuth_deg);

}  // namespace bruma::measure
