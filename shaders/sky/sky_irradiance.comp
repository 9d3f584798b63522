#version 450 core
// Light of the whole sky on the ground, over the sun's climb. Row 0: on a level plane; row 1: from all upward directions
// alike. Without the sun's disc. PREETHAM, LOOK: of these models, brought to the atmosphere's unit by a scale that stands
// in row 0 too, as alpha.
layout(local_size_x = 64, local_size_y = 1) in;
layout(rgba32f, binding = 0) writeonly uniform image2D table;

#include "sky/sky_air.glsl"
#include "sky/sky_tables.glsl"
#if defined(PREETHAM) || defined(LOOK)
#define MODEL
#include "sky/sun_disc.glsl"
#include "sky/sky_model.glsl"
#endif

const int rings = 24;    // of zenith angles
const int sectors = 16;  // of half a turn; the other half mirrors it
const int steps = 24;

#ifdef MODEL
float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

// Both light of the atmosphere on entry, of the model on return. The scale is the result.
float become_model(vec3 to_sun, inout vec3 planar, inout vec3 scalar)
{
    const int fine_rings = 64;
    const int fine_sectors = 48;
    float atmosphere = luminance(planar);
    planar = vec3(0.0);
    scalar = vec3(0.0);
    for (int n = 0; n < fine_rings * fine_sectors; ++n) {
        float zenith = 1.57079633 * (float(n / fine_sectors) + 0.5) / float(fine_rings);
        float azimuth = 3.14159265 * (float(n % fine_sectors) + 0.5) / float(fine_sectors);
        vec3 direction = vec3(sin(zenith) * cos(azimuth), cos(zenith), sin(zenith) * sin(azimuth));
        vec3 radiance = model_sky(direction, to_sun) * sin(zenith);
        scalar += radiance;
        planar += radiance * cos(zenith);
    }
    const float share = 2.0 * (1.57079633 / float(fine_rings)) * (3.14159265 / float(fine_sectors));
    planar *= share;
    scalar *= share;
#ifdef LOOK
    // It has no unit of its own: a level plane gets as much light as from the atmosphere.
    float scale = atmosphere / max(luminance(planar), 1e-30);
#else
    // It is a fit by day, several times too bright under a low sun: a level plane gets at most half of what the sun sends
    // down, which is what air that scatters evenly does not throw back, and the atmosphere's light, which is what is left
    // at twilight.
    float scale = min(1.0, (0.5 * max(to_sun.y, 0.0) + atmosphere) / max(luminance(planar), 1e-30));
#endif
    planar *= scale;
    scalar *= scale;
    return scale;
}
#endif

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
    planar *= share;
    scalar *= share;
    float scale = 1.0;
#ifdef MODEL
    scale = become_model(to_sun, planar, scalar);
#endif
    imageStore(table, ivec2(texel, 0), vec4(planar, scale));
    imageStore(table, ivec2(texel, 1), vec4(scalar, 1.0));
}
