// One layer of the surfaces that the opaque pass found: where rays end, and what stands before the background. OPAQUE:
// there are some.

#ifdef OPAQUE
uniform sampler2D opaque_radiance;  // linear; alpha = 1 on a surface
uniform sampler2D opaque_distance;  // x: along the pixel's ray, in units of that pass, huge where there is nothing; y: share
uniform float steps_per_unit;

// Of the pixel's area: 1 but at edges, which are drawn share after share.
float opaque_share() { return texelFetch(opaque_distance, ivec2(gl_FragCoord.xy), 0).y; }

float opaque_steps() { return texelFetch(opaque_distance, ivec2(gl_FragCoord.xy), 0).x * steps_per_unit; }

vec4 opaque_surface()
{
    bool any = texelFetch(opaque_distance, ivec2(gl_FragCoord.xy), 0).x < 5e29;
    return any ? texelFetch(opaque_radiance, ivec2(gl_FragCoord.xy), 0) : vec4(0.0);
}

vec4 opaque_over(vec3 background)
{
    vec4 surface = opaque_surface();
    return vec4(surface.xyz + (1.0 - surface.w) * background, surface.w);
}

#define SHARE_OF(picture) (opaque_share() * (picture))
// Clouds were marched as far as the furthest share of a pixel: from where the other shares end they have none, metres.
#define CLOUDS_END(metres_per_step) (opaque_share() < 1.0 ? opaque_steps() * (metres_per_step) : 1e38)
#else
#define SHARE_OF(picture) (picture)
#define CLOUDS_END(metres_per_step) 1e38
#endif
