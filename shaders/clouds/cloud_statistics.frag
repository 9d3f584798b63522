#version 450 core
// Mean and spread of the clouds that were marched around each sixteenth pixel, over three by three of them, and how far
// they are: what older pictures of clouds are held against.
#include "clouds/cloud_history.glsl"

layout(location = 0) out vec4 mean;
layout(location = 1) out vec4 spread;
layout(location = 2) out float mean_distance;

uniform sampler2D fresh_radiance;
uniform sampler2D fresh_distance;

void main()
{
    ivec2 last = textureSize(fresh_radiance, 0) - 1;
    vec4 sum = vec4(0.0);
    vec4 squares = vec4(0.0);
    vec4 low = vec4(1e30);
    vec4 high = vec4(-1e30);
    vec2 distances = vec2(0.0);
    for (int n = 0; n < 9; ++n) {
        ivec2 at = clamp(ivec2(gl_FragCoord.xy) + ivec2(n % 3 - 1, n / 3 - 1), ivec2(0), last);
        vec4 clouds = luma_chroma(texelFetch(fresh_radiance, at, 0));
        float distance = texelFetch(fresh_distance, at, 0).x;
        sum += clouds;
        squares += clouds * clouds;
        low = min(low, clouds);
        high = max(high, clouds);
        distances += distance > 0.0 ? vec2(distance, 1.0) : vec2(0.0);
    }
    mean = sum / 9.0;
    vec4 deviation = sqrt(max(squares / 9.0 - mean * mean, vec4(0.0)));
    // No less than what is there: across an edge a third of the samples is 1.4 deviations from their mean.
    spread = max(1.25 * deviation, max(high - mean, mean - low));
    mean_distance = distances.y > 0.0 ? distances.x / distances.y : 0.0;
}
