// Light in the air from tables; for a sun of irradiance 1 above it. Needs sky_air.glsl.

uniform sampler2D transmittance_table;
uniform sampler2D multiple_table;    // nothing bound: light is scattered once
uniform sampler2D irradiance_table;  // of the ground by the sky, over the sun's climb: row 0 on a plane, row 1 scalar

vec3 look_up(sampler2D table, vec2 coordinates)
{
    return textureLod(table, table_texture_coordinate(clamp(coordinates, 0.0, 1.0), vec2(textureSize(table, 0))), 0.0).xyz;
}

vec3 transmittance_to_top(float altitude, float climb)
{
    return look_up(transmittance_table, transmittance_coordinates(altitude, climb));
}

// Of the sun's light. The table has no rays below the horizon and would answer with the horizon's own.
vec3 sun_transmittance(float altitude, float sun_climb)
{
    float share = sun_disc_above_horizon(altitude, sun_climb);
    return share * transmittance_to_top(altitude, max(sun_climb, horizon_climb(altitude)));
}

// Radiance per scattering length from all orders beyond the first; no phase function belongs to it.
vec3 multiple_scattering(float altitude, float sun_climb)
{
    return look_up(multiple_table, vec2(0.5 * sun_climb + 0.5, altitude / air.height));
}

// Where the irradiance table has the sun's climb: dense at the horizon.
float irradiance_coordinate(float sun_climb) { return 0.5 + 0.5 * sign(sun_climb) * sqrt(abs(sun_climb)); }
float climb_of_irradiance_coordinate(float x)
{
    float root = 2.0 * x - 1.0;
    return root * abs(root);
}

// Irradiance of level ground by the sun.
vec3 sun_on_ground(float sun_climb) { return max(sun_climb, 0.0) * sun_transmittance(0.0, sun_climb); }

// Radiance of the ground under sun and sky.
vec3 ground_radiance(float sun_climb)
{
    vec3 sky = look_up(irradiance_table, vec2(irradiance_coordinate(sun_climb), 0.0));
    return air.ground_albedo * 0.318309886 * (sun_on_ground(sun_climb) + sky);
}

// (1 - exp(-extinction length)) / extinction, without cancellation.
vec3 segment_weight(vec3 extinction, float segment)
{
    vec3 x = extinction * segment;
    vec3 series = 1.0 - x * (0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0)));
    return segment * mix((1.0 - exp(-x)) / max(x, 1e-10), series, lessThan(x, vec3(0.02)));
}

// Distance to the lowest point of a line; negative behind its origin.
float lowest_point(float altitude, float climb) { return -(air.radius + altitude) * climb; }

// What air adds to a ray and leaves of what is behind it. Phase functions are constant along a ray: `haze` still lacks
// that of haze, which is too sharp for tables.
struct AirLight {
    vec3 clear;
    vec3 haze;
    vec3 transmittance;
};

vec3 radiance_of(AirLight light, float mu) { return light.clear + light.haze * mie_phase(mu, air.mie_g); }

// Between two distances along a ray from a point relative to sea level below the camera. Segments grow with the square
// root of the distance to the ray's lowest point, where the air is densest.
AirLight air_light(vec3 from, vec3 direction, vec3 to_sun, float begin, float lowest, float end, int steps)
{
    lowest = clamp(lowest, begin, end);
    float before = sqrt(lowest - begin);
    float whole = before + sqrt(end - lowest);
    float rayleigh = rayleigh_phase(dot(direction, to_sun));
    AirLight light = AirLight(vec3(0.0), vec3(0.0), vec3(1.0));
    float low = begin;
    for (int n = 1; n <= steps; ++n) {
        float root = whole * (float(n) / float(steps)) - before;
        float high = lowest + root * abs(root);
        vec3 at = from + 0.5 * (low + high) * direction;
        float altitude = clamp(altitude_above(at), 0.0, air.height);
        float sun_climb = dot(up_at(at), to_sun);
        AirPoint point = air_at(altitude);
        vec3 weight = light.transmittance * segment_weight(point.extinction, high - low);
        vec3 sun = sun_transmittance(altitude, sun_climb);
        light.clear += weight * (point.rayleigh * rayleigh * sun +
                                 (point.rayleigh + point.mie) * multiple_scattering(altitude, sun_climb));
        light.haze += weight * point.mie * sun;
        light.transmittance *= exp(-(high - low) * point.extinction);
        low = high;
    }
    return light;
}

// All that is seen along a ray that meets nothing but air and ground; the sun's disc apart. `climb` is the ray's at its
// origin; the origin may be outside the air.
AirLight sky_along(vec3 from, vec3 direction, float altitude, float climb, bool toward_ground, vec3 to_sun, int steps)
{
    vec2 top = sphere_hits(altitude, climb, air.height);
    float begin = max(top.x, 0.0);
    if (top.y <= begin) {
        return AirLight(vec3(0.0), vec3(0.0), vec3(1.0));
    }
    if (altitude <= air.height) {
        begin = 0.0;
    }
    float end = toward_ground ? max(distance_to_ground(altitude, climb), begin) : top.y;
    AirLight light = air_light(from, direction, to_sun, begin, lowest_point(altitude, climb), end, steps);
    if (toward_ground) {
        light.clear += light.transmittance * ground_radiance(dot(up_at(from + end * direction), to_sun));
    }
    return light;
}
