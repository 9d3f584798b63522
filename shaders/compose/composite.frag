#version 450 core
// From linear Rec.709 radiance to the display, the only place where exposure, tone curve and the sRGB curve happen.
#include "include/random.glsl"

layout(location = 0) out vec4 display;
uniform sampler2D picture;     // linear radiance
uniform vec2 pixels;           // size of what is drawn to
uniform float exposure;        // factor
uniform int tone_map;          // in the order of scene::ToneMap; scene::tone_mapped has the same curves
uniform int dither;

// A filmic shoulder after Hable (2010), "Uncharted 2: HDR Lighting", scaled so that 0 stays 0 and 11.2 becomes 1.
vec3 filmic_curve(vec3 x)
{
    return ((x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06)) - 0.02 / 0.3;
}

vec3 srgb_from_linear(vec3 c)
{
    c = clamp(c, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

void main()
{
    vec3 c = textureLod(picture, gl_FragCoord.xy / pixels, 0.0).xyz * exposure;
    if (tone_map == 1) {
        c = filmic_curve(max(c, vec3(0.0))) / filmic_curve(vec3(11.2));
    }
    c = srgb_from_linear(c);
    if (dither != 0) {
        // Triangular noise of one 8-bit step in all.
        uvec2 p = uvec2(gl_FragCoord.xy);
        float noise = random_unit(p, 0u, 1u) - random_unit(p, 0u, 2u);
        vec3 room = min(c, 1.0 - c) * 255.0;   // no noise on black and white, which need none
        c += noise * 0.5 / 255.0 * min(vec3(1.0), room);
    }
    display = vec4(c, 1.0);
}
