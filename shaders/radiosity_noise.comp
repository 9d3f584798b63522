#version 450 core
// How noisy the light at a translucent surface still is where a picture looks it up: the standard error of the mean over
// 3 x 3 texels, weighted as include/exit_light.glsl weights them, as a share of that mean.
#include "include/exit_texels.glsl"

layout(local_size_x = 64) in;

layout(binding = 0, rgba32f) readonly uniform image2DArray radiosity;
uniform sampler2DArray exit_depth;
uniform float least;  // values below this are compared with it
layout(std430, binding = 4) writeonly buffer Sums { vec4 sums[]; };  // of squared shares, of values; texels

shared vec4 parts[64];

void main()
{
    uint id = gl_GlobalInvocationID.x;
    vec4 own = vec4(0.0);
    ivec3 at = texel_at(min(id, texel_count - 1u));
    if (id < texel_count && is_middle_of_read(at)) {
        ivec2 size = ivec2(edge);
        float sum = 0.0, squares = 0.0, weights = 0.0;
        for (int n = 0; n < 9; ++n) {
            ivec2 offset = ivec2(n % 3, n / 3) - 1;
            ivec3 texel = ivec3(clamp(at.xy + offset, ivec2(0), size - 1), at.z);
            // Quadratic B-splines, averaged over where a pixel falls within its texel.
            float weight = (offset.x == 0 ? 2.0 / 3.0 : 1.0 / 6.0) * (offset.y == 0 ? 2.0 / 3.0 : 1.0 / 6.0);
            if (texelFetch(exit_depth, texel, 0).x < 1.0) {
                vec4 value = imageLoad(radiosity, texel);
                sum += weight * dot(value.rgb, vec3(1.0 / 3.0));
                squares += weight * weight * value.w;
                weights += weight;
            }
        }
        float mean = sum / weights;
        float variance = squares / (weights * weights);
        own = vec4(variance / max(mean * mean, max(least * least, 1e-30)), mean, 1.0, 0.0);
    }
    uint n = gl_LocalInvocationIndex;
    parts[n] = own;
    for (uint step = 32u; step > 0u; step /= 2u) {
        barrier();
        if (n < step) {
            parts[n] += parts[n + step];
        }
    }
    if (n == 0u) {
        sums[gl_WorkGroupID.x] = parts[0];
    }
}
