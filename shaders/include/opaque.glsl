// The surfaces that the opaque pass found: where rays end, and what stands before the background.

uniform sampler2D opaque_radiance;  // linear, times coverage; alpha = coverage
uniform sampler2D opaque_distance;  // along the pixel's ray, in units of that pass; huge where there is nothing
uniform float steps_per_unit;

float opaque_steps() { return texelFetch(opaque_distance, ivec2(gl_FragCoord.xy), 0).x * steps_per_unit; }

vec4 opaque_over(vec3 background)
{
    vec4 surface = texelFetch(opaque_radiance, ivec2(gl_FragCoord.xy), 0);
    return vec4(surface.xyz + (1.0 - surface.w) * background, surface.w);
}
