#include <fmt/core.h>

#include <algorithm>
#include <random>
#include <type_traits>

#include "measure/stress/stress_rig.h"
#include "measure/stress/stress_scenes.h"

namespace bruma::measure {
namespace {

/// Draws every field of a struct over its whole range; where that spans decades, evenly in the logarithm, with the
/// ends themselves now and then. The same scenes on every machine: no distribution of the library is used.
class Draw {
  public:
    explicit Draw(std::uint64_t seed) : generator_(seed) {}

    double share() { return double(generator_() >> 11) * 0x1p-53; }
    bool chance(double p) { return share() < p; }
    int below(int n) { return std::min(n - 1, int(share() * n)); }
    double log_between(double low, double high) { return low * std::pow(high / low, share()); }

    double in(double low, double high) {
        // Without an end: a million, which is far for a position in metres and for an angle in degrees.
        low = std::max(low, -1e6);
        high = std::min(high, 1e9 * 1e3);
        high = std::isfinite(high) ? high : 1e6;
        const double which = share();
        if (which < 0.03) {
            return low;
        }
        if (which < 0.06) {
            return high;
        }
        if (low < 0.0) {
            return (chance(0.5) ? 1.0 : -1.0) * log_between(1e-6, std::min(-low, high));
        }
        return high > 50.0 * std::max(low, 0.02) ? log_between(std::max(low, high * 1e-24), high)
                                                 : low + (high - low) * share();
    }

    void operator()(const scene::Field&, bool& value) { value = chance(0.5); }
    void operator()(const scene::Field& field, double& value) { value = in(field.min, field.max); }
    void operator()(const scene::Field&, std::int64_t&) {}  // sizes of maps, which no volume uses
    void operator()(const scene::Field& field, glm::dvec3& value) {
        for (int k = 0; k < 3; ++k) {
            value[k] = in(field.min, std::min(field.max, 1e6));
        }
    }
    template <class Enum>
    requires std::is_enum_v<Enum>
    void operator()(const scene::Field&, Enum& value) { value = Enum(below(int(scene::enum_words<Enum>().size()))); }
    void operator()(const scene::Field&, std::array<double, 2>& value) {
        value = chance(0.7) ? std::array{0.0, 1.0} : std::array{in(-1e6, 1e6), in(-1e6, 1e6)};
    }
    void operator()(const scene::Field&, std::optional<std::array<double, 2>>& value) {
        value.reset();
        if (chance(0.4)) {
            value = chance(0.7) ? std::array{share(), share()} : std::array{in(-1e6, 1e6), in(-1e6, 1e6)};
        }
    }
    void operator()(const scene::Field&, std::vector<scene::OpacityPoint>& points) {
        points.clear();
        for (int n = below(8); n >= 0; --n) {
            points.push_back({position(), chance(0.3) ? 0.0 : chance(0.1) ? 1.0 : share()});
        }
    }
    void operator()(const scene::Field&, std::vector<scene::ColorPoint>& points) {
        points.clear();
        for (int n = below(4); n > 0; --n) {
            const double most = chance(0.1) ? 1e6 : 1.0;
            points.push_back({position(), most * glm::dvec3(share(), share(), share())});
        }
    }
    void operator()(const scene::Field&, std::vector<scene::EmissionPoint>& points) {
        points.clear();
        for (int n = chance(0.3) ? below(4) : 0; n > 0; --n) {
            points.push_back({position(), chance(0.1) ? 1e6 : share()});
        }
    }

    template <class T>
    T all_fields() {
        T value{};
        visit_fields(value, *this);
        return value;
    }

  private:
    /// On a lattice now and then, so that points coincide.
    double position() { return chance(0.3) ? double(below(5)) / 4.0 : share(); }

