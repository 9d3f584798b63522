// Shelf: closed form. Whether a picture shows anything of its nodes.
#include "render/compose/picture_coverage.h"

#include "opaque_mesh.h"

namespace bruma::render {
namespace {

class Coverage : public Drawing {
  protected:
    static scene::Scene cube(double opacity) {
        scene::TransferFunction tf;
        tf.opacity = {{0.0, opacity}};
        return scene_with(homogeneous({4, 4, 4}, glm::dvec3(0.5)), tf);
    }
    bool covers(const scene::Scene& scene, glm::ivec2 pixels) {
        Renderer renderer(shaders());
        renderer.render(scene, {pixels, 1.0});
        return PictureCoverage(shaders()).covers_any(renderer.picture());
    }
};

TEST_F(Coverage, OneCoveredPixelIsEnoughWhereverItLies) {
    // Sizes that blocks of eight do and do not divide.
    for (const glm::ivec2 pixels : {glm::ivec2(1, 1), glm::ivec2(16, 24), glm::ivec2(37, 19)}) {
        scene::Scene scene = scene_seen_from(10.0, scene::Projection::orthographic, double(pixels.y));
        EXPECT_FALSE(covers(scene, pixels));
        for (const glm::ivec2 at : {glm::ivec2(0), pixels - 1, glm::ivec2(pixels.x / 2, 0)}) {
            const glm::dvec2 place = glm::dvec2(at) + 0.5 - 0.5 * glm::dvec2(pixels);
            add_mesh(scene, "speck", quad_mesh(0.45F), glm::dvec3(0.0), {.translation = glm::dvec3(place, 0.0)});
            EXPECT_TRUE(covers(scene, pixels)) << pixels.x << " x " << pixels.y << " at " << at.x << ", " << at.y;
        }
        scene.nodes.at("speck").visible = false;
        EXPECT_FALSE(covers(scene, pixels));
    }
}

TEST_F(Coverage, SkyAndTransparentVolumesCoverNothing) {
    scene::Scene scene = cube(0.0);
    EXPECT_FALSE(covers(scene, {32, 32}));
    scene.outdoors.emplace();
    EXPECT_FALSE(covers(scene, {32, 32}));
    scene.nodes = cube(0.5).nodes;
    EXPECT_TRUE(covers(scene, {32, 32}));
}

TEST_F(Coverage, PathTracedPicturesCountToo) {
    for (const double opacity : {0.0, 0.5}) {
        scene::Scene scene = cube(opacity);
        volume_in(scene).optics.edit(
            [](scene::VolumeOptics& optics) { optics.lighting = scene::VolumeLighting::path_traced; });
        EXPECT_EQ(covers(scene, {16, 16}), opacity > 0.0);
    }
}

}  // namespace
}  // namespace bruma::render
