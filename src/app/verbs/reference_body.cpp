#include "app/verbs/reference_body.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/log.h"
#include "measure/bench/mesh/mesh_truth.h"
#include "reference/pixel_loop.h"

namespace bruma::app {
namespace {

/// The name of the one mesh that the scene shows.
std::string require_one_body(const scene::Scene& scene) {
    const std::vector<std::string> meshes = scene::shown_meshes(scene);
    const std::vector<std::string> volumes = scene::shown_volumes(scene);
    const auto hide = [](const std::string& name) { return fmt::format("--set nodes.{}.visible=false", name); };
    if (!volumes.empty()) {
        throw InputError(fmt::format(
            "nodes.{}: a volume beside a mesh, and there is no reference of both; {} leaves it out, {} the mesh",
            volumes.front(), hide(volumes.front()), hide(meshes.front())));
    }
    if (scene.outdoors) {
        throw InputError(
            fmt::format("nodes.{}: there is no reference of meshes under a sky; give the scene a lamp "
                        "instead of sun and sky",
                        meshes.front()));
    }
    if (meshes.size() > 1) {
        throw InputError(
            fmt::format("nodes.{}: the reference knows one mesh at a time, and {} are shown; {} leaves one out",
                        meshes[1], meshes.size(), hide(meshes[1])));
    }
    const auto& mesh = std::get<scene::Mesh>(scene.nodes.at(meshes.front()).content);
    if (mesh.surface->shading != scene::MeshShading::translucent) {
        throw InputError(
            fmt::format("nodes.{}.shading: opaque, and the reference knows light inside meshes only; --set "
                        "mesh.shading=translucent, or {}",
                        meshes.front(), hide(meshes.front())));
    }
    return meshes.front();
}

/// What a picture of this scene has besides the light from within.
void say_what_is_left_out(const scene::Scene& scene, const scene::Mesh& mesh) {
    std::vector<std::string> settings;
    const auto left_out = [&](bool there, const char* setting) {
        if (there) {
            settings.emplace_back(setting);
        }
    };
    left_out(mesh.subsurface->highlight, "mesh.subsurface.highlight=false");
    left_out(mesh.subsurface->unscattered, "mesh.subsurface.unscattered=false");
    const std::vector<scene::MeshMaterial>& materials = (*mesh.triangles)->materials;
    const bool has_textures = std::any_of(materials.begin(), materials.end(), [](const scene::MeshMaterial& material) {
        return material.diffuse_texture != nullptr;
    });
    left_out(mesh.surface->textured && has_textures, "mesh.textured=false");
    left_out(mesh.surface->file_materials && !(*mesh.triangles)->colors.empty(), "mesh.file_materials=false");
    left_out(scene.environment->radiance != glm::dvec3(0.0), "environment.radiance=0,0,0");
    if (!settings.empty()) {
        log_warning(
            "the reference shows the light of lamps from within alone; a picture to compare it with needs --set {}",
            fmt::join(settings, " --set "));
    }
}

}  // namespace

DrawnReference draw_body_reference(const scene::Scene& scene, glm::ivec2 pixels, const BodyReferenceOptions& options) {
    const std::string name = require_one_body(scene);
    const auto& mesh = std::get<scene::Mesh>(scene.nodes.at(name).content);
    say_what_is_left_out(scene, mesh);
    std::vector<scene::Light> lamps;
    for (const auto& [lamp_name, lamp] : scene.lights) {
        lamps.push_back(*lamp);
    }
    const bool photons = options.method == reference::SubsurfaceMethod::random_walk;
    reference::SubsurfaceViewOptions how;
    how.method = options.method;
    how.model = measure::reference_model(mesh.subsurface->model);
    how.quadrature.tolerance = options.tolerance.value_or(how.quadrature.tolerance);
    how.paths = options.photons;
    how.seed = options.seed;
    how.progress = options.progress;
    reference::SubsurfaceView view = reference::render_subsurface(
        measure::reference_mesh(scene, name), measure::reference_medium(scene::medium_of(*mesh.surface)), lamps,
        **scene.camera, pixels.x, pixels.y, how);
    DrawnReference drawn;
    float largest = 0.0F;
    for (const glm::vec3& channels : view.error) {
        drawn.error.push_back(std::max({channels.x, channels.y, channels.z}));
        largest = std::max(largest, drawn.error.back());
    }
    reference::for_each_pixel(scene, pixels.x, pixels.y, {}, [&](const reference::Pixel& pixel) {
        float* const rgba = view.image.pixel(pixel.x, pixel.y);
        for (int k = 0; k < 3; ++k) {
            rgba[k] += (1.0F - rgba[3]) * float(pixel.background[k]);
        }
    });
    drawn.image = std::move(view.image);
    drawn.findings =
        photons ? fmt::format(
                      "light inside {} by photons, standard error: at most {:.2g}, RMS {:.2g} (display range 1); "
                      "{:.2g} M entered, {} lost",
                      name, largest, view.rms_error, 1e-6 * double(view.paths), view.lost)
                : fmt::format(
                      "light inside {} by quadrature of its model, stated error: at most {:.2g}, RMS {:.2g} "
                      "(display range 1); {:.1f} M evaluations",
                      name, largest, view.rms_error, 1e-6 * double(view.evaluations));
    return drawn;
}

}  // namespace bruma::app
