// The light from inside at a visible point of a translucent body, out of the maps around it. Needs
// include/exit_maps.glsl; mm.

uniform sampler2DArray exit_depth;
uniform sampler2DArray radiosity;
uniform int exit_count;

// Below this, what maps say is too coarse: one of them sees the point, slantingly or past an edge.
const float seen_well = 0.02;

// Mean of R over the maps that see x_o, each filtered over 3 x 3 texels of this very surface; w: how well it is seen,
// at most 1. `facet` is the normal of the surface as it was drawn.
vec4 light_from_maps(vec3 x_o, vec3 n_o, vec3 facet)
{
    vec4 sum = vec4(0.0);
    ivec2 last = textureSize(exit_depth, 0).xy - 1;
    for (int n = 0; n < exit_count; ++n) {
        ExitCamera camera = exit_cameras[n];
        float cosine = min(dot(n_o, camera.back.xyz), dot(facet, camera.back.xyz));
        if (cosine < 0.08) {
            continue;  // texels are stretched too far
        }
        vec2 across = vec2(dot(camera.right.xyz, x_o) - camera.right.w, dot(camera.up.xyz, x_o) - camera.up.w);
        vec2 p = across / camera.size.xy;
        vec2 texel = floor(p);
        vec2 f = p - texel - 0.5;
        float depth = -dot(camera.back.xyz, x_o) - camera.back.w;
        // What the depth of a texel's centre is if the surface goes on flat.
        vec2 slope = vec2(dot(facet, camera.right.xyz), dot(facet, camera.up.xyz)) / dot(facet, camera.back.xyz);
        float steep = length(slope);
        // What curves by a texel over a texel is still the same surface.
        float most = max(camera.size.x, camera.size.y) * (0.75 + steep);
        vec3 wx = vec3(0.5 * (0.5 - f.x) * (0.5 - f.x), 0.75 - f.x * f.x, 0.5 * (0.5 + f.x) * (0.5 + f.x));
        vec3 wy = vec3(0.5 * (0.5 - f.y) * (0.5 - f.y), 0.75 - f.y * f.y, 0.5 * (0.5 + f.y) * (0.5 + f.y));
        vec4 seen = vec4(0.0);
        for (int tap = 0; tap < 9; ++tap) {
            ivec2 offset = ivec2(tap % 3, tap / 3) - 1;
            ivec3 at = ivec3(clamp(ivec2(texel) + offset, ivec2(0), last), n);
            float stored = texelFetch(exit_depth, at, 0).x;
            float expected = depth + dot(slope, (vec2(offset) - f) * camera.size.xy);
            if (stored < 1.0 && abs(stored * camera.size.z - expected) < most) {
                seen += wx[offset.x + 1] * wy[offset.y + 1] * vec4(texelFetch(radiosity, at, 0).rgb, 1.0);
            }
        }
        // Slanting texels smear far over the surface; with neighbours on one side only there is no mean, only a guess.
        float facing = cosine - 0.08;
        sum += facing * facing * seen.w * seen;
    }
    return vec4(sum.rgb / max(sum.w, 1e-20), sum.w);
}
