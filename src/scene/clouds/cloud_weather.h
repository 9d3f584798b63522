#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "scene/field.h"

namespace bruma::scene {

/// What the weather map says of one column of air, each in [0,1].
struct CloudWeather {
    double placement = 0.0;           ///< R: where clouds are under a fair sky
    double placement_overcast = 0.0;  ///< G: where they are under a covered one
    double top = 0.0;                 ///< B: top of the cloud as a share of the layer; below 1/255 there is none
    double density = 0.5;             ///< A: 0.5 is neutral
};

/// Texels that repeat in both directions; x east, z south, linear values, never sRGB.
struct WeatherMap {
    std::string name;
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  ///< 4 * width * height, rows along x, first row at z = 0

    /// Bilinear between texel centres; u along x and v along z, in tiles.
    CloudWeather sample(double u, double v) const;
    /// Largest value of each channel, as a weather: nothing in the map is cloudier, higher or denser.
    CloudWeather largest() const;
};

/// Sorts of maps made by code. scattered: single heaps with gaps; overcast: low and closed; ripples: rows of small
/// flakes; wisps: long thin streaks; towers: few cells, up to the top of the layer.
enum class WeatherPattern { scattered, overcast, ripples, wisps, towers };
template <>
inline std::span<const std::string_view> enum_words<WeatherPattern>() {
    static constexpr std::array<std::string_view, 5> words{"scattered", "overcast", "ripples", "wisps", "towers"};
    return words;
}

/// Where a weather map comes from.
struct CloudWeatherSource {
    std::string file;  ///< path of a picture; empty: made by code
    WeatherPattern pattern = WeatherPattern::scattered;
    std::int64_t variation = 1;  ///< another number is another sky of the same sort
    bool operator==(const CloudWeatherSource&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, CloudWeatherSource>
void visit_fields(Self& source, Visitor&& visit) {
    visit(Field{.name = "file",
                .sentence = "picture whose red, green, blue and alpha are placement, placement overcast, top, density; "
                            "empty: made by code"},
          source.file);
    visit(Field{.name = "pattern", .sentence = "what the map made by code looks like"}, source.pattern);
    visit(Field{.name = "variation",
                .sentence = "another number is another sky of the same sort",
                .min = 0.0,
                .max = 1000.0,
                .panel_max = 20.0},
          source.variation);
}

/// A map of `size` x `size` texels made by code, without seams. Throws InputError for a size outside 1 to 8192.
std::shared_ptr<const WeatherMap> make_weather_map(WeatherPattern pattern, std::int64_t variation = 1, int size = 512);

}  // namespace bruma::scene
