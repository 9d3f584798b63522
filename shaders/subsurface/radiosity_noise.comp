#version 450 core
// How noisy the light at a translucent surface still is where a picture looks it up: the standard error of the mean over
// 3 x 3 texels, weighted as subsurface/exit_light.glsl weights them, as a share of that mean. Over one texel of some words
// of 32, always the same.
#include "subsurface/exit_texels.glsl"

layout(local_size_x = 64) in;

layout(binding = 0, rgba32f) readonly uniform image2DArray radiosity;
layout(binding = 1, r32f) readonly uniform image2DArray variance;
uniform uint stride;  // from one word to the next
uniform float least;  // values below this are compared with it
layout(std430, binding = 4) writeonly buffer Sums { vec4 sums[]; };  // of squared shares, of values; texels

shared vec4 parts[64];

void main()
{
    uint word = gl_GlobalInvocationID.x * stride;
    uint middles = word < word_count ? middle_of_read(word) : 0u;
    vec4 own = vec4(0.0);
    if (middles != 0u) {
        // The next one from any bit on, around.
        uint from = word * 0x9E3779B9u >> 27;
        uint behind = middles >> from << from;
        uint bit = uint(findLSB(behind != 0u ? behind : middles));
        ivec3 at = texel_at(first_address(word) + bit);
        ivec2 size = ivec2(edge);
        float sum = 0.0, squares = 0.0, weights = 0.0;
        for (int n = 0; n < 9; ++n) {
            ivec2 offset = ivec2(n % 3, n / 3) - 1;
            ivec3 texel = ivec3(clamp(at.xy + offset, ivec2(0), size - 1), at.z);
            // Quadratic B-splines, averaged over where a pixel falls within its texel.
            float weight = (offset.x == 0 ? 2.0 / 3.0 : 1.0 / 6.0) * (offset.y == 0 ? 2.0 / 3.0 : 1.0 / 6.0);
            vec4 value = imageLoad(radiosity, texel);
            if (value.w < 1e29) {
                sum += weight * dot(value.rgb, vec3(1.0 / 3.0));
                squares += weight * weight * imageLoad(variance, texel).x;
                weights += weight;
            }
        }
        float mean = sum / weights;
        float mean_variance = squares / (weights * weights);
        own = vec4(mean_variance / max(mean * mean, max(least * least, 1e-30)), mean, 1.0, 0.0);
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
