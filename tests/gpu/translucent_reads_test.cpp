// Shelf: closed form. Light is worked out where the picture looks it up and nowhere else, and the picture does not
// know.
#include "kept_renderer.h"
#include "translucent.h"

namespace bruma::render {
namespace {

class TranslucentReads : public KeptRenderer {
  protected:
    void SetUp() override {
        KeptRenderer::SetUp();
        add_translucent(scene, "body", builtin_triangles("mesh-knot"), scene::medium_of(scene::Material::skin1));
        scene.rendering.edit([](scene::RenderSettings& settings) { settings.samples = 4; });
        scene.lights["key"] = scene::Light{.direction_world = {0.3, 1.0, 0.4}};
        look_against({0.2, 0.3, 1.0});
    }
    void look_against(glm::dvec3 back) { scene.camera = parallel_camera_around(scene, back); }
    void whole_maps(bool whole) {
        std::get<scene::Mesh>(scene.nodes.at("body").content).subsurface.edit([&](scene::SubsurfaceSettings& s) {
            s.whole_maps = whole;
        });
    }
    TranslucentStanding look(int passes) {
        renderer->render(scene, view_of(pixels, passes));
        return *renderer->translucent_standing();
    }
    Image beside_whole_maps(int passes) {
        whole_maps(true);
        Renderer other(shaders());
        other.render(scene, view_of(pixels, passes));
        whole_maps(false);
        return other.read_picture();
    }

    const glm::ivec2 pixels{48, 40};
    scene::Scene scene;
};

TEST_F(TranslucentReads, ThePictureIsThatOfWholeMapsBitForBit) {
    // Around the body with one renderer, near and far, in both projections: whatever was worked out for other views.
    const glm::dvec3 backs[] = {{0.2, 0.3, 1.0}, {0.25, 0.3, 1.0}, {1.0, 0.5, -0.6}, {-0.6, -1.0, 0.1}};
    for (int n = 0; n < 4; ++n) {
        look_against(backs[n]);
        scene.camera->edit([&](scene::Camera& camera) {
            camera.projection = n % 2 == 0 ? scene::Projection::perspective : scene::Projection::orthographic;
            camera.view_height *= n == 3 ? 0.3 : 1.0;
        });
        scene.rendering.edit([&](scene::RenderSettings& settings) { settings.samples = n == 1 ? 1 : 4; });
        EXPECT_EQ(look(3).passes, 3);
        EXPECT_TRUE(same_bits(renderer->read_picture(), beside_whole_maps(3))) << "view " << n;
    }
}

TEST_F(TranslucentReads, OnlyWhatIsLookedUpCosts) {
    const TranslucentStanding first = look(2);
    EXPECT_EQ(first.evaluations, first.read_texels * 2 * 16);
    // Of each map about half lies on the far side, and a knot hides itself.
    report("share of texels that a picture of a knot looks up", double(first.read_texels) / double(first.all_texels));
    EXPECT_LT(double(first.read_texels), 0.7 * double(first.all_texels));
    EXPECT_EQ(look(2).evaluations, first.evaluations);
    scene.camera->edit([](scene::Camera& camera) { camera.view_height *= 0.25; });
    const TranslucentStanding near = look(2);
    EXPECT_LT(near.read_texels, first.read_texels / 2);
    // Pixels are finer than texels now, and reach a few that lay between those of before.
    EXPECT_LT(double(near.evaluations), 1.2 * double(first.evaluations));
    scene.camera->edit([](scene::Camera& camera) {
        camera.eye_world.x += 1.0;
        camera.target_world.x += 1.0;
    });
    const TranslucentStanding beside = look(8);
    EXPECT_EQ(beside.read_texels, 0U) << "beside the picture";
    EXPECT_EQ(beside.evaluations, near.evaluations);
    EXPECT_TRUE(beside.settled);
}

TEST_F(TranslucentReads, ABodyBehindAnotherMeshCostsNothing) {
    const glm::dvec3 back = glm::normalize(glm::dvec3(0.2, 0.3, 1.0));
    add_mesh(scene, "curtain", quad_mesh(1.0F), glm::dvec3(0.5), {.translation = {0.0, 0.0, 0.5}});
    scene.camera->edit([&](scene::Camera& camera) { camera.eye_world += 3.0 * back; });
    const TranslucentStanding standing = look(1);
    EXPECT_EQ(standing.read_texels, 0U);
    EXPECT_EQ(standing.evaluations, 0U);
    scene.nodes.at("curtain").visible = false;
    EXPECT_GT(look(1).evaluations, 0U);
}

TEST_F(TranslucentReads, AViewFromBehindIsWholeAtOnce) {
    look(8);
    look_against({-0.2, -0.3, -1.0});
    const TranslucentStanding behind = look(1);
    EXPECT_EQ(behind.passes, 1);
    const Image image = renderer->read_picture();
    double shown = 0.0;
    for (std::size_t n = 0; n < image.pixel_count(); ++n) {
        if (image.rgba[4 * n + 3] == 1.0F) {
            shown += 1.0;
            EXPECT_GT(image.rgba[4 * n], 0.0F);
        }
    }
    EXPECT_GT(shown, 200.0);
}

}  // namespace
}  // namespace bruma::render
