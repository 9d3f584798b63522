#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "scene/field.h"

namespace bruma::scene {

/// What bounds a layer: a box in a flat world, or two spheres around the planet whose surface is y = 0 below the
/// camera.
enum class CloudBounds { box, shell };
template <>
inline std::span<const std::string_view> enum_words<CloudBounds>() {
    static constexpr std::array<std::string_view, 2> words{"box", "shell"};
    return words;
}

/// How the two placement channels of the weather map meet the cloudiness: a blend from the first to the second, or the
/// first, and from a cloudiness of one half on the second as well (Häggström 2018).
enum class CoverageRule { blend, overlay };
template <>
inline std::span<const std::string_view> enum_words<CoverageRule>() {
    static constexpr std::array<std::string_view, 2> words{"blend", "overlay"};
    return words;
}

/// Whether fine noise eats less, or (as printed in Alaminos 2020) more, of an overcast sky.
enum class CloudErosion { fades, grows };
template <>
inline std::span<const std::string_view> enum_words<CloudErosion>() {
    static constexpr std::array<std::string_view, 2> words{"fades", "grows"};
    return words;
}

/// Whether noise is filtered channel by channel, or after its channels were put together into one: a quarter of the
/// memory traffic, and a slightly different cloud.
enum class NoisePacking { channels, packed };
template <>
inline std::span<const std::string_view> enum_words<NoisePacking>() {
    static constexpr std::array<std::string_view, 2> words{"channels", "packed"};
    return words;
}

/// Where a layer of clouds is, how dense it is and how it moves: all that its density depends on, besides noise and
/// weather map. World: metres, y up, ground at y = 0, north is -z.
struct CloudLayer {
    CloudBounds bounds = CloudBounds::shell;
    double bottom_m = 1500.0;                            ///< altitude; below the top
    double top_m = 4000.0;                               ///< altitude
    std::array<double, 2> box_center_m{0.0, 0.0};        ///< box: x and z of its middle
    std::array<double, 2> box_size_m{40000.0, 40000.0};  ///< box: along x and z

    double coverage = 0.4;  ///< global cloudiness in [0,1]; 0 is a clear sky
    double density = 1.0;   ///< global factor of the density
    CoverageRule coverage_rule = CoverageRule::blend;
    bool linear_coverage = false;      ///< coverage becomes the cloudy share of space
    bool density_follows_top = false;  ///< density profile over the cloud's own height, not the layer's
    CloudErosion erosion = CloudErosion::fades;
    NoisePacking packing = NoisePacking::channels;

    double shape_tile_m = 8000.0;     ///< edge of the cube of shape noise, which repeats
    double detail_tile_m = 800.0;     ///< edge of the cube of detail noise
    double weather_tile_m = 40000.0;  ///< edge of the weather map

    double wind_azimuth_deg = 90.0;  ///< compass direction towards which clouds move: 0 north (-z), 90 east (+x)
    double wind_speed_m_s = 10.0;
    double skew_m = 500.0;  ///< how far the top of a layer leads its bottom, along the wind
    bool operator==(const CloudLayer&) const = default;
};

/// Unit vector, horizontal, towards which the clouds move.
glm::dvec3 wind_direction_world(const CloudLayer& layer);

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, CloudLayer>
void visit_fields(Self& layer, Visitor&& visit) {
    const auto length = [](std::string_view name, std::string_view sentence, double most) {
        return Field{.name = name,
                     .unit = "m",
                     .sentence = sentence,
                     .min = 1.0,
                     .max = 1e7,
                     .panel_min = most / 100.0,
                     .panel_max = most,
                     .logarithmic = true};
    };
    const auto share = [](std::string_view name, std::string_view sentence) {
        return Field{.name = name, .sentence = sentence, .min = 0.0, .max = 1.0, .panel_max = 1.0};
    };
    const auto altitude = [](std::string_view name, std::string_view sentence) {
        return Field{.name = name, .unit = "m", .sentence = sentence, .min = 0.0, .max = 1e5, .panel_max = 15000.0};
    };
    visit(Field{.name = "bounds", .sentence = "box: a block in a flat world; shell: a layer around the planet"},
          layer.bounds);
    visit(altitude("bottom", "altitude of the flat base"), layer.bottom_m);
    visit(altitude("top", "altitude that no cloud exceeds; above the bottom"), layer.top_m);
    visit(Field{.name = "box_center", .unit = "m", .sentence = "box: x and z of its middle", .min = -1e7, .max = 1e7},
          layer.box_center_m);
    visit(Field{.name = "box_size", .unit = "m", .sentence = "box: lengths along x and z", .min = 1.0, .max = 1e7},
          layer.box_size_m);
    visit(share("coverage", "global cloudiness: 0 is a clear sky"), layer.coverage);
    visit(Field{.name = "density",
                .sentence = "multiplies the density of every cloud",
                .min = 0.0,
                .max = 1e6,
                .panel_max = 2.0},
          layer.density);
    visit(Field{.name = "coverage_rule",
                .sentence =
                    "blend: from the first placement channel to the second; overlay: the second joins from 0.5 on"},
          layer.coverage_rule);
    visit(Field{.name = "linear_coverage", .sentence = "coverage becomes the cloudy share of space"},
          layer.linear_coverage);
    visit(Field{.name = "density_follows_top",
                .sentence = "density rises over the cloud's own height instead of the layer's: low clouds are not dim"},
          layer.density_follows_top);
    visit(Field{.name = "erosion", .sentence = "under an overcast sky fine noise fades, or grows as first printed"},
          layer.erosion);
    visit(Field{.name = "packing",
                .sentence = "filter noise by channels, or packed into one: faster, slightly different"},
          layer.packing);
    visit(length("shape_tile", "edge of the repeating cube of large noise", 20000.0), layer.shape_tile_m);
    visit(length("detail_tile", "edge of the repeating cube of fine noise", 2000.0), layer.detail_tile_m);
    visit(length("weather_tile", "edge of the repeating weather map", 100000.0), layer.weather_tile_m);
    visit(Field{.name = "wind_azimuth",
                .unit = "deg",
                .sentence = "compass direction towards which clouds move: 0 north (-z), 90 east (+x)",
                .min = -360.0,
                .max = 360.0,
                .panel_max = 360.0},
          layer.wind_azimuth_deg);
    visit(Field{.name = "wind_speed",
                .unit = "m/s",
                .sentence = "speed of the clouds",
                .min = 0.0,
                .max = 1e4,
                .panel_max = 100.0},
          layer.wind_speed_m_s);
    visit(Field{.name = "skew",
                .unit = "m",
                .sentence = "how far the top of the layer leads its bottom along the wind",
                .min = -1e5,
                .max = 1e5,
                .panel_max = 2000.0},
          layer.skew_m);
}

/// Throws InputError, with `name` in front, for a layer whose top is not above its bottom.
void check(const CloudLayer& layer, std::string_view name);

}  // namespace bruma::scene
