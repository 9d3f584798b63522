// Shelf: closed form. Materials of mesh files, as linear values in pictures.
#include <cmath>

#include "io/mesh/obj_mesh.h"
#include "io_temporary_folder.h"
#include "opaque_mesh.h"

namespace bruma::render {
namespace {

/// A wall of 2 x 2 m that the camera sees from the front, its material told by these lines, or its corners by
/// `vertices`.
scene::Scene wall(const std::string& lines, std::string vertices = "", const std::string& picture = "") {
    const io::TemporaryFolder folder;
    if (vertices.empty()) {
        vertices = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";
    }
    folder.write("t.tga", picture);
    folder.write("wall.mtl", "newmtl wall\n" + lines);
    const auto file = folder.write("wall.obj", "mtllib wall.mtl\nusemtl wall\n" + vertices +
                                                   "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
    scene::MeshSource source;
    source.millimetres_per_unit = 1000.0;
    scene::Scene scene = scene_seen_from(4.0, scene::Projection::orthographic, 2.0);
    scene.rendering.edit([](scene::RenderSettings& settings) { settings.samples = 1; });  // at the pixels' centres
    scene::Mesh& mesh = add_mesh(scene, "wall", io::load_obj_mesh(file, source).mesh, glm::dvec3(0.8));
    mesh.surface.edit([](scene::MeshSurface& s) { s.shading = scene::MeshShading::blinn_phong; });
    // Its cosine to the wall's normal is 0.765, to the half vector sqrt((1 + 0.765) / 2).
    scene.lights["key"] = scene::Light{.direction_world = {std::sqrt(1.0 - 0.765 * 0.765), 0.0, 0.765}};
    return scene;
}

TEST_F(Drawing, AWallWithoutAnExponentIsDiffuse) {
    const auto shown = [&](const std::string& lines) { return draw(wall(lines), {5, 5}).pixel(2, 2)[0]; };
    const std::string colors = "Kd .2 .2 .2\nKs .9 .9 .9\n";
    // Kd (N . L), rounded to floats.
    for (const char* more : {"Ns 0\n", "Ns 0\nillum 2\n", "", "Ns 10\nillum 1\n"}) {
        EXPECT_NEAR(shown(colors + more), 0.2 * 0.765, 1e-6) << more;
    }
    // Kd (N . L) + Ks (N . H)^Ns, with the light's mirrored share as elsewhere.
    const double highlight = 0.9 * std::pow(std::sqrt(0.5 * (1.0 + 0.765)), 20.0);
    for (const char* more : {"Ns 20\n", "Ns 20\nillum 2\n", "Ns 20\nillum 7\n"}) {
        EXPECT_NEAR(shown(colors + more), 0.2 * 0.765 + highlight, 1e-5) << more;
    }
    EXPECT_NEAR(shown(colors + "Ns 20\nillum 0\n"), 0.2, 1e-6) << "the same in any light";
    EXPECT_NEAR(shown("Kd .2 .2 .2\nKe 3 3 3\n"), 0.2 * 0.765 + 3.0, 1e-5) << "light of its own";
}

TEST_F(Drawing, ColoursOfVerticesAreFactors) {
    scene::Scene scene = wall("Kd .5 .5 .5\n", "v -1 -1 0 1 0 0\nv 1 -1 0 1 0 0\nv 1 1 0 0 0 1\nv -1 1 0 0 0 1\n");
    const Image image = draw(scene, {5, 5});
    // Linear between the bottom and the top: rows lie at 0.1, 0.3, ... of the height.
    EXPECT_NEAR(image.pixel(2, 2)[0], 0.5 * 0.765 * 0.5, 1e-5);
    EXPECT_NEAR(image.pixel(2, 0)[0], 0.5 * 0.765 * 0.1, 1e-5);
    EXPECT_NEAR(image.pixel(2, 0)[2], 0.5 * 0.765 * 0.9, 1e-5);
    EXPECT_EQ(image.pixel(2, 2)[1], 0.0F);
    std::get<scene::Mesh>(scene.nodes.at("wall").content).surface.edit([](scene::MeshSurface& s) {
        s.file_materials = false;
    });
    EXPECT_GT(draw(scene, {5, 5}).pixel(2, 2)[1], 0.1F) << "of the file: left with its materials";
}

TEST_F(Drawing, TexturesLieWhereTheirOptionsPutThem) {
    // Two texels, red to the left, blue to the right; TARGA holds blue first.
    const std::string picture =
        std::string("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\1\0\x18\x20", 18) + std::string("\0\0\xff\xff\0\0", 6);
    const auto row = [&](const std::string& options) {
        scene::Scene scene = wall("Kd 1 1 1\nillum 0\nmap_Kd " + options + " t.tga\n", "", picture);
        const Image image = draw(scene, {8, 8});
        std::string text;
        for (int x = 0; x < 8; ++x) {
            const auto texel = image.pixel(x, 4);
            text += texel[1] > 0.9F ? 'w' : texel[0] > texel[2] ? 'r' : 'b';
        }
        return text;
    };
    EXPECT_EQ(row(""), "rrrrbbbb");
    EXPECT_EQ(row("-s 2 1 1"), "rrbbrrbb");
    EXPECT_EQ(row("-o 0.5"), "bbbbrrrr");
    EXPECT_EQ(row("-s 2 -o 0.5"), "bbrrbbrr");
    EXPECT_EQ(row("-s 2 -clamp on"), "rrbbwwww");
    EXPECT_EQ(row("-s 2 -o -0.5 -clamp on"), "wwrrbbww");
    // Its values times 0.5, and 0.25 more.
    const Image dim = draw(wall("Kd 1 1 1\nillum 0\nmap_Kd -clamp on -mm .25 .5 t.tga\n", "", picture), {8, 8});
    EXPECT_NEAR(dim.pixel(1, 4)[0], 0.75, 1e-2) << "a filtered red";
    EXPECT_NEAR(dim.pixel(1, 4)[1], 0.25, 1e-5);
}

}  // namespace
}  // namespace bruma::render
