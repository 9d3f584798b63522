#include "render/products/surface_layers.h"

#include <algorithm>

#include "base/log.h"
#include "render/products/sample_places.h"

namespace bruma::render {

int samples_of_driver(int wanted) {
    GLint colors = 1, depths = 1;
    glGetIntegerv(GL_MAX_COLOR_TEXTURE_SAMPLES, &colors);
    glGetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &depths);
    const int most = std::clamp(std::min(colors, depths), 1, 16);
    static bool said = false;
    if (wanted > most && !said) {
        said = true;
        log_note("rendering.samples: {} wanted, {} taken, which is what this driver has", wanted, most);
    }
    return std::clamp(wanted, 1, most);
}

void set_sample_places(gl::Program& program, int samples) {
    for (int n = 0; samples > 1 && n < samples; ++n) {
        glm::vec2 place(0.5F);
        glGetMultisamplefv(GL_SAMPLE_POSITION, GLuint(n), &place.x);
        program.set_at("sample_places", n, "", place - 0.5F);
    }
}

void SurfaceLayers::bind(gl::Program& program, int layer, GLuint unit) const {
    shown[std::size_t(std::min(layer, 1))].radiance.bind(unit);
    program.set("opaque_radiance", int(unit));
    distances(layer).bind(unit + 1);
    program.set("opaque_distance", int(unit + 1));
}

void SampledSurfaces::prepare(SurfaceLayers& layers, glm::ivec2 pixels, int wanted) {
    const int samples = samples_of_driver(wanted);
    if (layers.shown[0].radiance && glm::ivec2(layers.shown[0].radiance.size()) == pixels && samples == samples_) {
        return;
    }
    samples_ = samples;
    layers = SurfaceLayers{};
    layers.count = samples > 1 ? 3 : 1;
    framebuffer_ = {};
    for (int n = 0; n < (samples > 1 ? 2 : 1); ++n) {
        layers.shown[std::size_t(n)].radiance = gl::Texture::make_2d("surface radiance", GL_RGBA32F, pixels);
        layers.shown[std::size_t(n)].distance = gl::Texture::make_2d("surface distance", GL_RG32F, pixels);
    }
    SurfaceLayer& first = layers.shown[0];
    if (samples == 1) {
        depth_ = gl::Texture::make_2d("surface depth", GL_DEPTH_COMPONENT32F, pixels);
        radiance_ = {};
        distance_ = {};
        first.framebuffer = gl::Framebuffer("surfaces", {&first.radiance, &first.distance}, &depth_);
        return;
    }
    layers.nothing = gl::Texture::make_2d("share of nothing", GL_RG32F, pixels);
    layers.farthest = gl::Texture::make_2d("farthest distance", GL_R32F, pixels);
    const SurfaceLayer& second = layers.shown[1];
    layers.resolved = gl::Framebuffer("surface layers", {&first.radiance, &first.distance, &second.radiance,
                                                         &second.distance, &layers.nothing, &layers.farthest});
    radiance_ = gl::Texture::make_2d_samples("samples of radiance", GL_RGBA32F, pixels, samples);
    distance_ = gl::Texture::make_2d_samples("samples of distance", GL_R32F, pixels, samples);
    depth_ = gl::Texture::make_2d_samples("samples of depth", GL_DEPTH_COMPONENT32F, pixels, samples);
    framebuffer_ = gl::Framebuffer("surface samples", {&radiance_, &distance_}, &depth_);
}

const gl::Framebuffer& SampledSurfaces::target(const SurfaceLayers& layers) const {
    return samples_ == 1 ? layers.shown[0].framebuffer : framebuffer_;
}

void SampledSurfaces::resolve(const SurfaceLayers& layers, gl::ShaderLibrary& shaders, glm::dvec2 pixel_size) const {
    if (samples_ == 1) {
        return;
    }
    layers.resolved.bind();
    gl::Program& program = shaders.get("surfaces/surface_layers.frag", {{"SAMPLES", std::to_string(samples_)}});
    radiance_.bind(0);
    program.set("radiance_samples", 0);
    distance_.bind(1);
    program.set("distance_samples", 1);
    program.set("pixel_size", glm::vec2(pixel_size));
    full_screen_.draw(program);
}

}  // namespace bruma::render
