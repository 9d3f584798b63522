#version 450 core
// Light of one layer of clouds along each pixel's ray, up to the opaque surfaces.
// BOX: a block in a flat world, else a shell around the planet. OPAQUE: rays end at surfaces. CONE: six samples towards
// the sun at every point, else the grid of optical depths. LEAP, BIG_STEPS, STOP_EARLY, SPARE_DETAIL: techniques that are
// on. SPARSE: one of each four by four pixels is drawn, into a picture of that many. ADAPT: segments aim at an optical
// depth. AIR: there is air around and before them. COUNT: counts what is looked up. Others: see include/cloud_*.glsl.

#ifdef SPARSE
uniform ivec2 pixel_offset;
#define PIXEL_CENTRE (floor(gl_FragCoord.xy) * 4.0 + vec2(pixel_offset) + 0.5)
#endif
#include "include/random.glsl"
#include "clouds/cloud_field.glsl"
#include "clouds/cloud_intervals.glsl"
#include "clouds/cloud_light.glsl"
#include "include/view_ray.glsl"
#ifdef AIR
#include "sky/sky_air.glsl"
#include "sky/sky_tables.glsl"
#include "clouds/cloud_air.glsl"
#endif

layout(location = 0) out vec4 clouds;          // linear radiance that they add; alpha: their transmittance
layout(location = 1) out float mean_distance;  // metres, weighted by what each part hides; 0: nothing is hidden
#ifdef COUNT
layout(location = 2) out uvec4 counts;         // turns of the march, lookups of weather, noise, light
#endif

uniform mat3 world_from_camera;
uniform float eye_altitude;      // m
uniform float near_distance;     // m
uniform float planet_radius;     // m
uniform vec2 band;               // altitudes between which cloud can be, m
uniform float reach;             // m
uniform vec4 steps;              // shortest, m; shortest per distance; optical depth aimed at; transmittance to stop at
uniform int most_turns;
uniform int jitter;              // 0 off, 1 hashed, 2 blue noise
uniform uint frame;
uniform sampler2D blue_noise;
#ifdef BOX
uniform vec4 box;                // low x, low z, high x, high z from the eye, m
#endif
#ifdef OPAQUE
uniform sampler2D opaque_distance;
uniform float metres_per_unit;
#endif
#ifdef CONE
uniform vec3 cone_kernel[6];
uniform vec3 cone;               // spread, reach of five samples, reach of the sixth, m
uniform vec2 layer_altitudes;    // m
uniform sampler3D depth_up;
#else
uniform sampler3D depths;        // towards the sun, up, down; in columns that lean towards the sun
uniform vec2 lean;
#endif
#ifdef LEAP
uniform usampler3D emptiness;    // cells to the nearest with cloud
uniform vec3 cells_per_metre;
uniform vec2 cells_origin;
#endif

const float big = 4.0;

float sample_place()
{
    if (jitter == 1) {
        return random_unit(uvec2(PIXEL_CENTRE), frame, 0u);
    }
    if (jitter == 2) {
        // The golden ratio turns one tile into as many as there are frames.
        float u = texelFetch(blue_noise, ivec2(PIXEL_CENTRE) % max(textureSize(blue_noise, 0), ivec2(1)), 0).x;
        return fract(u + float(frame % 64u) * 0.61803399);
    }
    return 0.5;
}

vec3 direction = vec3(0.0);
vec3 start = vec3(0.0);

// (x, altitude, z) of the ray's point at t; x and z from the eye.
vec3 pattern_point(vec3 q)
{
#ifdef BOX
    return q;
#else
    return vec3(q.x, altitude_above(planet_radius, q), q.z);
#endif
}

#ifdef LEAP
// Metres along the ray that hold no cloud, from the cells around p that the weather map leaves clear.
float clear_way(vec3 p, vec3 q)
{
    ivec3 size = textureSize(emptiness, 0);
    vec3 at = vec3(cells_origin + p.xz * cells_per_metre.xz, (p.y - band.x) * cells_per_metre.y).xzy;
    ivec3 cell = ivec3(floor(at));
    cell.y = clamp(cell.y, 0, size.z - 1);
    ivec3 wrapped = ivec3((cell.x % size.x + size.x) % size.x, (cell.z % size.y + size.y) % size.y, cell.y);
    float free = float(texelFetch(emptiness, wrapped, 0).x);
#ifdef BOX
    float climb = direction.y;
    const float bend = 0.0;
#else
    // Altitude bends upwards along a straight ray: within `most` it climbs by no more than this much more per metre.
    const float most = 20e3;
    float climb = (dot(q, direction) + planet_radius * direction.y) / (planet_radius + p.y);
    float bend = most / planet_radius;
#endif
    vec3 pace = vec3(direction.x, max(climb + bend, 1e-9), direction.z) * cells_per_metre;
    vec3 low = (vec3(cell) - free + 1.0 - at);
    vec3 high = (vec3(cell) + free - at);
    float way = min(high.y / pace.y, climb < 0.0 ? low.y / (climb * cells_per_metre.y) : 1e9);
    way = min(way, (direction.x > 0.0 ? high.x : low.x) / (abs(pace.x) > 1e-12 ? pace.x : 1e-12));
    way = min(way, (direction.z > 0.0 ? high.z : low.z) / (abs(pace.z) > 1e-12 ? pace.z : 1e-12));
    return free > 0.0 ? clamp(way, 0.0, 20e3) : 0.0;
}
#endif

