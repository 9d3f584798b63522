#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "scene/field.h"

namespace bruma::scene {

/// Air, haze and ozone around a planet. Defaults: the earth, after Hillaire 2020, "A Scalable and Production Ready Sky
/// and Atmosphere Rendering Technique".
struct Atmosphere {
    double planet_radius_m = 6360e3;
    double height_m = 100e3;                                             ///< above which there is nothing
    glm::dvec3 rayleigh_scattering_per_m{5.802e-6, 13.558e-6, 33.1e-6};  ///< at sea level
    double rayleigh_scale_height_m = 8000.0;
    double mie_scattering_per_m = 3.996e-6;  ///< at sea level
    double mie_absorption_per_m = 0.444e-6;
    double mie_scale_height_m = 1200.0;
    double mie_g = 0.8;
    glm::dvec3 ozone_absorption_per_m{0.650e-6, 1.881e-6, 0.085e-6};  ///< where there is most of it
    double ozone_altitude_m = 25000.0;
    double ozone_half_width_m = 15000.0;  ///< falls linearly to nothing over this length
    glm::dvec3 ground_albedo{0.3};
    bool operator==(const Atmosphere&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, Atmosphere>
void visit_fields(Self& atmosphere, Visitor&& visit) {
    const auto length = [](std::string_view name, std::string_view sentence, double low, double high) {
        return Field{.name = name,
                     .unit = "m",
                     .sentence = sentence,
                     .min = low,
                     .max = high,
                     .panel_min = low,
                     .panel_max = high,
                     .logarithmic = true};
    };
    const auto per_m = [](std::string_view name, std::string_view sentence) {
        return Field{.name = name, .unit = "1/m", .sentence = sentence, .min = 0.0, .max = 1.0, .panel_max = 1e-4};
    };
    visit(length("planet_radius", "radius of the ground", 1e5, 1e8), atmosphere.planet_radius_m);
    visit(length("height", "altitude above which there is no air", 1e3, 1e6), atmosphere.height_m);
    visit(per_m("rayleigh_scattering", "of air at sea level, red, green, blue"), atmosphere.rayleigh_scattering_per_m);
    visit(length("rayleigh_scale_height", "altitude at which air has thinned to 1/e", 100.0, 1e5),
          atmosphere.rayleigh_scale_height_m);
    visit(per_m("mie_scattering", "of haze at sea level"), atmosphere.mie_scattering_per_m);
    visit(per_m("mie_absorption", "of haze at sea level"), atmosphere.mie_absorption_per_m);
    visit(length("mie_scale_height", "altitude at which haze has thinned to 1/e", 10.0, 1e5),
          atmosphere.mie_scale_height_m);
    visit(Field{.name = "mie_g",
                .sentence = "asymmetry of haze: 0 scatters evenly, towards 1 ahead",
                .min = -0.99,
                .max = 0.99,
                .panel_max = 0.99},
          atmosphere.mie_g);
    visit(per_m("ozone_absorption", "at the altitude of most ozone, red, green, blue"),
          atmosphere.ozone_absorption_per_m);
    visit(length("ozone_altitude", "altitude of most ozone", 100.0, 1e5), atmosphere.ozone_altitude_m);
    visit(length("ozone_half_width", "height over which ozone falls to nothing", 100.0, 1e5),
          atmosphere.ozone_half_width_m);
    visit(Field{.name = "ground_albedo",
                .sentence = "share of light that the ground throws back",
                .min = 0.0,
                .max = 1.0,
                .is_color = true},
          atmosphere.ground_albedo);
}

/// Whether the sun stands where its angles say, or where it is seen from a place at a time.
enum class SunPlacement { angles, place_and_time };
template <>
inline std::span<const std::string_view> enum_words<SunPlacement>() {
    static constexpr std::array<std::string_view, 2> words{"angles", "place_and_time"};
    return words;
}

/// The sun, from above the atmosphere. Compass: north is -z, east +x, up y.
struct Sun {
    SunPlacement placement = SunPlacement::angles;
    double elevation_deg = 45.0;   ///< above the horizon; negative: below
    double azimuth_deg = 135.0;    ///< from north over east
    double latitude_deg = 43.3;    ///< north positive
    double longitude_deg = -2.0;   ///< east positive
    glm::ivec3 date{2026, 6, 21};  ///< year, month, day of the Gregorian calendar
    double hour_utc = 12.0;
    glm::dvec3 irradiance{1.0};  ///< of a plane that faces it, above the atmosphere
    double angular_radius_deg = 0.26786;
    bool limb_darkening = true;
    bool operator==(const Sun&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, Sun>
void visit_fields(Self& sun, Visitor&& visit) {
    const auto angle = [](std::string_view name, std::string_view sentence, double low, double high) {
        return Field{.name = name,
                     .unit = "deg",
                     .sentence = sentence,
                     .min = low,
                     .max = high,
                     .panel_min = low,
                     .panel_max = high};
    };
    visit(Field{.name = "placement", .sentence = "angles, or seen from a place at a time"}, sun.placement);
    visit(angle("elevation", "angles: above the horizon; negative: below", -90.0, 90.0), sun.elevation_deg);
    visit(angle("azimuth", "angles: from north (-z) over east (+x)", -360.0, 360.0), sun.azimuth_deg);
    visit(angle("latitude", "place: north positive", -90.0, 90.0), sun.latitude_deg);
    visit(angle("longitude", "place: east positive", -180.0, 180.0), sun.longitude_deg);
    visit(Field{.name = "date", .sentence = "time: year, month, day", .min = 1, .max = 9999}, sun.date);
    visit(Field{.name = "hour_utc",
                .unit = "h",
                .sentence = "time: hours of universal time",
                .min = 0.0,
                .max = 24.0,
                .panel_max = 24.0},
          sun.hour_utc);
    visit(Field{.name = "irradiance",
                .sentence = "of a plane that faces the sun above the atmosphere",
                .min = 0.0,
                .max = 1e9,
                .is_color = true},
          sun.irradiance);
    visit(angle("angular_radius", "half the angle that the disc is seen under", 0.01, 10.0), sun.angular_radius_deg);
    visit(Field{.name = "limb_darkening", .sentence = "the rim of the disc is darker and redder"}, sun.limb_darkening);
}

/// atmosphere: Hillaire 2020; preetham: Preetham, Shirley, Smits 1999, from the ground by day only; look: the single
/// scattering look of three.js' Sky, which Alaminos 2020 used. All have one unit, radiance where the sun's irradiance
/// above the air is `Sun::irradiance`, light clouds and meshes with their own light, and stand over the same ground,
/// sun and air before things, which are the atmosphere's.
enum class SkyModel { atmosphere, preetham, look };
template <>
inline std::span<const std::string_view> enum_words<SkyModel>() {
    static constexpr std::array<std::string_view, 3> words{"atmosphere", "preetham", "look"};
    return words;
}

/// The sky behind everything.
struct Sky {
    SkyModel model = SkyModel::atmosphere;
    bool multiple_scattering = true;
    bool shafts = true;      ///< clouds before the sun leave the air behind them dark
    double turbidity = 2.0;  ///< preetham, look: 2 clear, 10 hazy
    double look_rayleigh = 1.0;
    double look_mie = 0.005;
    double look_mie_g = 0.8;
    bool operator==(const Sky&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, Sky>
void visit_fields(Self& sky, Visitor&& visit) {
    visit(
        Field{.name = "model", .sentence = "atmosphere: physical; preetham and look: for comparison, from the ground"},
        sky.model);
    visit(Field{.name = "multiple_scattering", .sentence = "atmosphere: light scattered more than once"},
          sky.multiple_scattering);
    visit(Field{.name = "shafts", .sentence = "air in the shadows of clouds is dark, so that beams of light are seen"},
          sky.shafts);
    visit(Field{.name = "turbidity",
                .sentence = "preetham, look: 2 is clear, 10 hazy, and preetham goes no further",
                .min = 2.0,
                .max = 20.0,
                .panel_min = 2.0,
                .panel_max = 10.0},
          sky.turbidity);
    visit(Field{.name = "look_rayleigh",
                .sentence = "look: strength of the air",
                .min = 0.0,
                .max = 10.0,
                .panel_max = 4.0},
          sky.look_rayleigh);
    visit(Field{.name = "look_mie", .sentence = "look: strength of the haze", .min = 0.0, .max = 1.0, .panel_max = 0.1},
          sky.look_mie);
    visit(Field{.name = "look_mie_g",
                .sentence = "look: asymmetry of the haze",
                .min = 0.0,
                .max = 0.99,
                .panel_max = 0.99},
          sky.look_mie_g);
}

/// Luminance of linear Rec.709.
inline double luminance(const glm::dvec3& rgb) {
    return glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722));
}

/// The models for comparison are skies seen from the ground: their share of the sky at an altitude in metres, 1 up to
/// 1 km; the rest, all from 20 km on, is the atmosphere's.
double ground_sky_share(double altitude_m);

/// Unit vector from the scene to the middle of the sun's disc. Place and time after the low-precision formulas of the
/// Astronomical Almanac (Michalsky 1988, "The Astronomical Almanac's Algorithm for Approximate Solar Position"), within
/// 0.01 degrees from 1950 to 2050, without refraction.
glm::dvec3 to_sun_world(const Sun& sun);

struct SunAngles {
    double elevation_deg = 0.0, azimuth_deg = 0.0;
};
SunAngles sun_angles(double latitude_deg, double longitude_deg, glm::ivec3 date, double hour_utc);

/// Throws InputError, with `name` in front, for a date that no calendar has.
void check(const Sun& sun, std::string_view name);

}  // namespace bruma::scene
