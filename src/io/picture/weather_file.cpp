#include "io/picture/weather_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "io/input_file.h"
#include "io/picture/raster_picture.h"

namespace bruma::io {
namespace {

constexpr int fewest_texels = 8, most_texels = 8192;

std::vector<std::uint8_t> samples_of_eight_bits(const RasterPicture& picture) {
    std::vector<std::uint8_t> samples(picture.sample_count());
    for (std::size_t n = 0; n < samples.size(); ++n) {
        std::uint16_t deep = 0;
        if (picture.bits == 16) {
            std::memcpy(&deep, &picture.rgba[2 * n], sizeof deep);
        }
        samples[n] = picture.bits == 16 ? std::uint8_t(deep >> 8) : std::uint8_t(picture.rgba[n]);
    }
    return samples;
}

/// A map that another node has from the same source.
const scene::Clouds* same_source(const scene::Scene* scene, const scene::CloudWeatherSource& source) {
    if (scene != nullptr) {
        for (const auto& [name, node] : scene->nodes) {
            const auto* clouds = std::get_if<scene::Clouds>(&node.content);
            if (clouds != nullptr && *clouds->map && clouds->map_from == source) {
                return clouds;
            }
        }
    }
    return nullptr;
}

}  // namespace

std::shared_ptr<const scene::WeatherMap> load_weather_map(const std::filesystem::path& path) {
    const std::string bytes = read_text_file(path, most_picture_bytes);
    const PictureDoor door{"weather maps may be .png, .jpg, .bmp or .tga", [&](int width, int height) {
                               if (std::min(width, height) < fewest_texels || std::max(width, height) > most_texels) {
                                   throw InputError(fmt::format(
                                       "{}: {} x {} texels, but a weather map has {} to {} along each side; scale it",
                                       path.string(), width, height, fewest_texels, most_texels));
                               }
                           }};
    const RasterPicture picture = decode_raster(path.string(), bytes, door);
    auto map = std::make_shared<scene::WeatherMap>();
    map->name = path.filename().string();
    map->width = picture.width;
    map->height = picture.height;
    map->rgba = samples_of_eight_bits(picture);
    const int channels = picture.channels;
    const bool is_grey = channels < 3;
    const bool has_alpha = channels % 2 == 0;
    for (std::size_t n = 0; n < map->rgba.size(); n += 4) {
        if (is_grey) {
            map->rgba[n + 2] = 255;
        }
        if (!has_alpha) {
            map->rgba[n + 3] = 128;
        }
    }
    return map;
}

void load_missing_weather(scene::Scene& scene, const scene::Scene* known) {
    for (auto& [name, node] : scene.nodes) {
        auto* clouds = std::get_if<scene::Clouds>(&node.content);
        if (clouds == nullptr || (*clouds->map && clouds->map_from == *clouds->weather)) {
            continue;
        }
        const scene::Clouds* same = same_source(known, *clouds->weather);
        // Two layers of one map share it.
        same = same != nullptr ? same : same_source(&scene, *clouds->weather);
        if (same != nullptr) {
            clouds->map = same->map;
            clouds->map_from = same->map_from;
        } else if (clouds->weather->file.empty()) {
            scene::make_missing_map(*clouds);
        } else {
            try {
                clouds->map = load_weather_map(clouds->weather->file);
            } catch (const InputError& error) {
                throw InputError(fmt::format("nodes.{}.weather: {}", name, error.what()));
            }
            clouds->map_from = *clouds->weather;
        }
    }
}

}  // namespace bruma::io
