// Whether other surfaces stand in a lamp's light, from what each lamp sees of all meshes. Shadow space: the world's axes,
// counted from the middle of all meshes in units of about their size.

struct ShadowFace {
    vec4 right, up;  // w: texels per unit across the view
    vec4 toward;     // w: layer
    vec4 first;      // xy: texel of the coordinate 0; z: depth of 0; w: depth of 1 less that
};
struct ShadowLamp {
    vec4 eye;  // w: 0 parallel, 1 one view, 2 six views, -1 casts no shadow
    ShadowFace faces[6];
};
layout(std430, binding = 6) readonly buffer ShadowLamps { ShadowLamp shadow_lamps[]; };
uniform sampler2DArray shadow_depth;

// Share of a lamp's light that arrives, filtered over 3 x 3 texels. Each texel is compared with the depth that the plane
// of the surface has at its centre, so that flat surfaces need no bias however steep the light; `facet` is the normal of
// that plane.
float light_arriving(int lamp, vec3 p, vec3 facet)
{
    float kind = shadow_lamps[lamp].eye.w;
    if (kind < 0.0) {
        return 1.0;
    }
    bool parallel = kind == 0.0;
    vec3 v = p - shadow_lamps[lamp].eye.xyz;
    int face = 0;
    if (kind == 2.0) {
        vec3 a = abs(v);
        face = a.x >= a.y && a.x >= a.z ? (v.x > 0.0 ? 0 : 1) : a.y >= a.z ? (v.y > 0.0 ? 2 : 3) : (v.z > 0.0 ? 4 : 5);
    }
    ShadowFace f = shadow_lamps[lamp].faces[face];
    float depth = -dot(f.toward.xyz, v);
    float unit = parallel ? 1.0 : max(depth, 1e-20);  // length of one unit across the view
    vec2 texel_size = unit / vec2(f.right.w, f.up.w);
    vec2 t = vec2(dot(f.right.xyz, v), dot(f.up.xyz, v)) / texel_size + f.first.xy;
    vec2 texel = floor(t);
    vec2 offset = t - texel - 0.5;
    // How much deeper the plane lies per unit across; seen edge-on it says nothing any more.
    float facing = parallel ? dot(facet, f.toward.xyz) : -dot(facet, v) / unit;
    vec2 slope = vec2(dot(facet, f.right.xyz), dot(facet, f.up.xyz)) / (max(abs(facing), 0.1) * sign(facing + 1e-20));
    float steep = min(length(slope), 8.0);
    // What curves by a part of a texel over a texel is still the same surface.
    float slack = max(texel_size.x, texel_size.y) * (0.3 + 0.4 * steep);
    vec3 wx = vec3(0.5 * (0.5 - offset.x) * (0.5 - offset.x), 0.75 - offset.x * offset.x,
                   0.5 * (0.5 + offset.x) * (0.5 + offset.x));
    vec3 wy = vec3(0.5 * (0.5 - offset.y) * (0.5 - offset.y), 0.75 - offset.y * offset.y,
                   0.5 * (0.5 + offset.y) * (0.5 + offset.y));
    ivec2 last = textureSize(shadow_depth, 0).xy - 1;
    float arriving = 0.0;
    for (int tap = 0; tap < 9; ++tap) {
        ivec2 step = ivec2(tap % 3, tap / 3) - 1;
        ivec2 at = ivec2(texel) + step;
        float stored = texelFetch(shadow_depth, ivec3(clamp(at, ivec2(0), last), int(f.toward.w)), 0).x;
        float near = f.first.z, range = f.first.w;
        float seen = parallel ? near + stored * range : near * (near + range) / max(near + range - stored * range, 1e-20);
        float expected = depth + dot(slope, (vec2(step) - offset) * texel_size);
        bool lit = stored == 1.0 || seen >= expected - slack || at != clamp(at, ivec2(0), last);
        arriving += wx[step.x + 1] * wy[step.y + 1] * (lit ? 1.0 : 0.0);
    }
    return arriving;
}
