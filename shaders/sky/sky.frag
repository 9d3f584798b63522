#version 450 core
// The sky, the ground and the sun's disc around the camera, and the air before the scene's surfaces.
// PREETHAM, LOOK: models for comparison in place of the atmosphere above the horizon. MARCH: along each pixel's ray
// instead of from the sky-view table, where rays have origins of their own or come from high up. OPAQUE: there are
// surfaces.
#include "include/view_ray.glsl"
#include "sky/sky_air.glsl"
#include "sky/sky_tables.glsl"
#include "sky/sun_disc.glsl"
#if defined(PREETHAM) || defined(LOOK)
#define MODEL
#include "sky/sky_model.glsl"
uniform float model_share;     // 1 on the ground; the rest is the atmosphere, which knows the sky from higher up too
#endif

layout(location = 0) out vec4 picture;  // linear radiance; alpha = coverage by surfaces

uniform mat3 world_from_camera;
uniform float altitude;        // of the eye, one metre at least
uniform vec3 to_sun;           // world, unit
uniform vec3 irradiance;       // of the sun, above the air
uniform float sun_radius;      // radians
uniform int limb_darkening;
uniform float pixel_angle;     // radians; 0: parallel rays
#ifdef OPAQUE
#include "surfaces/opaque.glsl"
uniform vec2 distance_scale;   // metres = x times what the texture holds, plus y
#endif
uniform sampler2D clear_table;
uniform sampler2D haze_table;

// Where a ray starts: relative to the sea level below the camera, never under the ground.
struct Place {
    vec3 from;
    float altitude;
    float climb;         // of the ray
    bool toward_ground;
};

Place place_of(vec3 offset, vec3 direction)
{
#ifdef MARCH
    vec3 from = vec3(0.0, altitude, 0.0) + offset;
    float height = altitude_above(from);
    vec3 up = up_at(from);
    from += max(1.0 - height, 0.0) * up;
    height = max(height, 1.0);
    float climb = clamp(dot(up, direction), -1.0, 1.0);
#else
    vec3 from = vec3(0.0, altitude, 0.0);
    float height = altitude;
    float climb = direction.y;
#endif
    return Place(from, height, climb, climb < horizon_climb(height));
}

#ifndef MARCH
vec3 look_up_sky(vec3 direction, bool toward_ground)
{
    vec2 across = direction.xz;
    vec2 sun_across = to_sun.xz;
    float lengths = length(across) * length(sun_across);
    float azimuth_cosine = min(length(across), length(sun_across)) < 1e-6
                               ? 1.0
                               : clamp(dot(across, sun_across) / lengths, -1.0, 1.0);
    // Near straight up and down the arc cosine has lost its digits.
    float zenith_angle = atan(length(across), direction.y);
    vec2 at = sky_view_coordinates(altitude, zenith_angle, azimuth_cosine, toward_ground);
    // Rows are never blended over the horizon: the last of the sky and the first of the ground keep to themselves.
    float rows = float(textureSize(clear_table, 0).y - 1);
    float last_of_sky = floor(0.5 * rows) / rows;
    at.y = toward_ground ? max(at.y, last_of_sky + 1.0 / rows) : min(at.y, last_of_sky);
    float haze = mie_phase(dot(direction, to_sun), air.mie_g);
    return look_up(clear_table, at) + haze * look_up(haze_table, at);
}
#endif

vec3 atmosphere_radiance(Place place, vec3 direction)
{
#ifdef MARCH
    AirLight light = sky_along(place.from, direction, place.altitude, place.climb, place.toward_ground, to_sun, 40);
    return irradiance * radiance_of(light, dot(direction, to_sun));
#else
    return irradiance * look_up_sky(direction, place.toward_ground);
#endif
}

vec3 transmittance_of_sky(Place place)
{
    if (place.altitude <= air.height) {
        return transmittance_to_top(place.altitude, place.climb);
    }
    // From space: the way through the air starts at its upper end, where the climb is another.
    vec2 hits = sphere_hits(place.altitude, place.climb, air.height);
    if (hits.y <= 0.0) {
        return vec3(1.0);
    }
    float top = air.radius + air.height;
    float there = ((air.radius + place.altitude) * place.climb + hits.x) / top;
    // Down to the lowest point and up again: twice the half of the way.
    float lowest = (air.radius + place.altitude) * sqrt(max(1.0 - place.climb * place.climb, 0.0)) - air.radius;
    vec3 half_way = transmittance_to_top(clamp(lowest, 0.0, air.height), 0.0);
    return there < 0.0 ? half_way * half_way : vec3(1.0);
}

vec3 sun_disc(Place place, vec3 direction)
{
    if (place.toward_ground) {
        return vec3(0.0);
    }
    vec3 disc = sun_disc_in_pixel(angle_between(direction, to_sun), sun_radius, limb_darkening != 0, pixel_angle);
    return disc == vec3(0.0) ? disc : irradiance * disc * transmittance_of_sky(place);
}

vec3 sky_radiance(Place place, vec3 direction)
{
#ifdef MODEL
    if (place.toward_ground) {
        return atmosphere_radiance(place, direction);
    }
    vec3 model = irradiance * model_scale(to_sun.y);
#ifdef LOOK
    model *= look_radiance(direction, to_sun, turbidity, look.x, look.y, look.z, 1.0);  // with a disc of its own
#else
    model = model * model_sky(direction, to_sun) + sun_disc(place, direction);
#endif
    return model_share < 1.0
               ? mix(atmosphere_radiance(place, direction) + sun_disc(place, direction), model, model_share)
               : model;
#else
    return atmosphere_radiance(place, direction) + sun_disc(place, direction);
#endif
}

void main()
{
#ifdef OPAQUE
    if (opaque_share() == 0.0) {
        discard;
    }
#endif
    ViewRay ray = view_ray();  // metres
    vec3 direction = normalize(world_from_camera * ray.toward);
    Place place = place_of(world_from_camera * ray.start, direction);
#ifdef OPAQUE
    vec4 surface = opaque_surface();
    if (surface.w > 0.0) {
        float far = texelFetch(opaque_distance, ivec2(gl_FragCoord.xy), 0).x * distance_scale.x + distance_scale.y;
        vec2 top = sphere_hits(place.altitude, place.climb, air.height);
        float begin = place.altitude <= air.height ? 0.0 : max(top.x, 0.0);
        float end = min(far, top.y);
        vec3 before = surface.xyz;
        if (end > begin) {
            int steps = int(clamp((end - begin) / 2000.0, 2.0, 32.0));
            AirLight light = air_light(place.from, direction, to_sun, begin,
                                       lowest_point(place.altitude, place.climb), end, steps);
            before = surface.xyz * light.transmittance +
                     surface.w * irradiance * radiance_of(light, dot(direction, to_sun));
        }
        vec3 behind = surface.w < 1.0 ? sky_radiance(place, direction) : vec3(0.0);
        picture = vec4(before + (1.0 - surface.w) * behind, surface.w);
        return;
    }
#endif
    picture = vec4(sky_radiance(place, direction), 0.0);
}
