#version 450 core
// Light scattered more than once, over the sun's climb and the altitude: the second order, gathered from all directions
// and taken as even, times the geometric series of all that follow (Hillaire 2020, section 5.5).
layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, binding = 0) writeonly uniform image2D table;

#include "sky/sky_air.glsl"
#include "sky/sky_tables.glsl"

const int edge = 8;    // directions along each of two angles
const int steps = 20;

vec3 gathered;   // mean radiance of the second order
vec3 scattered;  // mean share that is scattered again

void gather(float altitude, vec3 direction, vec3 to_sun)
{
    bool toward_ground = direction.y < horizon_climb(altitude);
    float end = toward_ground ? distance_to_ground(altitude, direction.y) : distance_to_top(altitude, direction.y);
    float segment = end / float(steps);
    vec3 passed = vec3(1.0);
    vec3 from = vec3(0.0, altitude, 0.0);
    for (int n = 0; n < steps; ++n) {
        vec3 at = from + (float(n) + 0.5) * segment * direction;
        float height = clamp(altitude_above(at), 0.0, air.height);
        AirPoint point = air_at(height);
        vec3 share = passed * (point.rayleigh + point.mie) * segment_weight(point.extinction, segment);
        gathered += share * sun_transmittance(height, dot(up_at(at), to_sun)) * 0.0795774715;
        scattered += share;
        passed *= exp(-segment * point.extinction);
    }
    if (toward_ground) {
        float climb = dot(up_at(from + end * direction), to_sun);
        gathered += passed * sun_transmittance(0.0, climb) * max(0.0, climb) * air.ground_albedo * 0.318309886;
    }
}

void main()
{
    ivec2 size = imageSize(table);
    ivec2 texel = ivec2(gl_GlobalInvocationID);
    if (any(greaterThanEqual(texel, size))) {
        return;
    }
    vec2 coordinates = table_coordinate(texel, size);
    float sun_climb = 2.0 * coordinates.x - 1.0;
    vec3 to_sun = vec3(0.0, sun_climb, sqrt(max(0.0, 1.0 - sun_climb * sun_climb)));
    gathered = vec3(0.0);
    scattered = vec3(0.0);
    for (int n = 0; n < edge * edge; ++n) {
        float climb = 1.0 - 2.0 * (float(n / edge) + 0.5) / float(edge);
        float azimuth = 6.28318531 * (float(n % edge) + 0.5) / float(edge);
        float level = sqrt(1.0 - climb * climb);
        gather(coordinates.y * air.height, vec3(level * cos(azimuth), climb, level * sin(azimuth)), to_sun);
    }
    const float share = 1.0 / float(edge * edge);
    imageStore(table, texel, vec4(share * gathered / (1.0 - min(share * scattered, 0.999)), 1.0));
}