// Of a plane that faces the sun, but for the clouds: nothing where the planet stands before it.
vec3 sun_irradiance(vec3 q, float altitude)
{
    vec3 to_sun = sky_light.to_sun.xyz;
#ifdef AIR
    return sun_through_air(q, altitude, to_sun);
#else
#ifdef BOX
    bool hidden = to_sun.y < 0.0;
#else
    float half_sum = dot(q, to_sun) + planet_radius * to_sun.y;
    bool hidden = half_sum < 0.0 && half_sum * half_sum >= altitude * (2.0 * planet_radius + altitude);
#endif
    return hidden ? vec3(0.0) : sky_light.sun_irradiance.rgb;
#endif
}

vec3 light_depths(vec3 p, vec3 q)
{
#ifdef CONE
    vec3 to_sun = sky_light.to_sun.xyz;
#ifdef BOX
    float leave = to_sun.y > 0.0 ? (layer_altitudes.y - p.y) / max(to_sun.y, 1e-8)
                                 : (layer_altitudes.x - p.y) / min(to_sun.y, -1e-8);
    vec2 sides = (mix(box.xy, box.zw, greaterThan(to_sun.xz, vec2(0.0))) - q.xz) /
                 mix(vec2(-1e-8), vec2(1e-8), greaterThan(to_sun.xz, vec2(0.0)));
    sides = (mix(box.xy, box.zw, greaterThan(to_sun.xz, vec2(0.0))) - q.xz) /
            (mix(vec2(-1.0), vec2(1.0), greaterThan(to_sun.xz, vec2(0.0))) * max(abs(to_sun.xz), vec2(1e-8)));
    leave = max(0.0, min(leave, min(sides.x, sides.y)));
#else
    float climb = (dot(q, to_sun) + planet_radius * to_sun.y) / (planet_radius + p.y);
    vec4 inside = shell_intervals(planet_radius, p.y, climb, layer_altitudes.x, layer_altitudes.y);
    float leave = max(inside.y, 0.0);
#endif
    float begin = 0.0;
    float sum = 0.0;
    for (int n = 0; n < 6; ++n) {
        float end = min(leave, n < 5 ? cone.y * float((n + 1) * (n + 1)) / 25.0 : cone.z);
        float middle = 0.5 * (begin + end);
        vec3 at = pattern_point(q + middle * (to_sun + cone.x * cone_kernel[n]));
        float rho = n < 3 ? cloud_density(at) : cloud_density_without_detail(at);
        sum += rho * max(0.0, end - begin);
        begin = max(begin, end);
    }
    vec2 tile = layer.weather_origin + p.xz * layer.scales.x;
    float slices = float(textureSize(depth_up, 0).z);
    float share = clamp((p.y - band.x) / (band.y - band.x), 0.0, 1.0);
    float up = textureLod(depth_up, vec3(tile, (share * (slices - 1.0) + 0.5) / slices), 0.0).x;
    float whole = textureLod(depth_up, vec3(tile, 0.5 / slices), 0.0).x;
    return vec3(optics.extinction * sum, up, max(0.0, whole - up));
#else
    float slices = float(textureSize(depths, 0).z);
    float above = clamp(p.y - band.x, 0.0, band.y - band.x);
    vec2 foot = layer.weather_origin + (p.xz - lean * above) * layer.scales.x;
    return textureLod(depths, vec3(foot, (above / (band.y - band.x) * (slices - 1.0) + 0.5) / slices), 0.0).xyz;
#endif
}

// (1 - exp(-x)) / x without cancelling (Hillaire 2015).
float segment_share(float x)
{
    return x < 0.02 ? 1.0 - x * (0.5 - x * (1.0 / 6.0 - x / 24.0)) : (1.0 - exp(-x)) / x;
}

