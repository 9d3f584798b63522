#version 450 core
// One more path per pixel through measured volumes, added to the mean and the spread of those before it. A path follows
// light from the eye backwards: delta tracking from collision to collision, at each the lights in view through the
// medium (ratio tracking) and its own glow; where it leaves, the background or, once scattered, the environment.
// VOLUMES, LIGHTS: how many. GLOW: some volume shines by itself.

#include "include/random.glsl"
#include "include/ray_box.glsl"
#include "include/phase_function.glsl"
#include "paths/path_medium.glsl"
#include "paths/path_flight.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba32f) uniform image2D mean_image;    // linear radiance; alpha = 1 - transmittance
layout(binding = 1, rgba32f) uniform image2D spread_image;  // sum of squared differences from the mean

uniform ivec2 pixels;             // size of the picture
uniform int first_row;            // of this dispatch; the rows below are done
uniform int path_number;          // from 0: paths per pixel before this one
uniform int scattering_limit;     // no light that was scattered more often is counted
uniform int orthographic;
uniform vec2 half_view;           // perspective: tangents; orthographic: half sizes
uniform float near_distance;      // along the view axis
uniform vec3 eye;                 // medium space, as are the axes: right, up, back
uniform mat3 medium_from_camera;
uniform vec3 background_top;
uniform vec3 background_bottom;
uniform vec3 environment;

struct PathLight {
    vec3 power;       // irradiance across the beam; with a position: at a distance of 1
    vec3 place;       // unit, towards the light; with a position: where it stands
    vec3 axis;        // spot: unit, against the beam; 0 for a point light
    vec2 cone;        // spot: cosine at the edge, 1 / (cosine where the edge begins to fade - that)
    int has_position;
};
uniform PathLight lights[LIGHTS + 1];

const float brightest = 1e18;       // a path may carry no more: the spread squares it
const float dim = 0.05;             // paths of less weight die by chance
const int free_scatterings = 4096;  // as `free_events` of a flight
const int most_scatterings = 8192;

// Light of one lamp that is scattered at x into the path.
vec3 light_from(PathLight light, vec3 x, vec3 direction, float g)
{
    vec3 toward = light.place;
    float far = never;
    vec3 irradiance = light.power;
    if (light.has_position != 0) {
        vec3 way = light.place - x;
        float squared = max(dot(way, way), 1e-12);
        far = sqrt(squared);
        toward = way / far;
        float inside = clamp((dot(toward, light.axis) - light.cone.x) * light.cone.y, 0.0, 1.0);
        irradiance = min(irradiance * (inside * inside * (3.0 - 2.0 * inside) / squared), vec3(1e30));
    }
    irradiance *= phase_function(dot(direction, toward), g);
    return irradiance == vec3(0.0) ? vec3(0.0) : irradiance * transmittance(x, toward, far);
}

vec3 direct_light(vec3 x, vec3 direction, float g)
{
    vec3 light = vec3(0.0);
#if LIGHTS > 4
    // Of many lamps one, drawn by lot.
    int n = min(int(next_random().x * float(LIGHTS)), LIGHTS - 1);
    light = float(LIGHTS) * light_from(lights[n], x, direction, g);
#else
    for (int n = 0; n < LIGHTS; ++n) {
        light += light_from(lights[n], x, direction, g);
    }
#endif
    return light;
}

vec4 trace_path(vec2 position)
{
    vec2 across = (position / vec2(pixels) * 2.0 - 1.0) * half_view;
    vec3 origin = eye;
    vec3 direction = -medium_from_camera[2];
    Collision c = Collision(near_distance, vec3(0.0), vec3(0.0), 0.0);
    if (orthographic != 0) {
        origin += medium_from_camera * vec3(across, 0.0);
    } else {
        vec3 toward = vec3(across, -1.0);
        c.t *= length(toward);
        direction = medium_from_camera * normalize(toward);
    }
    vec3 light = vec3(0.0);
    vec3 weight = vec3(1.0);
    vec3 beyond = mix(background_bottom, background_top, position.y / float(pixels.y));
    float alpha = 0.0;
    for (int scatterings = 0; scatterings < most_scatterings; ++scatterings) {
        begin_walk(origin, direction, c.t, never);
        float chance;
        bool collided = fly(c, chance);
        weight *= chance;
        if (!collided) {
            light += weight * beyond;
            break;
        }
        alpha = 1.0;
        beyond = environment;
        light += weight * c.glow;
        weight *= c.albedo;
        vec4 numbers = next_random();
        float most = max(weight.x, max(weight.y, weight.z));
        float kept = most < dim ? most / dim : scatterings >= free_scatterings ? survival : 1.0;
        if (scatterings >= scattering_limit || !(numbers.x < kept)) {
            break;
        }
        weight /= kept;
        origin += c.t * direction;
        light += weight * direct_light(origin, direction, c.g);
        direction = turned_direction(direction, scattering_cosine(numbers.y, c.g), numbers.z);
        c.t = 0.0;
    }
    return vec4(min(light, vec3(brightest)), alpha);
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, first_row);
    if (any(greaterThanEqual(pixel, pixels))) {
        return;
    }
    begin_random(uvec2(pixel), path_number);
    vec4 value = trace_path(vec2(pixel) + 0.5);
    // Mean and spread by Welford's recurrence (1962): sums of squares would lose the digits of small variances.
    vec4 mean = vec4(0.0);
    vec4 spread = vec4(0.0);
    if (path_number > 0) {
        mean = imageLoad(mean_image, pixel);
        spread = imageLoad(spread_image, pixel);
    }
    vec4 difference = value - mean;
    mean += difference / float(path_number + 1);
    spread += difference * (value - mean);
    imageStore(mean_image, pixel, mean);
    imageStore(spread_image, pixel, spread);
}
