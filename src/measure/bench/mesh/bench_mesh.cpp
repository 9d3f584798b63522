#include "measure/bench/mesh/bench_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "base/error.h"
#include "base/installation.h"
#include "measure/bench/bench_frames.h"
#include "measure/bench/mesh/bench_mesh_report.h"
#include "measure/bench/mesh/mesh_truth.h"
#include "render/renderer.h"

namespace bruma::measure {
namespace {

using scene::SubsurfaceModel;
constexpr std::array models{SubsurfaceModel::standard_dipole, SubsurfaceModel::directional_dipole,
                            SubsurfaceModel::normalised_dipole};

struct Truths {
    std::array<Image, models.size()> quadrature;
    Image walk;
    std::vector<bool> counts;  ///< pixels that are compared
};

double seconds_since(std::chrono::steady_clock::time_point then) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

/// Pixels that show the body as all around them do: photons are counted over a pixel's area, the others at its centre.
std::vector<bool> inner_pixels(const Image& image) {
    std::vector<bool> inner(image.pixel_count(), false);
    for (int y = 1; y + 1 < image.height; ++y) {
        for (int x = 1; x + 1 < image.width; ++x) {
            bool all = true;
            for (int n = 0; n < 9; ++n) {
                all = all && image.pixel(x + n % 3 - 1, y + n / 3 - 1)[3] == 1.0F;
            }
            inner[std::size_t(y) * std::size_t(image.width) + std::size_t(x)] = all;
        }
    }
    return inner;
}

Truths find_truths(const scene::Scene& scene, const MeshBenchOptions& options, MeshBenchScene& result) {
    const std::string node = scene::shown_meshes(scene).front();
    const auto& mesh = std::get<scene::Mesh>(scene.nodes.at(node).content);
    const reference::TriangleMesh triangles = reference_mesh(scene, node);
    const reference::SubsurfaceMedium medium = reference_medium(scene::medium_of(*mesh.surface));
    const std::vector<scene::Light> lamps{*scene.lights.begin()->second};
    reference::SubsurfaceViewOptions how;
    how.quadrature.tolerance = options.reference_tolerance;
    how.paths = options.photons;
    const auto view = [&] {
        return reference::render_subsurface(triangles, medium, lamps, **scene.camera, options.pixels.x,
                                            options.pixels.y, how);
    };
    Truths truths;
    auto start = std::chrono::steady_clock::now();
    for (std::size_t n = 0; n < models.size(); ++n) {
        how.model = reference_model(models[n]);
        const reference::SubsurfaceView quadrature = view();
        result.quadrature_rms_error = std::max(result.quadrature_rms_error, quadrature.rms_error);
        truths.quadrature[n] = quadrature.image;
    }
    result.quadrature_seconds = seconds_since(start);
    start = std::chrono::steady_clock::now();
    how.method = reference::SubsurfaceMethod::random_walk;
    const reference::SubsurfaceView walk = view();
    result.walk_seconds = seconds_since(start);
    truths.walk = walk.image;
    truths.counts = inner_pixels(truths.walk);
    // The same unit for all, so that errors of one picture against two truths can be compared.
    result.white = display_white(truths.quadrature.back());
    result.quadrature_rms_error /= result.white;
    double squares = 0.0;
    for (std::size_t n = 0; n < walk.error.size(); ++n) {
        if (truths.counts[n]) {
            squares += glm::dot(glm::dvec3(walk.error[n]), glm::dvec3(walk.error[n]));
            ++result.pixels;
        }
    }
    const double numbers = 3.0 * double(std::max<std::size_t>(1, result.pixels));
    result.walk_rms_error = std::sqrt(squares / numbers) / result.white;
    result.walk_bias_error = result.walk_rms_error / std::sqrt(numbers);  // photons of other pixels are others
    result.lost_share = double(walk.lost) / double(std::max<std::uint64_t>(1, walk.paths));
    return truths;
}

struct Settings {
    std::vector<int> maps, sizes, passes;
};
Settings settings_of(const MeshBenchOptions& options) {
    return options.quick ? Settings{{4, 8}, {32, 64}, {1, 8}} : Settings{{4, 8, 16}, {32, 64, 128}, {1, 4, 16}};
}

/// Draws one body again and again. Blinn-Phong frames alternate with those that are compared to them, so that whatever
/// else the machine does meets both alike.
class Body {
  public:
    Body(gl::ShaderLibrary& shaders, const scene::Scene& scene, const MeshBenchOptions& options)
        : options_(options), lit_(shaders), opaque_(shaders), scene_(scene), opaque_scene_(scene) {
        node_ = scene::shown_meshes(scene).front();
        std::get<scene::Mesh>(opaque_scene_.nodes.at(node_).content).surface.edit([](scene::MeshSurface& surface) {
            surface.shading = scene::MeshShading::blinn_phong;
        });
        opaque_.render(opaque_scene_, {options_.frame_pixels, 1.0}, true);
    }

