#version 450 core
// Light of the whole sky on the ground, over the sun's climb. Row 0: on a level plane; row 1: from all upward directions
// alike. Without the sun's disc.
layout(local_size_x = 64, local_size_y = 1) in;
layout(rgba32f, binding = 0) writeonly uniform image2D table;

#include "include/sky_air.glsl"
#include "include/sky_tables.glsl"

const int rings = 24;    // of zenith angles
const int sectors = 16;  // of half a turn; the other half mirrors it
const int steps = 24;

void main()
{
    ivec2 size = imageSize(table);
    int texel = int(gl_GlobalInvocationID.x);
    if (texel >= size.x) {
        return;
    }
    float sun_climb = climb_of_irradiance_coordinate(float(texel) / float(size.x - 1));
    vec3 to_sun = vec3(sqrt(max(0.0, 1.0 - sun_climb * sun_climb)), sun_climb, 0.0);
    vec3 planar = vec3(0.0);
    vec3 scalar = vec3(0.0);
    for (int n = 0; n < rings * sectors; ++n) {
        float zenith = 1.57079633 * (float(n / sectors) + 0.5) / float(rings);
        float azimuth = 3.14159265 * (float(n % sectors) + 0.5) / float(sectors);
        vec3 direction = vec3(sin(zenith) * cos(azimuth), cos(zenith), sin(zenith) * sin(azimuth));
        vec3 from = vec3(0.0, 1.0, 0.0);
        AirLight light = sky_along(from, direction, 1.0, direction.y, false, to_sun, steps);
        vec3 radiance = radiance_of(light, dot(direction, to_sun)) * sin(zenith);
        scalar += radiance;
        planar += radiance * cos(zenith);
    }
    const float share = 2.0 * (1.57079633 / float(rings)) * (3.14159265 / float(sectors));
    imageStore(table, ivec2(texel, 0), vec4(share * planar, 1.0));
    imageStore(table, ivec2(texel, 1), vec4(share * scalar, 1.0));
}
