#include "measure/bench/volume/bench_volume.h"
#include "scene/builtin/builtin.h"

namespace bruma::measure {
namespace {

/// Positions are multiples of 1/255, where tables hold the curve exactly: what is measured is the march.
scene::TransferFunction sharp_shell(int from, int peak, int to, double opacity, double reference_length_m) {
    scene::TransferFunction tf;
    tf.reference_length = reference_length_m;
    tf.opacity = {{from / 255.0, 0.0}, {peak / 255.0, opacity}, {to / 255.0, 0.0}};
    tf.color = {{from / 255.0, {0.15, 0.35, 0.75}}, {to / 255.0, {0.95, 0.65, 0.25}}};
    return tf;
}

BenchScene bench_scene(const std::string& name, const scene::TransferFunction& tf, double aspect) {
    scene::Volume volume;
    volume.source.file = "builtin:" + name;
    volume.grid = scene::builtin_volume(name);
    volume.transfer_function = tf;
    BenchScene result{name, {}};
    scene::Node node;
    node.content = std::move(volume);
    result.scene.nodes[name] = std::move(node);
    result.scene.background = scene::Background{.top = {0.02, 0.02, 0.03}, .bottom = {0.10, 0.10, 0.12}};
    result.scene.camera = scene::fit_camera(scene::world_bounds(result.scene), aspect);
    return result;
}

}  // namespace

std::vector<BenchScene> default_bench_scenes(double aspect) {
    // A translucent shell, the classic surface of the test signal, and solid kernels in emptiness.
    scene::TransferFunction kernels = sharp_shell(60, 70, 255, 0.8, 1e-3);
    kernels.opacity = {{60 / 255.0, 0.0}, {70 / 255.0, 0.8}, {1.0, 0.9}};
    return {bench_scene("bucky", sharp_shell(90, 102, 114, 0.6, 0.5e-3), aspect),
            bench_scene("marschner-lobb-256", sharp_shell(122, 127, 132, 0.5, 1e-3), aspect),
            bench_scene("blobs", kernels, aspect)};
}

}  // namespace bruma::measure
