#pragma once
#include <string>

#include "measure/bench/bench_machine.h"
#include "render/renderer.h"

namespace bruma::measure {

/// A renderer for timing marches. Its passes before the march stay valid from frame to frame as long as the same
/// settings of skipping, step and classification come again; where they alternate, each wants a stand of its own, or
/// the products that the other setting let go are built anew inside of the timed frame.
class BenchStand {
  public:
    BenchStand(gl::ShaderLibrary& shaders, scene::Scene scene, glm::ivec2 pixels)
        : renderer_(shaders), scene_(std::move(scene)), view_{pixels, 1.0} {}

    /// Draws once untimed, so that everything is built and compiled; returns the time of the tables, ms, if they were.
    double prepare(const scene::RenderSettings& settings);
    /// A whole frame, drained before and after.
    Duration timed(const scene::RenderSettings& settings);
    Duration timed(const scene::Camera& camera);
    /// The same, pass by pass: each is waited for, so that the whole takes longer.
    render::RunReport passes(const scene::Camera& camera);
    render::SampleTotals count(const scene::RenderSettings& settings);
    Image picture() const { return renderer_.read_picture(); }

  private:
    render::Renderer renderer_;
    scene::Scene scene_;
    render::View view_;
};

}  // namespace bruma::measure
