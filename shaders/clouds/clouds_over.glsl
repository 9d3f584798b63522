// Layers of clouds before and behind what else is in the picture, by their mean distances: exact where their stretches
// along the ray do not overlap. CLOUDS: how many layers. SHAFTS: air and ground that their shadows cross; needs
// view_ray.glsl and CLOUD_SHADOWS.

uniform sampler2D cloud_radiance[CLOUDS];  // added radiance; alpha: transmittance
uniform sampler2D cloud_distance[CLOUDS];  // metres
uniform float metres_per_step;
#ifdef SHAFTS
#include "clouds/cloud_shafts.glsl"
#endif

// `matter`: radiance and transmittance of volumes, `matter_at` where they begin, metres; `behind`: the rest, alpha = how
// much of the background it covers, `end` from where it hides clouds. Returns a picture like `behind`.
vec4 with_clouds(vec4 matter, float matter_at, float end, vec4 behind)
{
#ifdef SHAFTS
    behind.rgb = without_missing_light(behind);
#endif
    vec4 parts[CLOUDS + 1];
    float at[CLOUDS + 1];
    parts[0] = matter;
    at[0] = matter_at;
    // Sorted in, far ones first.
    for (int n = 0; n < CLOUDS; ++n) {
        vec4 part = texelFetch(cloud_radiance[n], ivec2(gl_FragCoord.xy), 0);
        float distance = texelFetch(cloud_distance[n], ivec2(gl_FragCoord.xy), 0).x;
        part = distance < end ? part : vec4(0.0, 0.0, 0.0, 1.0);
#ifdef SHAFTS
        part.rgb -= missing_light(part.rgb, 1.0 - part.a, distance);
#endif
        int place = n + 1;
        for (int k = n; k >= 0; --k) {
            if (at[k] < distance) {
                parts[k + 1] = parts[k];
                at[k + 1] = at[k];
                place = k;
            }
        }
        parts[place] = part;
        at[place] = distance;
    }
    for (int n = 0; n <= CLOUDS; ++n) {
        behind = vec4(parts[n].rgb + parts[n].a * behind.rgb, 1.0 - parts[n].a * (1.0 - behind.a));
    }
    return behind;
}
