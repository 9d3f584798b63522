#include "measure/bench/mesh/bench_mesh_sampling.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "measure/bench/mesh/mesh_truth.h"
#include "reference/subsurface/subsurface_noise.h"
#include "reference/subsurface/subsurface_sampling.h"
#include "render/renderer.h"
#include "scene/builtin/mesh_builtin.h"

namespace bruma::measure {
namespace {

constexpr double ball_radius = 10.0;  // mm
constexpr std::array materials{scene::Material::cream, scene::Material::marble};

std::string name_of(scene::Material material) {
    return std::string(scene::enum_words<scene::Material>()[std::size_t(material)]);
}

/// On an endless half-space the disk is as published and nothing cuts it.
SamplingNoise noise_on_slab(const reference::SubsurfaceMedium& medium, const reference::Dipole& dipole) {
    const auto disk = reference::ExponentialDisk::published(medium, 1e3);
    const reference::CoreTailDensity ours(medium, 1e3);
    const double rate = std::min(disk.rate(), dipole.diffusion().sigma_tr);
    SamplingNoise noise;
    noise.place = "lit slab";
    noise.ours = reference::lit_slab_moments(dipole, rate, reference::pdf_of(ours)).deviation();
    noise.disk = noise.cut_disk =
        reference::lit_slab_moments(dipole, rate, reference::pdf_of(disk), disk.radius()).deviation();
    return noise;
}

SamplingNoise noise_on_ball(const reference::SubsurfaceMedium& medium, const reference::Dipole& dipole, double cosine) {
    const reference::SurfacePoint exit = reference::on_sphere(ball_radius, cosine);
    const auto disk = reference::ExponentialDisk::published(medium, ball_radius);
    const auto cut = disk.cut_to(ball_radius);
    const auto deviation = [&](const reference::PlaneDensity& pdf) {
        return reference::sphere_moments(dipole, medium.eta, ball_radius, exit, pdf).deviation();
    };
    SamplingNoise noise;
    noise.is_lit = cosine > 0.0;
    noise.place = noise.is_lit ? "lit pole" : cosine > -1.0 ? "behind, 120 degrees from the lamp" : "back pole";
    noise.disk = deviation(reference::pdf_of(disk));
    noise.cut_disk = deviation(reference::pdf_of(cut));
    if (noise.is_lit) {
        noise.ours = deviation(reference::pdf_of(reference::CoreTailDensity(medium, ball_radius)));
    } else {
        const reference::BackLitDensity back(medium, -2.0 * exit.position.z, {-glm::dvec2(exit.position), ball_radius});
        noise.ours = deviation(reference::pdf_of(back));
    }
    return noise;
}

/// A picture of the middle of the ball, seen along the light or against it.
scene::Scene race_scene(scene::Material material, bool is_lit) {
    scene::Scene scene = translucent_body("mesh-sphere", material, {0.0, 0.0, is_lit ? 1.0 : -1.0});
    auto& mesh = std::get<scene::Mesh>(scene.nodes.at("body").content);
    mesh.subsurface.edit([](scene::SubsurfaceSettings& settings) {
        settings.model = scene::SubsurfaceModel::directional_dipole;
        settings.maps = 4;
        settings.map_size = 32;
        settings.samples = 8;
        settings.light_map_size = 512;
    });
    scene.camera->edit([](scene::Camera& camera) {
        camera.projection = scene::Projection::orthographic;
        camera.view_height = 1.2e-3 * ball_radius;  // cosines above 0.53 to its corners
    });
    return scene;
}

/// Root mean square over pixels and colours of the difference as a share of the truth.
double relative_rmse(const Image& picture, const Image& truth) {
    double squares = 0.0;
    for (std::size_t n = 0; n < truth.pixel_count(); ++n) {
        for (std::size_t k = 4 * n; k < 4 * n + 3; ++k) {
            const double share = (double(picture.rgba[k]) - double(truth.rgba[k])) / std::max(1e-30F, truth.rgba[k]);
            squares += share * share;
        }
    }
    return std::sqrt(squares / (3.0 * double(truth.pixel_count())));
}

}  // namespace

scene::Scene translucent_body(const std::string& builtin, scene::Material material, glm::dvec3 to_light) {
    scene::Mesh mesh;
    mesh.source.file = "builtin:" + builtin;
    mesh.source.millimetres_per_unit = 1.0;
    mesh.triangles = scene::builtin_mesh(builtin, mesh.source).mesh;
    mesh.surface.edit([material](scene::MeshSurface& surface) { surface.material = material; });
    scene::Scene scene;
    scene.nodes["body"].content = std::move(mesh);
    make_body_scene(scene, "body");
    scene.lights["sun"] = scene::Light{.direction_world = to_light};
    scene.camera = scene::fit_camera(scene::world_bounds(scene), 1.0, {0.0, 0.0, 1.0});
    return scene;
}

std::vector<SamplingNoise> measure_sampling_noise() {
    std::vector<SamplingNoise> all;
    for (const scene::Material material : materials) {
        const reference::SubsurfaceMedium medium = reference_medium(scene::medium_of(material));
        for (const double cosine : {2.0, 1.0, -0.5, -1.0}) {  // beyond 1: the slab
            for (int channel = 0; channel < 3; ++channel) {
                const reference::Dipole dipole(medium.channel(channel), reference::SubsurfaceModel::directional_dipole);
                SamplingNoise noise =
                    cosine > 1.0 ? noise_on_slab(medium, dipole) : noise_on_ball(medium, dipole, cosine);
                noise.material = name_of(material);
                noise.channel = channel;
                all.push_back(std::move(noise));
            }
        }
    }
    return all;
}

std::vector<SamplingRace> race_samplings(gl::ShaderLibrary& shaders, bool quick) {
    const int passes = quick ? 4 : 16;
    const glm::ivec2 pixels(24, 24);
    std::vector<SamplingRace> races;
    for (const scene::Material material : materials) {
        for (const bool is_lit : {true, false}) {
            scene::Scene scene = race_scene(material, is_lit);
            render::Renderer renderer(shaders);
            SamplingRace race{name_of(material), is_lit ? "lit side of a ball" : "dark side of a ball", is_lit};
            const auto drawn = [&](scene::SubsurfaceSampling sampling, int count) {
                std::get<scene::Mesh>(scene.nodes.at("body").content)
                    .subsurface.edit([&](scene::SubsurfaceSettings& settings) { settings.sampling = sampling; });
                renderer.render(scene, {pixels, 1.0, {.samples = count}});
                race.evaluations = renderer.translucent_standing()->evaluations;
                return renderer.read_picture();
            };
            const Image disk = drawn(scene::SubsurfaceSampling::exponential_disk, passes);
            const Image ours = drawn(scene::SubsurfaceSampling::core_tail, passes);
            const std::uint64_t evaluations = race.evaluations;
            const Image truth = drawn(scene::SubsurfaceSampling::core_tail, 16 * passes);
            race.evaluations = evaluations;
            race.ours = relative_rmse(ours, truth);
            race.disk = relative_rmse(disk, truth);
            races.push_back(std::move(race));
        }
    }
    return races;
}

}  // namespace bruma::measure
