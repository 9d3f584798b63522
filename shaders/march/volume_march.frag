#version 450 core
// Emission and absorption of measured volumes along each pixel's ray, over the background.
// VOLUMES: how many. LIT: lights matter; REFLECT: for surfaces (gradient shading), SCATTER: for scattering media, SURFACES:
// for media that are also shaded as surfaces. GLOW: some volume shines by itself.
// OPAQUE: rays end at surfaces. SKY: a picture of surfaces and sky stands ready. CLOUDS, SHAFTS: see
// clouds/clouds_over.glsl.
// SAMPLE_AT_MIDPOINTS, LEAP, STOP_EARLY, COUNT: see march/march.glsl.

#include "include/random.glsl"
#include "march/optical_depth.glsl"
#include "include/ray_box.glsl"
#ifdef CLOUD_SHADOWS
#include "clouds/cloud_shadow.glsl"
#endif
#include "volume/volume.glsl"
#include "march/march.glsl"
#include "include/view_ray.glsl"
#include "surfaces/opaque.glsl"

#ifdef CLOUDS
#include "clouds/clouds_over.glsl"
#endif

layout(location = 0) out vec4 picture;  // linear radiance; alpha = 1 - transmittance
#ifdef COUNT
layout(location = 1) out vec2 counts;  // samples, queries of emptiness
#endif

uniform float near_steps;                // distance of the near plane along the view axis
// The camera's axes in texture space of each volume, per step; [3] is the eye.
uniform mat4 texture_from_camera[VOLUMES];
uniform vec3 clip_low[VOLUMES];
uniform vec3 clip_high[VOLUMES];
uniform float stop_transmittance;
uniform int jitter;                      // 0 off, 1 hashed, 2 blue noise
uniform sampler2D blue_noise;
#ifdef SKY
uniform sampler2D sky_picture;
#endif
uniform vec3 background_top;
uniform vec3 background_bottom;
#ifdef LIT
uniform mat3 world_from_camera;
#endif

float first_segment_length()
{
    if (jitter == 1) {
        return 1.0 - random_unit(uvec2(gl_FragCoord.xy), 0u, 0u);
    }
    if (jitter == 2) {
        return 1.0 - texelFetch(blue_noise, ivec2(gl_FragCoord.xy) % textureSize(blue_noise, 0), 0).x;
    }
    return 1.0;
}

void main()
{
#ifdef OPAQUE
    float share = opaque_share();
    if (share == 0.0) {
        discard;
    }
#endif
    ViewRay ray = view_ray();  // in steps
    vec3 start = ray.start;
    float stretch = length(ray.toward);
    vec3 direction = ray.toward / stretch;
#ifdef OPAQUE
    float t_surface = opaque_steps();
#endif

    March m = March(1e30, -1e30, first_segment_length(), stop_transmittance);
    for (int v = 0; v < VOLUMES; ++v) {
        Volume volume;
        volume.origin = (texture_from_camera[v] * vec4(start, 1.0)).xyz;
        volume.direction = mat3(texture_from_camera[v]) * direction;
        volume.low = clip_low[v];
        volume.high = clip_high[v];
        begin_ray(v, volume);
        vec2 stretch_of_ray = ray_box(volume.origin, volume.direction, volume.low, volume.high);
        ray_enter[v] = max(stretch_of_ray.x, near_steps * stretch);
        ray_leave[v] = stretch_of_ray.y;
#ifdef OPAQUE
        ray_leave[v] = min(ray_leave[v], t_surface);
#endif
        if (ray_leave[v] > ray_enter[v]) {
            m.t_in = min(m.t_in, ray_enter[v]);
            m.t_out = max(m.t_out, ray_leave[v]);
        }
    }
#ifdef LIT
    ray_direction_world = world_from_camera * direction;
    ray_origin_steps = world_from_camera * start;
    medium_begin();
#endif
    vec3 background = mix(background_bottom, background_top, gl_FragCoord.y / pixels.y);
#ifdef SKY
    vec4 behind = texelFetch(sky_picture, ivec2(gl_FragCoord.xy), 0);
#elif defined(OPAQUE)
    vec4 behind = opaque_over(background);
#else
    vec4 behind = vec4(background, 0.0);
#endif
    if (!(m.t_out > m.t_in)) {
#ifdef CLOUDS
        behind = with_clouds(vec4(0.0, 0.0, 0.0, 1.0), 0.0, CLOUDS_END(metres_per_step), behind);
#endif
        picture = SHARE_OF(behind);
#ifdef COUNT
        counts = vec2(0.0);
#endif
        return;
    }
    Marched marched = march(m);
#ifdef CLOUDS
    picture = with_clouds(vec4(marched.radiance, marched.transmittance), m.t_in * metres_per_step,
                          CLOUDS_END(metres_per_step), behind);
#else
    picture = vec4(marched.radiance + marched.transmittance * behind.xyz,
                   1.0 - marched.transmittance * (1.0 - behind.w));
#endif
    picture = SHARE_OF(picture);
#ifdef COUNT
    counts = vec2(marched.samples, marched.queries);
#endif
}
