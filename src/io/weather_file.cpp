#include "io/weather_file.h"

#include <fmt/core.h>
#include <stb/stb_image.h>

#include "base/error.h"
#include "io/input_file.h"
#include "io/raw_volume.h"

namespace bruma::io {
namespace {

constexpr int fewest_texels = 8, most_texels = 8192;

[[noreturn]] void throw_broken(const std::filesystem::path& path) {
    const char* reason = stbi_failure_reason();
    throw InputError(fmt::format("{}: broken or unknown picture ({}); weather maps may be .png, .jpg, .bmp or .tga",
                                 path.string(), reason != nullptr ? reason : "no reason given"));
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
    constexpr std::int64_t most_bytes = (std::int64_t(1) << 31) - 1;  // stb counts bytes in an int
    const std::string bytes = read_text_file(path, most_bytes);
    const auto* memory = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int length = int(bytes.size());
    auto map = std::make_shared<scene::WeatherMap>();
    map->name = path.filename().string();
    int channels = 0;
    // The size stands at the head: a picture that is too large is refused before it is unpacked.
    if (stbi_info_from_memory(memory, length, &map->width, &map->height, &channels) == 0) {
        throw_broken(path);
    }
    if (std::min(map->width, map->height) < fewest_texels || std::max(map->width, map->height) > most_texels) {
        throw InputError(fmt::format("{}: {} x {} texels, but a weather map has {} to {} along each side; scale it",
                                     path.string(), map->width, map->height, fewest_texels, most_texels));
    }
    const std::size_t needed = std::size_t(4) * map->width * map->height;
    if (2 * needed > available_memory()) {
        throw InputError(fmt::format("{}: {} x {} texels need {} MiB of memory, but {} MiB are free; scale it down",
                                     path.string(), map->width, map->height, needed >> 19, available_memory() >> 20));
    }
    stbi_uc* const pixels = stbi_load_from_memory(memory, length, &map->width, &map->height, &channels, 4);
    if (pixels == nullptr) {
        throw_broken(path);
    }
    map->rgba.assign(pixels, pixels + needed);
    stbi_image_free(pixels);
    const bool is_grey = channels < 3;
    const bool has_alpha = channels % 2 == 0;
    for (std::size_t n = 0; n < needed; n += 4) {
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