    void measure(const Truths& truths, MeshBenchScene& result) {
        const Settings all = settings_of(options_);
        for (std::size_t model = 0; model < models.size(); ++model) {
            compile(models[model]);
            for (const int maps : all.maps) {
                for (const int size : all.sizes) {
                    measure_passes(truths, result, model, maps, size, all.passes);
                    if (models[model] == SubsurfaceModel::normalised_dipole) {
                        result.combinations.push_back(time_combination(maps, size));
                    }
                }
            }
        }
        result.frame_ms = median(frames_ms_);
        result.opaque_ms = median(opaques_ms_);
    }

  private:
    /// The small pictures that are compared would look up few texels: their cost is that of whole maps.
    void set(SubsurfaceModel model, int maps, int size, bool whole_maps) {
        std::get<scene::Mesh>(scene_.nodes.at(node_).content).subsurface.edit([&](scene::SubsurfaceSettings& settings) {
            settings.model = model;
            settings.maps = maps;
            settings.map_size = size;
            settings.whole_maps = whole_maps;
        });
    }
    render::View view(glm::ivec2 pixels, int passes) const {
        render::View view{pixels, 1.0};
        view.paths.samples = passes;
        return view;
    }
    /// Shaders are compiled when they are first used; that is no part of any time.
    void compile(SubsurfaceModel model) {
        set(model, 1, 16, false);
        lit_.render(scene_, view(options_.pixels, 1));
        lit_.render(scene_, view(options_.frame_pixels, 1));
    }

    void measure_passes(const Truths& truths, MeshBenchScene& result, std::size_t model, int maps, int size,
                        const std::vector<int>& passes) {
        set(models[model], maps, size, true);
        const int samples = int(std::get<scene::Mesh>(scene_.nodes.at(node_).content).subsurface->samples);
        double build_ms = 0.0, frames = 0.0;
        for (const int count : passes) {
            const double frame_ms = opaque_frame().wall_ms;
            double ms = 0.0;
            for (const render::PassReport& pass : lit_.render(scene_, view(options_.pixels, count), true)) {
                ms += pass.ran && pass.name.starts_with(node_ + ": ") ? pass.gpu_ms : 0.0;
            }
            build_ms += ms;
            frames += ms / frame_ms;
            const Image picture = lit_.read_picture();
            MeshBenchRow row;
            row.model = models[model];
            row.maps = maps;
            row.map_size = size;
            row.passes = count;
            row.samples = count * samples;
            row.evaluations = lit_.translucent_standing()->evaluations;
            row.quadrature = display_error(picture, truths.quadrature[model], result.white, truths.counts);
            row.walk = display_error(picture, truths.walk, result.white, truths.counts);
            row.build_ms = build_ms;
            row.build_over_frame = frames;
            result.rows.push_back(row);
        }
    }

