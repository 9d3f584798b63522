#version 450 core
// A whole picture of clouds from the sixteenth of its pixels that was marched now and from the last picture, which is
// taken from where each cloud was then and held to what is seen around now: radiance and transmittance together, since
// either alone leaves ghosts. Where it saw something else, or nothing, the pixel is left to be marched: its depth is 1.
#include "clouds/cloud_history.glsl"
#include "include/view_ray.glsl"

layout(location = 0) out vec4 clouds;
layout(location = 1) out float mean_distance;

uniform sampler2D fresh_radiance;
uniform sampler2D fresh_distance;
uniform sampler2D fresh_mean;
uniform sampler2D fresh_spread;
uniform sampler2D fresh_mean_distance;
uniform sampler2D last_radiance;
uniform sampler2D last_distance;
uniform ivec2 pixel_offset;         // which pixel of each four by four was marched
uniform mat3 world_from_camera;
uniform mat3 last_camera_from_world;
uniform vec2 last_half_view;
uniform vec3 moved;                 // from the last eye to this one, and against the wind, m
uniform float kept_spread;          // spreads around the mean that history may keep; 0: nothing has moved, all of it

const float far_away = 1e6;

// Catmull-Rom in five bilinear taps: repeated bilinear lookups would blur.
vec4 sharp_history(vec2 uv)
{
    vec2 size = vec2(textureSize(last_radiance, 0));
    vec2 at = uv * size;
    vec2 middle = floor(at - 0.5) + 0.5;
    vec2 f = at - middle;
    vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f));
    vec2 w1 = 1.0 + f * f * (-2.5 + 1.5 * f);
    vec2 w2 = f * (0.5 + f * (2.0 - 1.5 * f));
    vec2 w3 = f * f * (-0.5 + 0.5 * f);
    vec2 w12 = w1 + w2;
    vec2 t0 = (middle - 1.0) / size;
    vec2 t3 = (middle + 2.0) / size;
    vec2 t12 = (middle + w2 / w12) / size;
    vec4 sum = textureLod(last_radiance, vec2(t12.x, t0.y), 0.0) * w12.x * w0.y +
               textureLod(last_radiance, vec2(t0.x, t12.y), 0.0) * w0.x * w12.y +
               textureLod(last_radiance, t12, 0.0) * w12.x * w12.y +
               textureLod(last_radiance, vec2(t3.x, t12.y), 0.0) * w3.x * w12.y +
               textureLod(last_radiance, vec2(t12.x, t3.y), 0.0) * w12.x * w3.y;
    float weights = w12.x * w0.y + w0.x * w12.y + w12.x * w12.y + w3.x * w12.y + w12.x * w3.y;
    sum /= weights;
    return vec4(max(sum.rgb, vec3(0.0)), clamp(sum.a, 0.0, 1.0));
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 cell = pixel / 4;
    vec4 fresh = texelFetch(fresh_radiance, cell, 0);
    float fresh_at = texelFetch(fresh_distance, cell, 0).x;
    bool is_fresh = all(equal(pixel - 4 * cell, pixel_offset));

    // Between the marched pixels, whose places within their cells are pixel_offset.
    vec2 uv_fresh = (gl_FragCoord.xy - vec2(pixel_offset) + 1.5) / 4.0 / vec2(textureSize(fresh_mean, 0));
    float distance = fresh_at > 0.0 ? fresh_at : texelFetch(fresh_mean_distance, cell, 0).x;

    ViewRay ray = view_ray();
    float stretch = length(ray.toward);
    float z = distance > 0.0 ? distance : far_away;
    vec3 then = last_camera_from_world * (world_from_camera * (ray.start + ray.toward / stretch * z) +
                                          (distance > 0.0 ? moved : vec3(0.0)));
    vec2 ndc = orthographic != 0 ? then.xy / last_half_view : then.xy / (max(-then.z, 1e-6) * last_half_view);
    vec2 uv = 0.5 * ndc + 0.5;
    if (kept_spread == 0.0) {
        uv = gl_FragCoord.xy / pixels;
    }
    ivec2 last_size = textureSize(last_distance, 0);  // another one while a viewer lowers its own
    // Not between pixels: halfway from a cloud to none (0) is no distance, and its pixels would all be marched.
    float last_at = texelFetch(last_distance, clamp(ivec2(uv * vec2(last_size)), ivec2(0), last_size - 1), 0).x;
    bool seen = all(greaterThanEqual(uv, vec2(0.0))) && all(lessThanEqual(uv, vec2(1.0))) &&
                (orthographic != 0 || then.z < 0.0);
    bool same = distance == 0.0 || last_at == 0.0 || max(last_at, distance) < 3.0 * min(last_at, distance);

    vec4 history = kept_spread == 0.0 ? texelFetch(last_radiance, pixel, 0) : sharp_history(uv);
    vec4 mean = textureLod(fresh_mean, uv_fresh, 0.0);
    if (kept_spread > 0.0) {
        vec4 around = kept_spread * textureLod(fresh_spread, uv_fresh, 0.0) + 0.05;
        vec4 apart = luma_chroma(history) - mean;
        vec4 share = abs(apart) / around;
        float most = max(max(share.x, share.y), max(share.z, share.w));
        history = from_luma_chroma(mean + apart / max(most, 1.0));
        same = same && most < 1.5;  // near enough to be held back, or else another thing
    }
    clouds = is_fresh ? fresh : vec4(max(history.rgb, vec3(0.0)), clamp(history.a, 0.0, 1.0));
    gl_FragDepth = is_fresh || kept_spread == 0.0 || (seen && same) ? 0.0 : 1.0;
    mean_distance = is_fresh ? fresh_at : kept_spread == 0.0 ? texelFetch(last_distance, pixel, 0).x : distance;
}
