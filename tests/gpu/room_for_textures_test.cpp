// Shelf: the same picture with more room. What is drawn where textures find little.
#include "base/error.h"
#include "drawing.h"
#include "gl/memory.h"
#include "measure/metrics/image_error.h"
#include "scene/builtin/builtin.h"

namespace bruma::render {
namespace {

using RoomForTextures = Drawing;

Image draw_within(gl::ShaderLibrary& shaders, const scene::Scene& scene, std::optional<std::uint64_t> bytes) {
    Renderer renderer(shaders);
    if (bytes) {
        renderer.set_texture_budget(*bytes);
    }
    renderer.render(scene, {{64, 64}, 1.0});
    return renderer.read_picture();
}

scene::Scene shaded(const std::string& name) {
    const auto grid = scene::builtin_volume(name);
    scene::Scene scene = scene_with(grid, scene::suggested_transfer_function(*grid));
    scene.camera = oblique_camera(scene);
    scene.lights["head"] = scene::Light{.kind = scene::LightKind::headlight};
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { lit(optics); });
    return scene;
}

TEST_F(RoomForTextures, GradientsFromVoxelsAreThoseThatAreStored) {
    for (const char* const name : {"bucky", "engine", "marschner-lobb"}) {
        scene::Scene scene = shaded(name);
        const scene::VolumeGrid& grid = **volume_in(scene).grid;
        const Image expected = draw_within(shaders(), scene, std::nullopt);
        // Samples take at most 4 bytes, gradients 4 or 8 more.
        const Image found = draw_within(shaders(), scene, 4 * grid.voxel_count() + 1000);
        EXPECT_FALSE(same_bits(found, expected)) << "gradients were stored";
        const double rmse = measure::compare_images(found, expected).rmse;
        report(std::string(name) + ": RMSE of gradients from voxels", rmse);
        // Both are central differences of the same field; they differ in the outermost voxels, and by rounding where
        // stored ones are. A quarter of a step of an 8-bit display.
        EXPECT_LE(rmse, 1e-3) << name;
    }
}

TEST_F(RoomForTextures, AFewSamplesStillShowTheThing) {
    scene::Scene scene = shaded("engine");
    const scene::VolumeGrid& grid = **volume_in(scene).grid;
    const Image expected = draw_within(shaders(), scene, std::nullopt);
    const double rmse = measure::compare_images(draw_within(shaders(), scene, grid.voxel_count() / 4), expected).rmse;
    report("RMSE of an eighth of the samples", rmse);
    EXPECT_GT(rmse, 0.0);
    // Blurred edges; another place or size of the box would make 0.2 and more.
    EXPECT_LE(rmse, 0.08);
}

TEST_F(RoomForTextures, ARendererComesBackWhenThereIsRoomAgain) {
    scene::Scene scene = shaded("bucky");
    Renderer renderer(shaders());
    const View view{{48, 48}, 1.0};
    renderer.render(scene, view);
    const Image expected = renderer.read_picture();
    renderer.set_texture_budget(50'000);
    renderer.render(scene, view);
    EXPECT_FALSE(same_bits(renderer.read_picture(), expected));
    renderer.set_texture_budget(1 << 30);
    renderer.render(scene, view);
    EXPECT_TRUE(same_bits(renderer.read_picture(), expected));
}

TEST_F(RoomForTextures, LightVolumesWithoutRoomAreRefused) {
    scene::Scene scene = shaded("bucky");
    volume_in(scene).optics.edit(
        [](scene::VolumeOptics& optics) { optics.lighting = scene::VolumeLighting::light_volume; });
    EXPECT_THROW(draw_within(shaders(), scene, 600'000), MachineError);
    EXPECT_NO_THROW(draw_within(shaders(), scene, 64 << 20));
}

TEST_F(RoomForTextures, TheDriverIsAskedBeforeAnythingIsAllocated) {
    const gl::TextureRoom room = gl::texture_room();
    EXPECT_GE(room.longest_edge, 256);
    EXPECT_GT(room.free_bytes, 0U);
    EXPECT_TRUE(gl::takes_3d(GL_R16, glm::ivec3(64)));
    EXPECT_TRUE(gl::takes_3d(GL_RGBA16_SNORM, glm::ivec3(64)));
    EXPECT_TRUE(gl::takes_3d(GL_RGB10_A2, glm::ivec3(64)));
    EXPECT_FALSE(gl::takes_3d(GL_R16, {2 * room.longest_edge, 1, 1}));
}

}  // namespace
}  // namespace bruma::render