void main()
{
    ViewRay ray = view_ray();
    float stretch = length(ray.toward);
    direction = world_from_camera * (ray.toward / stretch);
    start = world_from_camera * ray.start + vec3(0.0, eye_altitude, 0.0);
#ifdef BOX
    vec3 slope = mix(vec3(1e-8), abs(direction), greaterThan(abs(direction), vec3(1e-8)));
    slope = mix(-slope, slope, greaterThanEqual(direction, vec3(0.0)));
    vec3 a = (vec3(box.x, band.x, box.y) - start) / slope;
    vec3 b = (vec3(box.z, band.y, box.w) - start) / slope;
    vec3 near = min(a, b);
    vec3 far = max(a, b);
    vec4 parts = vec4(max(max(near.x, near.y), max(near.z, 0.0)), min(min(far.x, far.y), far.z), 0.0, 0.0);
    // The ground of a flat world is the plane y = 0.
    float ground = direction.y < 0.0 && start.y > 0.0 ? -start.y / direction.y : 1e30;
    parts.y = min(parts.y, ground);
#else
    float from = orthographic != 0 ? altitude_above(planet_radius, start) : eye_altitude;
    float climb = orthographic != 0 ? dot(normalize(start + vec3(0.0, planet_radius, 0.0)), direction) : direction.y;
    vec4 parts = shell_intervals(planet_radius, from, climb, band.x, band.y);
#endif
    float farthest = reach;
#ifdef OPAQUE
    farthest = min(farthest, texelFetch(opaque_distance, min(ivec2(PIXEL_CENTRE), ivec2(pixels) - 1), 0).x * metres_per_unit);
#endif
    parts.yw = min(parts.yw, vec2(farthest));
    parts.x = max(parts.x, near_distance * stretch);

    float t = parts.x;
    float end = parts.y;
    vec2 later = parts.zw;
    float done = t;  // nothing before is shaded again
    float u = sample_place();
    begin_cloud_light(dot(direction, sky_light.to_sun.xyz));

    vec3 radiance = vec3(0.0);
    float transmittance = 1.0;
    float hidden_distance = 0.0;
#ifdef BIG_STEPS
    bool searching = true;
#else
    const bool searching = false;
#endif
    int misses = 0;
    float next = 0.0;
    int turn = 0;
    for (; turn < most_turns; ++turn) {
        if (t >= end) {
            if (later.y <= later.x) {
                break;
            }
            t = done = max(later.x, t);
            end = later.y;
            later = vec2(0.0);
#ifdef BIG_STEPS
            searching = true;
#endif
        }
        float shortest = max(steps.x, steps.y * t);
#ifdef LEAP
        vec3 here = start + t * direction;
        float leap = clear_way(pattern_point(here), here);
        t = min(t + leap, end);
        done = leap > 0.0 ? t : done;
#endif
        float h = min(searching ? big * shortest : max(next, shortest), end - t);
        if (turn == most_turns - 1) {
            h = end - t;  // what remains, as one segment
        }
        vec3 q = start + (t + u * h) * direction;
        vec3 p = pattern_point(q);
        CloudColumn column = cloud_column(p);
        float shape = cloud_shape(column);
#ifdef SPARE_DETAIL
        float detail = h * layer.scales.z > 1.0 ? 0.474 : cloud_detail(column);
#else
        float detail = cloud_detail(column);
#endif
        float sigma = optics.extinction * cloud_eroded(column, shape, detail);
        float depth = sigma * h;
        bool met = shape > 0.0;
#ifdef BIG_STEPS
        if (searching && met && h > 1.001 * shortest && turn < most_turns - 1) {
            // Somewhere between the last sample and this one it began.
            t = max(t - big * shortest, done);
            searching = false;
            misses = 0;
            next = shortest;
            continue;
        }
#endif
#ifdef ADAPT
        if (depth > 3.0 * steps.z && h > 1.5 * shortest && turn < most_turns - 1) {
            next = max(shortest, steps.z / sigma);
            continue;
        }
        next = sigma > 0.0 ? clamp(steps.z / sigma, shortest, big * shortest) : shortest;
#else
        next = shortest;
#endif
        // The light of a segment comes from the mean depth at which it is scattered.
        float share = segment_share(depth);
        float passed = exp(-depth);
        float deep = depth > 0.02 ? (share - passed) / max(depth * share, 1e-20) : 0.5;
        vec3 q_light = q + ((clamp(deep, 0.0, 1.0) - u) * h) * direction;
        vec3 p_light = pattern_point(q_light);
        vec3 source = cloud_light(sun_irradiance(q_light, p_light.y), light_depths(p_light, q_light));
        radiance += transmittance * depth * share * source;
        float hides = transmittance * (1.0 - passed);
        hidden_distance += hides * (t + u * h);
        transmittance *= passed;
        t += h;
#ifdef BIG_STEPS
        misses = met ? 0 : misses + 1;
        if (!searching) {
            done = t;
            searching = misses >= 8;
        }
#endif
#ifdef STOP_EARLY
        if (transmittance < steps.w) {
            break;
        }
#endif
    }
    mean_distance = transmittance < 1.0 - 1e-6 ? hidden_distance / (1.0 - transmittance) : 0.0;
#ifdef STOP_EARLY
    // For every ray, so that an early end is the limit of a late one and nothing shines through.
    transmittance = clamp((transmittance - steps.w) / (1.0 - steps.w), 0.0, 1.0);
#endif
    clouds = vec4(radiance, transmittance);
#ifdef AIR
    if (mean_distance > 0.0) {
        clouds = behind_air(clouds, start, direction, mean_distance, sky_light.to_sun.xyz);
    }
#endif
#ifdef COUNT
#ifdef CONE
    counts = uvec4(turn, turn * 7, turn * 11, turn * 2);
#else
    counts = uvec4(turn, turn, turn * 2, turn);
#endif
#endif
}
