#include <algorithm>
#include <cmath>

#include "render/renderer.h"

// What a renderer tells once it has drawn: pictures in memory, how far they are from done, what they cost.
namespace bruma::render {
namespace {

/// A texture of four floats in memory, top row first.
Image read_top_down(const gl::Texture& texture) {
    const glm::ivec3 size = texture.size();
    Image bottom_up(size.x, size.y);
    texture.download({GL_RGBA, GL_FLOAT}, bottom_up.rgba.size() * sizeof(float), bottom_up.rgba.data());
    Image image(size.x, size.y);
    for (int y = 0; y < size.y; ++y) {
        std::copy_n(bottom_up.pixel(0, size.y - 1 - y), std::size_t(4) * size.x, image.pixel(0, y));
    }
    return image;
}

}  // namespace

const Picture& Renderer::picture() const {
    return path_traced_ ? graph_.product(path_trace_.paths)->picture : *graph_.product(march_.picture);
}

Image Renderer::read_picture() const {
    return read_top_down(picture().color);
}

Image Renderer::read_standard_error() const {
    const PathTracing& paths = *graph_.product(path_trace_.paths);
    Image error = read_top_down(paths.spread);
    for (int y = 0; y < error.height; ++y) {
        const double n = paths.samples + (error.height - 1 - y < paths.next_row ? 1 : 0);
        for (int k = 0; k < 4 * error.width; ++k) {
            float& value = error.pixel(0, y)[k];
            value = n < 2 ? 0.0F : float(std::sqrt(double(value) / (n * (n - 1.0))));
        }
    }
    return error;
}

std::optional<int> Renderer::path_samples() const {
    const PathTracing* const paths = graph_.product(path_trace_.paths);
    return path_traced_ && paths != nullptr ? std::optional(paths->samples) : std::nullopt;
}

std::optional<PathStanding> Renderer::path_standing() const {
    const std::optional<int> samples = path_samples();
    if (!samples) {
        return std::nullopt;
    }
    PathStanding standing{*samples, std::nullopt};
    if (standing.samples >= 2) {
        const Image error = read_standard_error();
        double squares = 0.0;
        for (std::size_t n = 0; n < error.rgba.size(); ++n) {
            squares += n % 4 == 3 ? 0.0 : double(error.rgba[n]) * error.rgba[n];
        }
        standing.standard_error = std::sqrt(squares / (3.0 * double(error.pixel_count())));
    }
    return standing;
}

std::optional<TranslucentStanding> Renderer::translucent_standing() const {
    if (translucents_.empty()) {
        return std::nullopt;
    }
    TranslucentStanding standing{PathGoal::all, 0.0, true};
    for (const auto& [name, passes] : translucents_) {
        if (const RadiosityMaps* const maps = passes->standing()) {
            standing.passes = std::min(standing.passes, maps->passes);
            standing.noise =
                std::max(standing.noise, maps->all_texels > 0 && maps->read_texels == 0 ? 0.0 : maps->noise);
            standing.read_texels += maps->read_texels;
            standing.all_texels += maps->all_texels;
            standing.evaluations += maps->evaluations;
            standing.settled = standing.settled && passes->settled();
        }
    }
    const OpaquePicture* const opaque = graph_.product(opaque_->picture);
    standing.unseen_pixels = opaque == nullptr ? 0 : opaque->unseen;
    return standing;
}

std::vector<const CloudPicture*> Renderer::cloud_pictures() const {
    std::vector<const CloudPicture*> pictures;
    for (const Handle<CloudPicture> layer : clouds_ ? clouds_->pictures() : std::vector<Handle<CloudPicture>>{}) {
        pictures.push_back(graph_.product(layer));
    }
    return pictures;
}

CloudTotals Renderer::count_clouds(const scene::Scene& scene, const View& view) {
    update(scene, view);
    CloudTotals totals;
    const auto layers = clouds_ ? clouds_->counts() : std::vector<Handle<CloudCounts>>{};
    for (const Handle<CloudCounts> layer : layers) {
        graph_.run({march_.picture.index, layer.index});
        std::vector<glm::uvec4> pixels(std::size_t(view.pixels.x) * view.pixels.y);
        graph_.product(layer)->counts.download({GL_RGBA_INTEGER, GL_UNSIGNED_INT}, pixels.size() * sizeof(glm::uvec4),
                                               pixels.data());
        for (const glm::uvec4 pixel : pixels) {
            totals.turns += pixel.x;
            totals.weather += pixel.y;
            totals.noise += pixel.z;
            totals.light += pixel.w;
        }
    }
    return totals;
}

SampleTotals Renderer::count_samples(const scene::Scene& scene, const View& view) {
    update(scene, view);
    SampleTotals totals;
    if (path_traced_) {
        return totals;  // no march, nothing to count
    }
    graph_.run({march_.picture.index, march_.counts.index});
    if (!volumes_.empty()) {
        const gl::Texture& counts = graph_.product(march_.counts)->counts;
        std::vector<glm::vec2> pixels(std::size_t(view.pixels.x) * view.pixels.y);
        counts.download({GL_RG, GL_FLOAT}, pixels.size() * sizeof(glm::vec2), pixels.data());
        for (const glm::vec2 pixel : pixels) {
            totals.samples += std::uint64_t(pixel.x);
            totals.emptiness_queries += std::uint64_t(pixel.y);
        }
        totals.samples_per_pixel = double(totals.samples) / double(pixels.size());
    }
    return totals;
}

}  // namespace bruma::render
