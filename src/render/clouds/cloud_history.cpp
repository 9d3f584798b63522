#include "render/clouds/cloud_history.h"

#include <algorithm>
#include <array>
#include <utility>

#include "render/view_rays.h"

namespace bruma::render {
namespace {

/// Pixels of a block in the order of Bayer's matrix.
constexpr std::array<glm::ivec2, CloudHistory::turns> bayer_order() {
    constexpr std::array<int, 16> matrix{0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
    std::array<glm::ivec2, CloudHistory::turns> order{};
    for (int n = 0; n < 16; ++n) {
        order[std::size_t(matrix[std::size_t(n)])] = {n % 4, n / 4};
    }
    return order;
}

glm::mat3 world_from_camera(const scene::Camera& camera) {
    const scene::CameraFrame frame = scene::camera_frame(camera);
    return glm::mat3(glm::dmat3(frame.right_world, frame.up_world, frame.back_world));
}

}  // namespace

void make_targets(CloudPicture& picture, glm::ivec2 pixels) {
    if (!picture.radiance || glm::ivec2(picture.radiance.size()) != pixels) {
        picture.framebuffer = {};
        picture.radiance = gl::Texture::make_2d("cloud radiance", GL_RGBA32F, pixels);
        picture.distance = gl::Texture::make_2d("cloud distance", GL_R32F, pixels);
        picture.framebuffer = gl::Framebuffer("clouds", {&picture.radiance, &picture.distance});
        picture.resolved = {};
        picture.missing = {};
    }
}

glm::ivec2 CloudHistory::offset() const {
    static constexpr auto order = bayer_order();
    // Another start in every round of turns: what moves by whole pixels a frame would otherwise meet the same places
    // again and again, and never be marched at others.
    const int round = turn_ / turns;
    return (order[std::size_t(turn_ % turns)] + order[std::size_t(round * 7 % turns)]) % 4;
}

CloudPicture& CloudHistory::sparse(glm::ivec2 pixels) {
    make_targets(sparse_, sparse_size(pixels));
    return sparse_;
}

void CloudHistory::begin(const CloudSight& sight) {
    sight_ = sight;
    turn_ = missing_ = 0;
}

void CloudHistory::look(const CloudSight& sight) {
    last_sight_ = std::exchange(sight_, sight);
    if (sight_ == last_sight_ && missing_ == turns) {
        turn_ = (turn_ + turns - 1) / turns * turns;  // the turns of one round see every pixel
    }
}

bool CloudHistory::resolve(gl::ShaderLibrary& shaders, CloudPicture& picture) {
    const glm::ivec2 pixels = sight_.pixels;
    const glm::ivec2 few = sparse_size(pixels);
    if (!statistics_.mean || glm::ivec2(statistics_.mean.size()) != few) {
        statistics_.framebuffer = {};
        statistics_.mean = gl::Texture::make_2d("cloud mean", GL_RGBA32F, few);
        statistics_.spread = gl::Texture::make_2d("cloud spread", GL_RGBA32F, few);
        statistics_.distance = gl::Texture::make_2d("cloud mean distance", GL_R32F, few);
        statistics_.framebuffer =
            gl::Framebuffer("cloud statistics", {&statistics_.mean, &statistics_.spread, &statistics_.distance});
    }
    make_targets(last_, pixels);
    std::swap(last_, picture);
    if (!picture.missing) {
        picture.missing = gl::Texture::make_2d("clouds missing", GL_DEPTH_COMPONENT32F, pixels);
        picture.resolved = gl::Framebuffer("clouds resolved", {&picture.radiance, &picture.distance}, &picture.missing);
    }

    GLuint unit = 0;
    const auto bind = [&](gl::Program& program, const char* sampler, const gl::Texture& texture) {
        texture.bind(unit);
        program.set(sampler, int(unit++));
    };
    gl::Program& count = shaders.get("clouds/cloud_statistics.frag");
    bind(count, "fresh_radiance", sparse_.radiance);
    bind(count, "fresh_distance", sparse_.distance);
    statistics_.framebuffer.bind();
    full_screen_.draw(count);

    const bool moved = sight_ != last_sight_;
    gl::Program& program = shaders.get("clouds/cloud_resolve.frag");
    unit = 0;
    bind(program, "fresh_radiance", sparse_.radiance);
    bind(program, "fresh_distance", sparse_.distance);
    bind(program, "fresh_mean", statistics_.mean);
    bind(program, "fresh_spread", statistics_.spread);
    bind(program, "fresh_mean_distance", statistics_.distance);
    bind(program, "last_radiance", last_.radiance);
    bind(program, "last_distance", last_.distance);
    const scene::Camera& camera = sight_.camera;
    program.set("pixel_offset", offset());
    program.set("pixels", glm::vec2(pixels));
    program.set("orthographic", camera.projection == scene::Projection::orthographic ? 1 : 0);
    program.set("half_view", glm::vec2(half_view(camera, pixels, 1.0)));
    program.set("world_from_camera", world_from_camera(camera));
    program.set("last_camera_from_world", glm::transpose(world_from_camera(last_sight_.camera)));
    program.set("last_half_view", glm::vec2(half_view(last_sight_.camera, last_sight_.pixels, 1.0)));
    program.set("moved", glm::vec3(sight_.moved_m(last_sight_)));
    program.set("kept_spread", moved ? 1.0F : 0.0F);
    picture.resolved.bind();
    full_screen_.draw_with_depth(program);

    missing_ = moved ? turns : std::max(0, missing_ - 1);
    ++turn_;
    return moved;
}

}  // namespace bruma::render
