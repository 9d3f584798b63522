// Shelf: the same picture elsewhere. What stands thousands of kilometres from the origin, camera and lamps beside it,
// is as sharp as at the origin.
#include <fmt/core.h>

#include <functional>

#include "io/open.h"
#include "io_temporary_folder.h"
#include "measure/metrics/image_error.h"
#include "translucent.h"

namespace bruma::render {
namespace {

constexpr glm::ivec2 pixels(48, 48);
constexpr glm::dvec3 far_away(5.0e6, -2.3e6, 3.1e6);

/// At that distance doubles end at 1e-9 m, 3e-8 of a pixel here, which is less than floats about the eye tell apart. So
/// pictures may differ by roundings of their floats, some 1e-7 of what is there, and by no pixel that falls on another
/// side of an edge: one alone is 7e-3. Coordinates in floats, to half a metre, would leave nothing to compare.
constexpr double most_rmse = 1e-5;

scene::Scene moved(scene::Scene scene, glm::dvec3 by) {
    scene.camera->edit([&](scene::Camera& camera) {
        camera.eye_world += by;
        camera.target_world += by;
    });
    for (auto& [name, light] : scene.lights) {
        light.edit([&](scene::Light& lamp) { lamp.position_world += by; });
    }
    for (auto& [name, node] : scene.nodes) {
        node.parent = "far";
    }
    scene.nodes["far"].transform = scene::Transform{.translation = by};
    return scene;
}

scene::Scene with_volume(scene::VolumeLighting lighting) {
    scene::Scene scene = scene_with(
        grid_of({12, 12, 12}, glm::dvec3(1.0 / 12.0),
                [](glm::ivec3 p) { return 0.5 + 0.5 * std::sin(0.9 * p.x) * std::cos(0.7 * p.y + 0.4 * p.z); }),
        rich_transfer_function(0.1));
    volume_in(scene).optics.edit([&](scene::VolumeOptics& optics) { optics.lighting = lighting; });
    scene.camera.emplace(oblique_camera(scene));
    scene.lights["sun"] = scene::Light{.kind = scene::LightKind::directional, .direction_world = {0.5, 0.8, 0.4}};
    scene.lights["lamp"] =
        scene::Light{.kind = scene::LightKind::point, .position_world = {-0.9, 0.7, 0.8}, .intensity = 2.0};
    return scene;
}

scene::Scene with_meshes(scene::LightKind kind) {
    scene::Scene scene = scene_seen_from(6.0, scene::Projection::perspective, 3.6);
    add_mesh(scene, "floor", quad_mesh(2.0F), glm::dvec3(1.0));
    add_mesh(scene, "ball", sphere_mesh(24), glm::dvec3(0.8, 0.6, 0.4),
             {.translation = {0.2, 0.1, 1.0}, .scale = glm::dvec3(0.5)});
    scene.lights["lamp"] = scene::Light{.kind = kind,
                                        .direction_world = {0.5, 0.3, 1.0},
                                        .position_world = {1.5, 1.0, 4.0},
                                        .spot_angle_deg = 40.0,
                                        .intensity = 4.0};
    return scene;
}

class FarCoordinates : public Drawing {
  protected:
    double rmse_of(const scene::Scene& scene) {
        const Image near = draw(scene, pixels);
        const Image far = draw(moved(scene, far_away), pixels);
        const double rmse = measure::compare_images(far, near).rmse;
        double most = 0.0;
        for (std::size_t n = 3; n < near.rgba.size(); n += 4) {
            most = std::max(most, double(near.rgba[n]));
        }
        EXPECT_GT(most, 0.1) << "nothing to be seen";
        return rmse;
    }
};

TEST_F(FarCoordinates, VolumesAreAsSharp) {
    for (const auto lighting : {scene::VolumeLighting::none, scene::VolumeLighting::gradient,
                                scene::VolumeLighting::light_volume, scene::VolumeLighting::shadow_rays}) {
        scene::Scene scene = with_volume(lighting);
        const auto word = scene::enum_words<scene::VolumeLighting>()[std::size_t(lighting)];
        EXPECT_LE(rmse_of(scene), most_rmse) << word;
        scene.camera->edit([](scene::Camera& camera) { camera.projection = scene::Projection::orthographic; });
        EXPECT_LE(rmse_of(scene), most_rmse) << word << ", parallel rays";
    }
}

TEST_F(FarCoordinates, PathsAreTheSame) {
    // A path whose random number falls within a rounding of a bound goes another way: of some 1e5 draws, each apart by
    // 1e-7, next to none; one changes a pixel by 1 at most, which is 0.012 of a picture of one path.
    EXPECT_LE(rmse_of(with_volume(scene::VolumeLighting::path_traced)), 0.012);
}

TEST_F(FarCoordinates, MeshesTheirShadowsAndHighlightsAreAsSharp) {
    for (const auto kind : {scene::LightKind::directional, scene::LightKind::point, scene::LightKind::spot}) {
        scene::Scene scene = with_meshes(kind);
        EXPECT_LE(rmse_of(scene), most_rmse) << int(kind);
        scene.nodes["volume"] = with_volume(scene::VolumeLighting::gradient).nodes.at("volume");
        scene.camera->edit([](scene::Camera& camera) { camera.projection = scene::Projection::orthographic; });
        EXPECT_LE(rmse_of(scene), most_rmse) << int(kind) << ", in a volume";
    }
}

TEST_F(FarCoordinates, LightInsideMeshesIsAsSharp) {
    scene::Scene scene;
    add_translucent(scene, "knot", builtin_triangles("mesh-sphere"), scene::medium_of(scene::Material::marble));
    scene.camera.emplace(parallel_camera_around(scene, {0.3, 0.4, 1.0}));
    scene.lights["lamp"] =
        scene::Light{.kind = scene::LightKind::point, .position_world = {0.03, 0.02, 0.04}, .intensity = 1e-3};
    // 20 mm across: doubles end at 1e-6 of a pixel there.
    EXPECT_LE(rmse_of(scene), most_rmse);
}

/// A ball of radius 5 in the text of an OBJ file.
std::string ball_text(glm::dvec3 middle) {
    const auto ball = builtin_triangles("mesh-sphere");  // of radius 10 mm
    std::string text;
    for (const glm::vec3& p : ball->positions) {
        const glm::dvec3 q = middle + 500.0 * glm::dvec3(p);
        text += fmt::format("v {:.17g} {:.17g} {:.17g}\n", q.x, q.y, q.z);
    }
    for (const glm::uvec3& t : ball->triangles) {
        text += fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
    }
    return text;
}

TEST_F(FarCoordinates, AFileInMapCoordinatesLooksLikeOneAtTheOrigin) {
    const io::TemporaryFolder folder;
    const auto picture = [&](const std::string& name, glm::dvec3 middle, const std::vector<std::string>& settings) {
        const std::string file = folder.write(name, ball_text(middle)).string();
        scene::Scene scene = io::open_files(std::vector{file}, {}, settings);
        scene.camera.emplace(oblique_camera(scene));
        return draw(scene, pixels);
    };
    const glm::dvec3 on_a_map(448262.125, 5411932.678, 244.5);
    const std::vector<std::string> metres{"mesh.source.millimetres_per_unit=1000"};
    const Image near = picture("near.obj", glm::dvec3(0.0), metres);
    // The file's own digits end at 1e-9 m too.
    EXPECT_LE(measure::compare_images(picture("far.obj", on_a_map, metres), near).rmse, most_rmse);
    // Where the scene's origin is the file's, camera and ball are far away together.
    const std::vector<std::string> kept{metres[0], "mesh.source.origin=[0,0,0]"};
    EXPECT_LE(measure::compare_images(picture("kept.obj", on_a_map, kept), near).rmse, most_rmse);
}

}  // namespace
}  // namespace bruma::render
