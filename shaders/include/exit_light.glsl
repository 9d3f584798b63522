// The light from inside at a visible point of a translucent body, out of the maps around it. Needs
// include/body_surface.glsl and include/exit_maps.glsl; mm.

uniform sampler2DArray exit_depth;
uniform sampler2DArray radiosity;

// Below this, what maps say is too coarse: one of them sees the point, slantingly or past an edge.
const float seen_well = 0.02;

// Mean of R over the maps that see a point, each filtered over 3 x 3 texels of this very surface; w: how well it is seen,
// at most 1.
vec4 light_from_maps(BodySurface s)
{
    vec4 sum = vec4(0.0);
    ivec2 last = textureSize(exit_depth, 0).xy - 1;
    for (int n = 0; n < exit_count; ++n) {
        ExitCamera camera = exit_cameras[n];
        float cosine = exit_cosine(camera, s.normal, s.facet);
        if (cosine < least_cosine) {
            continue;
        }
        vec2 p = exit_place(camera, s.position);
        vec2 texel = floor(p);
        vec2 f = p - texel - 0.5;
        float depth = -dot(camera.back.xyz, s.position) - camera.back.w;
        // What the depth of a texel's centre is if the surface goes on flat.
        vec2 slope = vec2(dot(s.facet, camera.right.xyz), dot(s.facet, camera.up.xyz)) / dot(s.facet, camera.back.xyz);
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
        float facing = cosine - least_cosine;
        sum += facing * facing * seen.w * seen;
    }
    return vec4(sum.rgb / max(sum.w, 1e-20), sum.w);
}
