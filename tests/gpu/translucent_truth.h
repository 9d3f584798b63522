#pragma once
#include <cmath>
#include <string>
#include <vector>

#include "reference/subsurface/subsurface_view.h"
#include "translucent.h"

/// Pictures of one translucent body by the passes and by quadrature in double precision, and how far they are apart.
namespace bruma::render {

/// The same mesh for the reference, in the world's metres.
inline reference::TriangleMesh for_reference(const scene::TriangleMesh& mesh, const glm::dmat4& world_from_model) {
    reference::TriangleMesh copy;
    const glm::dmat3 normals = glm::transpose(glm::inverse(glm::dmat3(world_from_model)));
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
        copy.positions.emplace_back(world_from_model * glm::dvec4(mesh.positions[n], 1.0));
        copy.normals.push_back(glm::normalize(normals * glm::dvec3(mesh.normals[n])));
    }
    const bool mirrored = glm::determinant(glm::dmat3(world_from_model)) < 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        copy.triangles.push_back(mirrored ? glm::uvec3(t.x, t.z, t.y) : t);
    }
    return copy;
}

inline reference::SubsurfaceMedium for_reference(const scene::SubsurfaceMedium& medium) {
    return {medium.absorption, medium.scattering(), medium.asymmetry, medium.refraction_index};
}

/// The scene's one mesh under all of its lights by quadrature of the directional dipole, to half a percent.
inline Image quadrature_picture(const scene::Scene& scene, glm::ivec2 pixels) {
    const auto& [name, node] = *scene.nodes.begin();
    const auto& mesh = std::get<scene::Mesh>(node.content);
    std::vector<scene::Light> lights;
    for (const auto& [lamp, light] : scene.lights) {
        lights.push_back(*light);
    }
    reference::SubsurfaceViewOptions options;
    options.model = reference::SubsurfaceModel::directional_dipole;
    options.quadrature.tolerance = 5e-3;
    return reference::render_subsurface(for_reference(**mesh.triangles, scene::world_from_model(scene, name)),
                                        for_reference(scene::medium_of(*mesh.surface)), lights, **scene.camera,
                                        pixels.x, pixels.y, options)
        .image;
}

/// Differences of all channels of the pixels that show the body, as shares of what is expected there; below 1/50 of the
/// brightest of that.
struct Apart {
    double rmse = 0.0, mean = 0.0;
    double of_all = 0.0;  ///< of the sum over the picture
    int compared = 0;
};
inline Apart apart(const Image& found, const Image& expected) {
    double brightest = 0.0;
    for (std::size_t n = 0; n < expected.pixel_count(); ++n) {
        for (std::size_t c = 0; c < 3; ++c) {
            brightest = std::max(brightest, expected.rgba[4 * n + 3] == 1.0F ? double(expected.rgba[4 * n + c]) : 0.0);
        }
    }
    Apart result;
    double sum_found = 0.0, sum_expected = 0.0;
    for (std::size_t n = 0; n < expected.pixel_count(); ++n) {
        if (found.rgba[4 * n + 3] < 1.0F || expected.rgba[4 * n + 3] < 1.0F) {
            continue;
        }
        for (std::size_t c = 0; c < 3; ++c) {
            const double a = found.rgba[4 * n + c], b = expected.rgba[4 * n + c];
            const double error = (a - b) / (b + 0.02 * brightest);
            result.rmse += error * error;
            result.mean += error;
            sum_found += a;
            sum_expected += b;
            ++result.compared;
        }
    }
    result.rmse = std::sqrt(result.rmse / result.compared);
    result.mean /= result.compared;
    result.of_all = sum_found / sum_expected - 1.0;
    return result;
}
inline void report(const std::string& what, const Apart& apart) {
    report(what + ": relative RMSE", apart.rmse);
    report(what + ": mean relative error", apart.mean);
    report(what + ": error of the sum", apart.of_all);
}

/// No maps: each pixel from 4096 points of each lamp.
inline void work_out_each_pixel(scene::Scene& scene) {
    std::get<scene::Mesh>(scene.nodes.begin()->second.content).subsurface.edit([](scene::SubsurfaceSettings& settings) {
        settings.maps = 0;
        settings.samples = 64;
    });
}
constexpr int passes_of_each_pixel = 64;

}  // namespace bruma::render
