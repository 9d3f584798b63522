// Shelf: closed form. Nodes that hang on nodes, in chains of any length.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "io/scene/scene_json.h"
#include "io_temporary_folder.h"
#include "scene/builtin/mesh_builtin.h"
#include "scene/scene.h"

namespace bruma::scene {
namespace {

constexpr int many = 20000;

/// Groups that each stand a millimetre along x from the one before. Names are such that a map's order, which is that of
/// the alphabet, has children before parents as often as behind them.
std::string name_of(int n) {
    return fmt::format("group {}", std::uint32_t(n) * 2654435761U);
}
Scene chain() {
    Scene scene;
    for (int n = 0; n < many; ++n) {
        Node& node = scene.nodes[name_of(n)];
        node.parent = n == 0 ? "" : name_of(n - 1);
        node.transform = Transform{.translation = {1e-3, 0.0, 0.0}};
    }
    Mesh mesh;
    mesh.source.file = "builtin:mesh-sphere";
    mesh.triangles = builtin_mesh("mesh-sphere").mesh;
    scene.nodes["ball"].content = std::move(mesh);
    scene.nodes["ball"].parent = name_of(many - 1);
    return scene;
}

// A square law takes minutes for these.
TEST(Parents, AChainOfManyIsCheckedPlacedAndRead) {
    Scene scene = chain();
    check(scene);
    EXPECT_NEAR(world_from_model(scene, "ball")[3].x, 1e-3 * many, 1e-9);
    EXPECT_NEAR(world_bounds(scene).low.x, 1e-3 * many - 0.01, 1e-4);
    const Scene again = io::from_json(io::to_json(scene), "chain.json", {});
    EXPECT_EQ(again.nodes.size(), std::size_t(many + 1));
    scene.nodes.at(name_of(0)).visible = false;
    EXPECT_TRUE(shown_meshes(scene).empty());
    EXPECT_FALSE(is_shown(scene, "ball"));
}

TEST(Parents, CirclesAndLooseEndsOfAnyLengthAreRefused) {
    Scene circle = chain();
    circle.nodes.at(name_of(0)).parent = name_of(many - 1);
    EXPECT_TRUE(io::contains(io::refusal([&] { check(circle); }), "form a circle"));
    Scene tail = chain();
    tail.nodes.at(name_of(many / 2)).parent = name_of(many / 2 + 1);
    EXPECT_TRUE(io::contains(io::refusal([&] { check(tail); }), "form a circle"));
    Scene alone = chain();
    alone.nodes.at("ball").parent = "ball";
    EXPECT_TRUE(io::contains(io::refusal([&] { check(alone); }), "nodes.ball: its parents form a circle"));
    Scene loose = chain();
    loose.nodes.at(name_of(0)).parent = "nobody";
    EXPECT_TRUE(io::contains(io::refusal([&] { check(loose); }), "its parent 'nobody' does not exist"));
}

}  // namespace
}  // namespace bruma::scene