    std::mt19937_64 generator_;
};

std::shared_ptr<const scene::VolumeGrid> random_grid(Draw& draw) {
    const glm::ivec3 size(1 + draw.below(16), 1 + draw.below(16), 1 + draw.below(16));
    const auto seed = std::uint32_t(draw.below(1 << 30));
    // Half of it empty, in lumps, so that there is something to skip.
    const auto sample = [&](std::size_t n) {
        return stress_noise(n / 64, seed + 1) < 0.5 ? 0.0 : stress_noise(n, seed);
    };
    switch (draw.below(4)) {
        case 0:
            return typed_grid<std::uint8_t>(scene::VoxelType::uint8, size,
                                            [&](std::size_t n) { return 255.0 * sample(n); });
        case 1:
            return typed_grid<std::int16_t>(scene::VoxelType::int16, size,
                                            [&](std::size_t n) { return 65535.0 * sample(n) - 32768.0; });
        case 2:
            return float_grid(size, [&](std::size_t n) { return 1e30 * (sample(n) - 0.5); });
        default:
            return float_grid(size, sample);
    }
}

/// The parts that scene::check refuses are put right: they never reach a renderer.
void add_random_volume(Draw& draw, scene::Scene& scene, const std::string& name, double size) {
    auto tf = draw.all_fields<scene::TransferFunction>();
    tf.domain[1] += tf.domain[0] == tf.domain[1] ? 1.0 : 0.0;
    scene::normalise(tf);
    auto transform = draw.all_fields<scene::Transform>();
    // One size for all, with moderate differences: the number of steps is the ratio of the largest to the smallest.
    for (int k = 0; k < 3; ++k) {
        transform.scale[k] = (transform.scale[k] < 0.0 ? -1.0 : 1.0) * size * draw.log_between(0.2, 5.0);
        transform.translation[k] = size * 1e-2 * (draw.share() - 0.5);
    }
    add_volume(scene, name, random_grid(draw), tf, transform);
    scene::Volume& volume = stress_volume(scene, name);
    auto optics = draw.all_fields<scene::VolumeOptics>();
    if (optics.gradient_soft_from > optics.gradient_soft_to) {
        std::swap(optics.gradient_soft_from, optics.gradient_soft_to);
    }
    volume.optics = optics;
    auto clip = draw.all_fields<scene::ClipBox>();
    for (int k = 0; k < 3; ++k) {
        if (draw.chance(0.6) || clip.low[k] == clip.high[k]) {
            clip.low[k] = 0.0;
            clip.high[k] = 1.0;
        } else if (clip.low[k] > clip.high[k]) {
            std::swap(clip.low[k], clip.high[k]);
        }
    }
    volume.clip = clip;
}

scene::Scene random_scene(std::uint64_t seed) {
    Draw draw(seed);
    scene::Scene scene;
    const double size = draw.chance(0.5) ? 1.0 : draw.log_between(1e-9, 1e9);
    const int volumes = draw.chance(0.75) ? 1 : 2;
    for (int n = 0; n < volumes; ++n) {
        add_random_volume(draw, scene, fmt::format("volume-{}", n), size);
    }
    scene.background = draw.all_fields<scene::Background>();
    scene.rendering = draw.all_fields<scene::RenderSettings>();
    for (int n = draw.below(3); n > 0; --n) {
        auto light = draw.all_fields<scene::Light>();
        light.direction_world += light.direction_world == glm::dvec3(0.0) ? glm::dvec3(1.0) : glm::dvec3(0.0);
        light.position_world *= draw.chance(0.5) ? size * 1e-8 : 1.0;
        scene.lights[fmt::format("light-{}", n)] = light;
    }
    auto camera = draw.all_fields<scene::Camera>();
    if (draw.chance(0.8)) {
        // One that sees something, with all other fields as drawn.
        const scene::Bounds bounds = scene::world_bounds(scene);
        const glm::dvec3 way(draw.share() - 0.5, draw.share() - 0.5, draw.share() - 0.5);
        const scene::Camera fitted = scene::fit_camera(bounds, 1.5, way, camera.up_world);
        const double nearer = draw.chance(0.3) ? draw.share() : 1.0;
        camera.target_world = fitted.target_world;
        camera.eye_world = glm::mix(fitted.target_world, fitted.eye_world, std::max(nearer, 1e-3));
        camera.view_height = fitted.view_height;
        camera.near_distance = draw.chance(0.5) ? 0.0 : fitted.near_distance;
    }
    if (camera.eye_world == camera.target_world) {
        camera.eye_world.z += 1.0;
    }
    scene.camera = camera;
    return scene;
}

/// What to look for first when a scene fails.
std::string words_of(const scene::Scene& scene) {
    const scene::RenderSettings& settings = *scene.rendering;
    const scene::Bounds bounds = scene::world_bounds(scene);
    const scene::Camera& camera = **scene.camera;
    const double away =
        glm::length(camera.eye_world - 0.5 * (bounds.low + bounds.high)) / glm::length(bounds.high - bounds.low);
    return fmt::format("{} volume(s), {}, step {:.2g}, stop {:.1g}, {}, {:.2g} extents away", scene.nodes.size(),
                       scene::enum_words<scene::Classification>()[std::size_t(settings.classification)], settings.step,
                       settings.early_termination ? settings.stop_transmittance : 0.0,
                       scene::enum_words<scene::Projection>()[std::size_t(camera.projection)], away);
}

}  // namespace

void stress_random(StressRig& rig, int count) {
    rig.group("random");
    for (int n = 0; n < count; ++n) {
        const scene::Scene scene = random_scene(std::uint64_t(n) + 1);
        rig.picture(fmt::format("scene-{}", n), words_of(scene), scene);
    }
}

}  // namespace bruma::measure
