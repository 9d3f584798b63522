#version 450 core
// A surface under the scene's lights: Lambert, with the highlight of Phong (1975) or Blinn (1977); or translucent, lit
// from inside.
// SAMPLES: how many a pixel has.

#include "mesh/covered_part.glsl"
#ifdef TRANSLUCENT
#include "subsurface/body_surface.glsl"
#include "subsurface/exit_maps.glsl"
#ifndef FROM_POINTS
#include "subsurface/exit_light.glsl"
#endif
#endif
#ifdef DEPTH_ONLY
void main() {}
#elif defined(THICKNESS)
// How far the way through the body is: where it leaves less where it enters, of each of its pieces.
in vec3 point_camera;
layout(location = 0) out float way;  // mm
uniform int orthographic;
uniform float mm_per_unit;

void main()
{
    float reached = mm_per_unit * (orthographic != 0 ? -point_camera.z : length(point_camera));
    way = gl_FrontFacing ? -reached : reached;
}
#elif defined(MAP_READS)
// Which texels of the maps a picture looks up.
layout(early_fragment_tests) in;
layout(std430, binding = 2) buffer Reads { uint reads[]; };  // see subsurface/exit_texels.glsl
uniform int last_texel;
uniform int row_words;

// What another program may round away, texels and cosines.
const float slack_of_place = 0.002;

void mark(int n, BodySurface s)
{
    vec2 place = exit_place(exit_cameras[n], s.position);
    ivec2 low = clamp(ivec2(floor(place - slack_of_place)), ivec2(0), ivec2(last_texel));
    ivec2 high = clamp(ivec2(floor(place + slack_of_place)), ivec2(0), ivec2(last_texel));
    for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
            int word = x / 32 + (y + n * (last_texel + 1)) * row_words;
            uint bit = 1u << (x % 32);
            if ((reads[word] & bit) == 0u) {  // dear where it is there already
                atomicOr(reads[word], bit);
            }
        }
    }
}

void main()
{
    find_covered_part();
    BodySurface s = body_surface();
    MapsAround maps = maps_around(s, slack_of_place);
    for (uint left = maps.square; left != 0u; left &= left - 1u) {
        mark(findLSB(left), s);
    }
    // The squarest map most often sees enough; the others are asked until they do.
    ExitSums sums = ExitSums(vec4(0.0), vec4(0.0));
    uint left = maps.square & ~(1u << maps.best);
    for (int n = maps.best; n >= 0 && needs_slanting_maps(sums); left &= left - 1u) {
        add_map(n, s, maps, sums);
        n = findLSB(left);
    }
    for (uint slanting = needs_slanting_maps(sums) ? maps.slanting : 0u; slanting != 0u; slanting &= slanting - 1u) {
        mark(findLSB(slanting), s);
    }
}
#else
#include "include/view_ray.glsl"
#include "light/lights.glsl"
#ifdef SKY_LIGHT
#include "sky/sky_light.glsl"
#endif
#ifdef TRANSLUCENT
#include "include/random.glsl"
#include "include/octahedral.glsl"
#include "subsurface/subsurface.glsl"
#ifdef FROM_POINTS
#include "subsurface/subsurface_entry.glsl"
uniform int entry_turns;          // how often `entry_samples` points are drawn
uniform usampler2D open_pixels;   // 1 where the maps left something open
#else
layout(early_fragment_tests) in;
uniform SubsurfaceMedium medium;
layout(binding = 0, r32ui) uniform uimage2D open_pixels;
layout(std430, binding = 3) buffer OpenTotals {
    uint open_count;
    uint open_low_x, open_low_y, open_high_x, open_high_y;
};
#endif

uniform vec3 diffuse_reflectance;  // of the matter, for light from all sides
uniform vec3 sigma_unscattered;    // 1/mm
uniform int see_through;           // whether `thickness` holds anything
uniform sampler2D thickness;
#endif

#ifdef SHADOWS
#include "light/shadow.glsl"
in vec3 position_shadow;
#endif
#ifdef CLOUD_SHADOWS
#include "clouds/cloud_shadow.glsl"
#endif

in vec3 point_camera;
in vec3 normal_world;
in vec2 coordinate;
#ifdef VERTEX_COLORS
in vec3 color;                     // linear
#endif
layout(location = 0) out vec4 radiance;       // linear; alpha = coverage
layout(location = 1) out vec2 distance_and_share;  // along the pixel's ray

