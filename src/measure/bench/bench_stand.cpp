#include "measure/bench/bench_stand.h"

namespace bruma::measure {

double BenchStand::prepare(const scene::RenderSettings& settings) {
    scene_.rendering.set(settings);
    double table_ms = 0.0;
    for (const render::PassReport& pass : renderer_.render(scene_, view_, true)) {
        table_ms += pass.ran && pass.name.ends_with(": tables") ? pass.gpu_ms : 0.0;
    }
    return table_ms;
}

Duration BenchStand::timed(const scene::RenderSettings& settings) {
    scene_.rendering.set(settings);
    // The same background, but newer: the picture is stale and nothing else is.
    scene_.background = Tracked<scene::Background>(scene::Background(*scene_.background));
    return drained([&] { renderer_.render(scene_, view_); });
}

Duration BenchStand::timed(const scene::Camera& camera) {
    scene_.camera = camera;
    return drained([&] { renderer_.render(scene_, view_); });
}

render::RunReport BenchStand::passes(const scene::Camera& camera) {
    scene_.camera = camera;
    return renderer_.render(scene_, view_, true);
}

render::SampleTotals BenchStand::count(const scene::RenderSettings& settings) {
    scene_.rendering.set(settings);
    return renderer_.count_samples(scene_, view_);
}

}  // namespace bruma::measure
