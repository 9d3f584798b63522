// Shelf: closed form. No visible point of a translucent mesh goes without light, whatever its shape.
#include <cstdlib>
#include <filesystem>

#include "io/mesh/mesh_source.h"
#include "translucent.h"

namespace bruma::render {
namespace {

class TranslucentCoverage : public Drawing {
  protected:
    struct Seen {
        double shown = 0.0;      ///< pixels that show the mesh, over all views
        double by_itself = 0.0;  ///< those among them that no map sees well
        double holes = 0.0;      ///< those that nothing was drawn on
        double black = 0.0;      ///< those that no light leaves
    };
    Seen look(std::shared_ptr<const scene::TriangleMesh> triangles, int pixels) {
        scene::Scene scene;
        // In skim milk light goes 20 mm and more: in things for the hand there is some everywhere.
        scene::Mesh& mesh =
            add_translucent(scene, "body", std::move(triangles), scene::medium_of(scene::Material::skim_milk));
        mesh.subsurface.edit([](scene::SubsurfaceSettings& settings) {
            settings.maps = 16;
            settings.map_size = 96;
            settings.light_map_size = 256;
            settings.samples = 4;
        });
        scene.lights["key"] = scene::Light{.direction_world = {0.3, 1.0, 0.4}};
        scene.lights["other"] = scene::Light{.direction_world = {-0.3, -0.7, -0.4}};
        scene.background = scene::Background{.top = glm::dvec3(0.0), .bottom = glm::dvec3(0.0)};
        Renderer renderer(shaders()), outlines(shaders());
        Seen seen;
        for (const glm::dvec3 back :
             {glm::dvec3(0.2, 0.3, 1.0), glm::dvec3(1.0, 0.5, -0.6), glm::dvec3(-0.6, -1.0, 0.1)}) {
            scene.camera = parallel_camera_around(scene, back);
            renderer.render(scene, view_of({pixels, pixels}, 1));
            seen.by_itself += renderer.translucent_standing()->unseen_pixels;
            const Image image = renderer.read_picture();
            EXPECT_TRUE(all_finite(image));
            scene::Scene outline = scene;
            std::get<scene::Mesh>(outline.nodes.at("body").content).surface.edit([](scene::MeshSurface& s) {
                s.shading = scene::MeshShading::lambert;
            });
            outlines.render(outline, view_of({pixels, pixels}, 1));
            const Image whole = outlines.read_picture();
            for (std::size_t n = 0; n < image.pixel_count(); ++n) {
                if (whole.rgba[4 * n + 3] == 1.0F) {
                    seen.shown += 1.0;
                    seen.holes += image.rgba[4 * n + 3] == 1.0F ? 0.0 : 1.0;
                    seen.black += image.rgba[4 * n] > 0.0F ? 0.0 : 1.0;
                }
            }
        }
        EXPECT_GT(seen.shown, 100.0);
        return seen;
    }
    void check(const std::string& name, std::shared_ptr<const scene::TriangleMesh> triangles, double most_by_itself) {
        const Seen seen = look(std::move(triangles), 80);
        EXPECT_EQ(seen.holes, 0.0) << name;
        EXPECT_EQ(seen.black, 0.0) << name;
        report(name + ": share of pixels that no map sees well", seen.by_itself / seen.shown);
        EXPECT_LE(seen.by_itself / seen.shown, most_by_itself) << name;
    }
};

TEST_F(TranslucentCoverage, OfMeshesMadeByCode) {
    check("sphere", builtin_triangles("mesh-sphere"), 0.0);
    // Where the tube passes close by itself, or a handle grows out of a wall.
    check("knot", builtin_triangles("mesh-knot"), 0.05);
    check("pot", builtin_triangles("pot"), 0.05);
}

TEST_F(TranslucentCoverage, OfMeasuredMeshes) {
    const char* const folder = std::getenv("BRUMA_DATA");
    if (folder == nullptr) {
        GTEST_SKIP() << "BRUMA_DATA names no folder of measured meshes";
    }
    int checked = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(std::filesystem::path(folder) / "meshes")) {
        if (entry.path().extension() != ".obj") {
            continue;
        }
        scene::MeshSource source;
        source.file = entry.path().string();
        const auto triangles = io::load_triangles(source, {});
        const std::string name = entry.path().filename().string();
        // What the scanner left open: the bunny, whose holes show its inside.
        if (triangles->closed || name == "stanford-bunny.obj") {
            check(name, triangles, 0.1);
            ++checked;
        }
    }
    EXPECT_GE(checked, 3);
}

}  // namespace
}  // namespace bruma::render