uniform mat3 world_from_camera;
uniform vec3 ambient;      // radiance from all sides
uniform vec3 diffuse;      // albedo
uniform vec3 specular;
uniform float shininess;
uniform int highlight;     // 0 none, 1 Phong, 2 Blinn-Phong
uniform int textured;
uniform vec2 picture_range;   // what is added to the texture's values that were multiplied by the second
uniform int picture_once;     // whether it lies there once, and changes nothing around it
uniform vec3 emission;        // radiance
uniform int constant_color;   // whether the colour shows in any light
uniform sampler2D diffuse_texture;

// Drivers interpolate between corners that they moved onto a grid of part pixels, so the interpolated point lies on the
// surface but a little beside the ray. The plane through it and its neighbours leads back onto the ray.
float distance_on_ray(vec3 point, vec3 start, vec3 direction)
{
    vec3 from_start = point - start;
    float along = dot(from_start, direction);
    vec3 beside = from_start - along * direction;
    vec3 plane = cross(dFdx(point_camera), dFdy(point_camera));
    float facing = dot(plane, direction);
    float slope = dot(plane, beside) / (abs(facing) > 1e-30 ? facing : 1e30);
    // Seen edge-on, a plane says nothing any more; a hundred times what it is beside is more than honest planes ask.
    float most = 100.0 * length(beside);
    return along + clamp(slope, -most, most);
}

// Where a triangle covers part of a pixel only, the pixel's middle may lie beside it: its ray is that to the point that is
// shaded, and the middle's ray is taken to end as deep.
ViewRay surface_ray(bool whole, vec3 point)
{
    if (whole) {
        return view_ray();
    }
    return orthographic != 0 ? ViewRay(vec3(point.xy, 0.0), vec3(0.0, 0.0, -1.0)) : ViewRay(vec3(0.0), point);
}

vec3 diffuse_picture()
{
    vec2 at = WITHIN(coordinate);
    vec2 right = dFdx(coordinate), up = dFdy(coordinate);
    if (picture_once != 0) {
        vec2 half_texel = 0.5 / vec2(textureSize(diffuse_texture, 0));
        if (any(greaterThan(abs(at - 0.5), vec2(0.5)))) {
            return vec3(1.0);
        }
        at = clamp(at, half_texel, 1.0 - half_texel);  // nothing of the other edge
    }
    vec3 texel = textureGrad(diffuse_texture, at, right, up).xyz;
    return max(picture_range.x + picture_range.y * texel, 0.0);
}

// What the diffuse colour is multiplied by.
vec3 diffuse_factor()
{
    vec3 factor = textured != 0 ? diffuse_picture() : vec3(1.0);
#ifdef VERTEX_COLORS
    factor *= max(WITHIN(color), 0.0);
#endif
    return factor;
}

// Share of a lamp's light that no surface keeps away.
float arriving(int lamp, vec3 normal)
{
#ifdef SHADOWS
    vec3 facet = cross(dFdx(position_shadow), dFdy(position_shadow));
    float squared = dot(facet, facet);
    facet = squared > 1e-36 ? facet * inversesqrt(squared) : normal;
    return light_arriving(lamp, WITHIN(position_shadow), dot(facet, normal) < 0.0 ? -facet : facet);
#else
    return 1.0;
#endif
}

void add_light(Incident incident, vec3 normal, vec3 toward_eye, float facing_eye, inout vec3 reflected,
               inout vec3 mirrored)
{
    float cosine = dot(normal, incident.toward);
    reflected += incident.irradiance * max(cosine, 0.0);
    float between = dot(incident.toward, toward_eye);
    float aligned = highlight == 2 ? (cosine + facing_eye) * inversesqrt(max(2.0 + 2.0 * between, 1e-12))
                                   : 2.0 * cosine * facing_eye - between;
    float shine = exp2(shininess * log2(max(aligned, 1e-20)));
    mirrored += incident.irradiance * (min(cosine, aligned) > 0.0 ? shine : 0.0);
}

#ifdef TRANSLUCENT
// At outlines the normals of coarse triangles may turn away from the eye while the triangle does not: of a smooth surface
// no point that is seen does, and what leaves it is not black.
float facing_of_seen(float facing_eye, vec3 direction)
{
    vec3 plane = cross(dFdx(point_camera), dFdy(point_camera));
    float facet = abs(dot(plane, direction)) * inversesqrt(max(dot(plane, plane), 1e-36));
    return max(facing_eye, min(facet, 0.1));
}

bool is_open = false;  // left to FROM_POINTS: no radiance, alpha 0