    struct Frame {
        double wall_ms = 0.0, opaque_ms = 0.0;
    };
    /// A frame whose view alone is new.
    Frame frame(render::Renderer& renderer, scene::Scene& scene, const render::View& view, int& turn) const {
        const scene::Camera before = **scene.camera;
        scene.camera->set(orbited(before, turn++ % 2 == 0 ? 0.2 : -0.2));
        Frame times;
        const Duration took = drained([&] {
            for (const render::PassReport& pass : renderer.render(scene, view, true)) {
                const bool draws =
                    pass.name == "opaque" || pass.name == "map reads" || pass.name == node_ + ": radiosity";
                times.opaque_ms += pass.ran && draws ? pass.gpu_ms : 0.0;
            }
        });
        times.wall_ms = took.wall_ms;
        return times;
    }
    Frame opaque_frame() {
        const Frame times = frame(opaque_, opaque_scene_, view(options_.frame_pixels, 1), opaque_turn_);
        frames_ms_.push_back(times.wall_ms);
        opaques_ms_.push_back(times.opaque_ms);
        return times;
    }
    MeshCombination time_combination(int maps, int size) {
        const scene::Scene still = scene_;
        MeshCombination row{maps, size};
        const render::View large = view(options_.frame_pixels, 1);
        set(SubsurfaceModel::normalised_dipole, maps, size, false);
        lit_.render(scene_, large);
        const auto standing = lit_.translucent_standing();
        row.read_texels = standing->read_texels;
        row.all_texels = standing->all_texels;
        std::vector<double> pass_ms, pass_ratios, frame_ratios;
        int turn = 0;
        frame(lit_, scene_, large, turn);  // from here on there and back
        frame(lit_, scene_, large, turn);
        for (int n = 0; n < std::max(3, options_.repeats); ++n) {
            const Frame opaque = opaque_frame();
            const Frame lit = frame(lit_, scene_, large, turn);
            pass_ms.push_back(lit.opaque_ms);
            pass_ratios.push_back(lit.opaque_ms / opaque.opaque_ms);
            frame_ratios.push_back(lit.wall_ms / opaque.wall_ms);
        }
        row.pass_ms = median(pass_ms);
        row.pass_over_opaque = median(pass_ratios);
        row.frame_over_frame = median(frame_ratios);
        scene_ = still;  // with the camera of the pictures that are compared
        return row;
    }

    const MeshBenchOptions& options_;
    render::Renderer lit_, opaque_;
    scene::Scene scene_, opaque_scene_;
    std::string node_;
    int opaque_turn_ = 0;
    std::vector<double> frames_ms_, opaques_ms_;
};

}  // namespace

std::vector<BenchScene> default_mesh_scenes(double aspect) {
    using scene::Material;
    std::vector<BenchScene> scenes{
        {"ball of potato, lit from the side", translucent_body("mesh-sphere", Material::potato, {0.9, 0.3, 0.35})},
        {"knot of skin, lit from the front", translucent_body("mesh-knot", Material::skin1, {0.5, 0.4, 0.8})},
        {"ball of marble, lit from behind", translucent_body("mesh-sphere", Material::marble, {0.5, 0.3, -0.8})}};
    for (BenchScene& scene : scenes) {
        scene.scene.camera = scene::fit_camera(scene::world_bounds(scene.scene), aspect, {0.1, 0.2, 1.0});
        scene.scene.camera->edit([](scene::Camera& camera) { camera.vertical_angle_deg *= 0.75; });
    }
    return scenes;
}

void make_mesh_scene(const std::string& name, scene::Scene& scene) {
    const std::vector<std::string> shown = scene::shown_meshes(scene);
    if (shown.size() != 1) {
        throw InputError(
            fmt::format("{}: shows {} meshes, but the bench of meshes wants exactly one in each scene; hide the others "
                        "with --set nodes.NAME.visible=false",
                        name, shown.size()));
    }
    make_body_scene(scene, shown.front());
    scene.lights.clear();
    scene.lights["sun"] = scene::Light{};
}

MeshBench run_mesh_bench(const std::vector<BenchScene>& scenes, const MeshBenchOptions& options) {
    MeshBench bench{describe_machine(), options, {}, {}, {}};
    gl::ShaderLibrary shaders(installed_folder("shaders"));
    const auto say = [&](const std::string& line) {
        if (options.say) {
            options.say(line);
        }
    };
    for (const BenchScene& scene : scenes) {
        MeshBenchScene result;
        result.name = scene.name;
        const Truths truths = find_truths(scene.scene, options, result);
        say(fmt::format("{}: quadrature of {} models in {:.1f} s, {} photons in {:.1f} s", scene.name, models.size(),
                        result.quadrature_seconds, 3 * options.photons, result.walk_seconds));
        Body(shaders, scene.scene, options).measure(truths, result);
        bench.scenes.push_back(std::move(result));
        say(fmt::format("{}: {}", scene.name, finding_quadrature(bench.scenes.back())));
    }
    bench.noise = measure_sampling_noise();
    bench.races = race_samplings(shaders, options.quick);
    return bench;
}

}  // namespace bruma::measure
