#include "scene/sky/sky.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace bruma::scene {
namespace {

constexpr double rad = std::numbers::pi / 180.0;

/// Days since noon of 1 January 2000, universal time.
double days_since_2000(glm::ivec3 date, double hour_utc) {
    // Days of the Gregorian calendar from years that begin in March, so that the leap day is the last.
    const int shift = (14 - date.y) / 12;
    const int year = date.x + 4800 - shift;
    const int month = date.y + 12 * shift - 3;
    const int noon = date.z + (153 * month + 2) / 5 + 365 * year + year / 4 - year / 100 + year / 400 - 32045;
    return double(noon) - 2451545.0 + (hour_utc - 12.0) / 24.0;
}

int days_of_month(int year, int month) {
    constexpr int days[12] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
    return days[month - 1] + (month == 2 && leap ? 1 : 0);
}

}  // namespace

SunAngles sun_angles(double latitude_deg, double longitude_deg, glm::ivec3 date, double hour_utc) {
    const double n = days_since_2000(date, hour_utc);
    const double mean_anomaly = rad * (357.528 + 0.9856003 * n);
    const double ecliptic_longitude =
        rad * (280.460 + 0.9856474 * n + 1.915 * std::sin(mean_anomaly) + 0.020 * std::sin(2.0 * mean_anomaly));
    const double obliquity = rad * (23.439 - 4e-7 * n);
    const double right_ascension =
        std::atan2(std::cos(obliquity) * std::sin(ecliptic_longitude), std::cos(ecliptic_longitude));
    const double declination = std::asin(std::sin(obliquity) * std::sin(ecliptic_longitude));
    const double greenwich_sidereal_h = 6.697375 + 0.0657098242 * n + hour_utc;
    const double hour_angle = rad * (15.0 * greenwich_sidereal_h + longitude_deg) - right_ascension;
    const double latitude = rad * latitude_deg;
    // Towards the sun in local axes; no tangent of a declination or latitude, so that poles are no special case.
    const double up =
        std::sin(declination) * std::sin(latitude) + std::cos(declination) * std::cos(latitude) * std::cos(hour_angle);
    const double east = -std::cos(declination) * std::sin(hour_angle);
    const double north =
        std::sin(declination) * std::cos(latitude) - std::cos(declination) * std::sin(latitude) * std::cos(hour_angle);
    const double azimuth_deg = std::atan2(east, north) / rad;
    return {std::atan2(up, std::hypot(east, north)) / rad, azimuth_deg < 0.0 ? azimuth_deg + 360.0 : azimuth_deg};
}

double ground_sky_share(double altitude_m) {
    const double climbed = std::clamp((altitude_m - 1e3) / 19e3, 0.0, 1.0);
    return 1.0 - climbed * climbed * (3.0 - 2.0 * climbed);
}

glm::dvec3 to_sun_world(const Sun& sun) {
    SunAngles at{sun.elevation_deg, sun.azimuth_deg};
    if (sun.placement == SunPlacement::place_and_time) {
        at = sun_angles(sun.latitude_deg, sun.longitude_deg, sun.date, sun.hour_utc);
    }
    const double elevation = rad * at.elevation_deg, azimuth = rad * at.azimuth_deg;
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), -std::cos(elevation) * std::cos(azimuth)};
}

void check(const Sun& sun, std::string_view name) {
    const glm::ivec3 date = sun.date;
    const bool known_month = date.x >= 1 && date.y >= 1 && date.y <= 12;
    if (!known_month || date.z < 1 || date.z > days_of_month(date.x, date.y)) {
        throw InputError(fmt::format("{}: {}-{}-{} is no date; give year, month 1 to 12 and a day of that month", name,
                                     date.x, date.y, date.z));
    }
}

}  // namespace bruma::scene
