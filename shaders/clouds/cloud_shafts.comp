#version 450 core
// Light that air would scatter towards the eye, were there no clouds before the sun: summed along rays through cells of
// the picture, up to distances that grow with the distance. Rays go on below the ground as through its lowest air, so
// that neighbours on both sides of a horizon or an edge hold alike sums: a pixel looks its own distance up.
// CLOUD_SHADOWS: see clouds/cloud_shadow.glsl.
layout(local_size_x = 8, local_size_y = 8) in;
vec2 cell_centre = vec2(0.0);
#define PIXEL_CENTRE cell_centre
#include "include/view_ray.glsl"
#include "sky/sky_air.glsl"
#include "sky/sky_tables.glsl"
#include "clouds/cloud_shadow.glsl"
#include "clouds/shafts.glsl"

layout(rgba16f, binding = 0) writeonly uniform image3D missing;
layout(rgba16f, binding = 1) writeonly uniform image3D missing_share;  // of all the air's light up to there
layout(rgba16f, binding = 2) writeonly uniform image3D ground;  // what lit ground at that distance would send to the eye
uniform mat3 world_from_camera;
uniform float eye_altitude;
uniform vec3 to_sun;
uniform float cell;      // edge in pixels
uniform float top;       // altitude that no cloud reaches, m
uniform float sample_m;  // between two looks at the shadows

const int most_samples = 6;

// Mean share of the sun's light that clouds hold back between two distances, both below the top.
float shaded(vec3 start, vec3 direction, float low, float high)
{
    int samples = int(clamp(ceil((high - low) / sample_m), 1.0, float(most_samples)));
    float sum = 0.0;
    for (int n = 0; n < samples; ++n) {
        vec3 q = start + mix(low, high, (float(n) + 0.5) / float(samples)) * direction;
        sum += 1.0 - light_through_clouds_at(vec3(q.x, max(altitude_above(q), 0.0), q.z));
    }
    return sum / float(samples);
}

// What a segment of air adds to a ray under the whole sun: light scattered once, and more often; and what it lets through.
struct Glow {
    vec3 once;
    vec3 more;
    vec3 transmittance;
};

Glow glow_at(vec3 middle, float segment, float rayleigh_phase, float haze_phase)
{
    float altitude = clamp(altitude_above(middle), 0.0, air.height);
    float sun_climb = dot(up_at(middle), to_sun);
    AirPoint point = air_at(altitude);
    vec3 weight = segment_weight(point.extinction, segment);
    return Glow(weight * (point.rayleigh * rayleigh_phase + point.mie * haze_phase) * sun_transmittance(altitude, sun_climb),
                weight * (point.rayleigh + point.mie) * multiple_scattering(altitude, sun_climb),
                exp(-segment * point.extinction));
}

vec3 sun_from_ground(vec3 at)
{
    return air.ground_albedo * 0.318309886 * sun_on_ground(dot(up_at(at), to_sun));
}

void main()
{
    ivec3 size = imageSize(missing);
    ivec2 column = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(column, size.xy))) {
        return;
    }
    cell_centre = (vec2(column) + 0.5) * cell;
    ViewRay ray = view_ray();
    vec3 direction = normalize(world_from_camera * ray.toward);
    vec3 start = world_from_camera * ray.start + vec3(0.0, eye_altitude, 0.0);
    vec2 below = sphere_hits(altitude_above(start), dot(up_at(start), direction), top);
    float mu = dot(direction, to_sun);
    float rayleigh = rayleigh_phase(mu);
    float haze = mie_phase(mu, air.mie_g);

    vec3 passed = vec3(1.0);
    vec3 all = vec3(0.0);
    // Far above the clouds nothing is missing.
    int clear_parts = int(clamp(shafts.first / 1500.0, 0.0, 64.0));
    for (int n = 0; n < clear_parts; ++n) {
        float part = shafts.first / float(clear_parts);
        Glow glow = glow_at(start + (float(n) + 0.5) * part * direction, part, rayleigh, haze);
        all += passed * (glow.once + glow.more);
        passed *= glow.transmittance;
    }
    vec3 sum = vec3(0.0);
    float low = shaft_distance(0.0);
    imageStore(missing, ivec3(column, 0), vec4(0.0));
    imageStore(missing_share, ivec3(column, 0), vec4(0.0));
    imageStore(ground, ivec3(column, 0), vec4(passed * sun_from_ground(start + low * direction), 0.0));
    for (int k = 1; k < size.z; ++k) {
        float high = shaft_distance(float(k) / float(size.z - 1));
        Glow glow = glow_at(start + 0.5 * (low + high) * direction, high - low, rayleigh, haze);
        float begin = max(low, below.x);
        float end = min(high, below.y);
        if (end > begin) {
            sum += passed * glow.once * shaded(start, direction, begin, end) * (end - begin) / (high - low);
        }
        all += passed * (glow.once + glow.more);
        passed *= glow.transmittance;
        imageStore(missing, ivec3(column, k), vec4(sum, 0.0));
        imageStore(missing_share, ivec3(column, k), vec4(sum / max(all, 1e-20), 0.0));
        imageStore(ground, ivec3(column, k), vec4(passed * sun_from_ground(start + high * direction), 0.0));
        low = high;
    }
}