vec3 light_from_within(float passing)
{
    BodySurface s = body_surface();
#ifdef FROM_POINTS
    vec4 inside = vec4(0.0);
    bool open = texelFetch(open_pixels, ivec2(gl_FragCoord.xy), 0).x != 0u;
    int turns = open ? covered_share_of(entry_turns) : 0;  // samples that are not open keep what they have
    for (int lamp = 0; lamp < lamp_count; ++lamp) {
        for (int turn = 0; turn < turns; ++turn) {
            vec2 shift = random_units(uvec2(gl_FragCoord.xy), uint(turn) + part_number(), uint(lamp)).xy;
            inside.rgb += light_from_inside(lamp, s.position, s.normal, shift);
        }
    }
    inside.rgb /= float(max(turns, 1));
#else
    vec4 inside = light_from_maps(s);
    if (inside.w < seen_well) {
        is_open = true;
        if (imageAtomicExchange(open_pixels, ivec2(gl_FragCoord.xy), 1u) == 0u) {
            atomicAdd(open_count, 1u);
            uvec2 at = uvec2(gl_FragCoord.xy);
            atomicMin(open_low_x, at.x);
            atomicMin(open_low_y, at.y);
            atomicMax(open_high_x, at.x);
            atomicMax(open_high_y, at.y);
        }
    }
#endif
    return passing * inside.rgb;
}
#endif

void main()
{
    begin_lights();
    bool whole = find_covered_part();
    vec3 point = WITHIN(point_camera);
    ViewRay ray = surface_ray(whole, point);
    vec3 direction = normalize(ray.toward);
    float ray_distance = distance_on_ray(point, ray.start, direction);
    distance_and_share = vec2(whole ? ray_distance : -point.z * length(view_ray().toward), 1.0);
    ray_origin_steps = world_from_camera * ray.start;
    ray_direction_world = world_from_camera * direction;
    vec3 toward_eye = -ray_direction_world;

    vec3 outward = WITHIN(normal_world);
    // Both sides are shaded, each with the normal on the side of the eye.
    float squared = dot(outward, outward);
    vec3 normal = squared > 1e-30 ? outward * inversesqrt(squared) : toward_eye;
    normal = gl_FrontFacing ? normal : -normal;
    float facing_eye = dot(normal, toward_eye);

    vec3 around = ambient;  // radiance from all sides
#ifdef SKY_LIGHT
    // Exact for a sky and a ground that are each of one radiance.
    around += mix(sky_light.ground_radiance.xyz, sky_light.sky_radiance.xyz, 0.5 + 0.5 * normal.y);
#endif
    vec3 reflected = around;
    vec3 mirrored = vec3(0.0);
    for (int n = 0; n < DIRECTIONAL_LIGHTS; ++n) {
        Incident incident = incident_from_afar(n);
        incident.irradiance *= arriving(n, normal);
#ifdef CLOUD_SHADOWS
        incident.irradiance *= light_through_clouds(n, ray_origin_steps + ray_distance * ray_direction_world);
#endif
        add_light(incident, normal, toward_eye, facing_eye, reflected, mirrored);
    }
    for (int n = DIRECTIONAL_LIGHTS; n < light_count; ++n) {
        Incident incident = incident_from_point(n, ray_distance);
        incident.irradiance *= arriving(n, normal);
        add_light(incident, normal, toward_eye, facing_eye, reflected, mirrored);
    }
#ifdef TRANSLUCENT
    float passing = fresnel_transmittance(facing_of_seen(facing_eye, direction), medium.eta);
    vec3 picture = diffuse_factor();
    vec3 from_lamps = light_from_within(passing);
#if defined(CLOUD_SHADOWS) && DIRECTIONAL_LIGHTS == 1 && POINT_LIGHTS == 0
    // Maps hold what all lamps send in. Of one alone, the shadow where light leaves is that where it entered: clouds are
    // hundreds of metres wide.
    from_lamps *= light_through_clouds(0, ray_origin_steps + ray_distance * ray_direction_world);
#endif
    vec3 within = from_lamps + passing * diffuse_reflectance * around;
    vec3 shine = specular * mirrored + (1.0 - passing) * around;
    if (see_through != 0) {
        // Not bent at the surface; what it is bent to looks the same where the surroundings do on all sides.
        float chord = max(texelFetch(thickness, ivec2(gl_FragCoord.xy), 0).x, 0.0);
        within += passing * passing * unscattered_transmittance(sigma_unscattered, chord) * around;
    }
    radiance = is_open ? vec4(0.0) : vec4(picture * within + (highlight != 0 ? shine : vec3(0.0)), 1.0);
#else
    vec3 albedo = diffuse * diffuse_factor();
    vec3 shown = (constant_color != 0 ? albedo : albedo * reflected) + emission;
    radiance = vec4(shown + (highlight != 0 ? specular * mirrored : vec3(0.0)), 1.0);
#endif
}
#endif
