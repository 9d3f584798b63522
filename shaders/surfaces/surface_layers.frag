#version 450 core
// What the samples of a pixel show, as shares of its area: the nearest surface, one further away, nothing. SAMPLES: how
// many there are.

uniform sampler2DMS radiance_samples;  // alpha 1 on a surface
uniform sampler2DMS distance_samples;  // 1e30: none
uniform vec2 pixel_size;               // across, at distance 0 and what it grows by per unit

layout(location = 0) out vec4 near_radiance;
layout(location = 1) out vec2 near_distance;  // and share, as those below
layout(location = 2) out vec4 far_radiance;
layout(location = 3) out vec2 far_distance;
layout(location = 4) out vec2 nothing;
layout(location = 5) out float farthest;

const float none = 1e30;

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    float distances[SAMPLES];
    float nearest = none;
    float last = 0.0;
    int covered = 0;
    for (int n = 0; n < SAMPLES; ++n) {
        distances[n] = texelFetch(distance_samples, at, n).x;
        if (distances[n] < 0.5 * none) {
            nearest = min(nearest, distances[n]);
            last = max(last, distances[n]);
            ++covered;
        }
    }
    // Samples fall apart at the widest gap, if it is wider than a surface that slopes by 63 degrees leaves; to take one
    // surface for two costs time and no truth.
    float border = last;
    float widest = 2.0 * (pixel_size.x + pixel_size.y * nearest);
    if (covered > 1 && last - nearest > widest) {
        for (int n = 0; n < SAMPLES; ++n) {
            float next = none;
            for (int k = 0; k < SAMPLES; ++k) {
                next = distances[k] > distances[n] ? min(next, distances[k]) : next;
            }
            if (next < 0.5 * none && next - distances[n] > widest) {
                widest = next - distances[n];
                border = distances[n];
            }
        }
    }
    // Differences are added to a first one, so that the mean of equals is their value to the last bit.
    vec4 radiance[2] = vec4[2](vec4(0.0), vec4(0.0));
    float distance[2] = float[2](none, none);
    vec4 first[2] = radiance;
    float counts[2] = float[2](0.0, 0.0);
    vec4 sums[2] = radiance;
    float way[2] = float[2](0.0, 0.0);
    for (int n = 0; n < SAMPLES; ++n) {
        if (distances[n] < 0.5 * none) {
            vec4 value = texelFetch(radiance_samples, at, n);
            int side = distances[n] <= border ? 0 : 1;
            if (counts[side] == 0.0) {
                first[side] = value;
                distance[side] = distances[n];
            }
            sums[side] += value - first[side];
            way[side] += distances[n] - distance[side];
            counts[side] += 1.0;
        }
    }
    for (int side = 0; side < 2; ++side) {
        radiance[side] = first[side] + sums[side] / max(counts[side], 1.0);
        distance[side] += way[side] / max(counts[side], 1.0);
    }
    float missing = float(SAMPLES - covered) / float(SAMPLES);
    near_radiance = radiance[0];
    near_distance = vec2(distance[0], covered == 0 ? 1.0 : counts[0] / float(SAMPLES));
    bool two = counts[1] > 0.0;
    far_radiance = radiance[1];
    far_distance = vec2(distance[1], two ? counts[1] / float(SAMPLES) : covered == 0 ? 0.0 : missing);
    nothing = vec2(none, two ? missing : 0.0);
    farthest = covered < SAMPLES ? none : two ? distance[1] : distance[0];
}
