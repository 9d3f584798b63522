#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "render/renderer.h"

namespace bruma::app {

/// A table of what each pass did and why, for people.
std::string explanation(const render::RunReport& report);

/// How far the paths of a path traced frame went.
struct PathFigures {
    render::PathStanding standing;
    double ms = 0.0;  ///< of all paths
};

/// What a frame cost beside the same frame by brute force, both measured in turn in one run.
struct FrameStatistics {
    render::RunReport passes;  ///< of the first frame
    render::SampleTotals samples, brute_samples;
    double frame_ms = 0.0, brute_ms = 0.0;  ///< medians of the march, wall time
    double step_mm = 0.0;
    double termination_bound = 0.0;                     ///< largest error that early termination can cause, radiance
    std::optional<PathFigures> paths;                   ///< of a path traced frame, which has no march
    std::optional<render::TranslucentStanding> inside;  ///< of translucent meshes
};
/// Draws the frame `repeats` times with the scene's settings and without skipping and early termination, alternating
/// between two renderers, so that neither loses what it keeps. A path traced frame is drawn once.
FrameStatistics measure_frame(gl::ShaderLibrary& shaders, const scene::Scene& scene, const render::View& view,
                              int repeats);

nlohmann::json to_json(const FrameStatistics& statistics);
std::string summary(const FrameStatistics& statistics);

}  // namespace bruma::app
