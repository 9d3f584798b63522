// Light that a layer of clouds scatters towards the eye, per scattering coefficient, with light of sky and ground. What is
// scattered more than once diffuses, by a fit to random paths (reference/clouds/cloud_lighting.h), or OCTAVES: as many octaves of
// Wrenninge 2013 and Hillaire 2016; HALVING: each halves the optical depth, so that one exponential serves them all.
// ARTISTIC: the look of Alaminos 2020, repaired; no phase function.
#include "sky/sky_light.glsl"

struct CloudOptics {
    float extinction;  // 1/m at density 1
    float albedo;
    vec3 lobes;        // forward g, backward g, share of the forward lobe
    float reduced;     // 1 - mean g
    vec3 octave;       // factors of strength, optical depth and asymmetry from each to the next
    float ambient;
    vec4 look;         // ARTISTIC: asymmetries towards and away from the sun, their mix, absorption per optical depth
    vec2 silver;       // ARTISTIC: intensity, exponent
    float powder_all;  // ARTISTIC: 1 darkens thin cloud from everywhere
};
uniform CloudOptics optics;

const float one_over_4pi = 0.0795774715;

float henyey_greenstein(float mu, float g)
{
    float k = max(1.0 + g * g - 2.0 * g * mu, 1e-4);
    return one_over_4pi * (1.0 - g * g) / (k * sqrt(k));
}

#ifdef ARTISTIC
float in_out_scatter;
float towards_sun;

void begin_cloud_light(float mu)
{
    float rim = mu > 0.0 ? optics.silver.x * exp(optics.silver.y * log(min(mu, 1.0))) : 0.0;
    in_out_scatter =
        mix(max(henyey_greenstein(mu, optics.look.x), rim), henyey_greenstein(mu, -optics.look.y), optics.look.z);
    float half_turn = clamp(0.5 + 0.5 * mu, 0.0, 1.0);
    towards_sun = optics.powder_all > 0.5 ? 0.0 : half_turn * half_turn;
}

vec3 cloud_light(vec3 sun, vec3 depths)
{
    float x = optics.look.w * depths.x;
    float powder = mix(2.0 * (1.0 - exp(-2.0 * x)), 1.0, towards_sun);
    return exp(-x) * powder * in_out_scatter * sun +
           optics.ambient * sky_light.sky_radiance.rgb;
}
#elif !defined(OCTAVES)
float single_phase;
float ahead_phase;
float around;

void begin_cloud_light(float mu)
{
    single_phase = mix(henyey_greenstein(mu, optics.lobes.y), henyey_greenstein(mu, optics.lobes.x), optics.lobes.z);
    ahead_phase = 0.77 * mix(henyey_greenstein(mu, 0.77 * optics.lobes.y), henyey_greenstein(mu, 0.77 * optics.lobes.x),
                             optics.lobes.z);
    around = one_over_4pi * (0.8 + 1.25 * max(sky_light.to_sun.y, 0.0));
}

// `sun`: its irradiance, but for the clouds; `depths`: optical depths towards the sun, up and down.
vec3 cloud_light(vec3 sun, vec3 depths)
{
    float whole_depth = depths.y + depths.z;
    float whole = optics.reduced * whole_depth;
    float down = optics.reduced * depths.z;
    float not_absorbed = 1.0 / (1.0 + (1.0 - optics.albedo) * whole_depth);
    float leak = (down + 1.7) / (optics.reduced * depths.x + down + 3.4);
    float again = whole / (whole + 0.35) * (ahead_phase * exp(-0.32 * depths.x) + around * leak);
    float above = (down + 1.1) / (whole + 2.2);
    vec3 ambient = above * sky_light.sky_radiance.rgb + (1.0 - above) / (1.0 + 0.25 * whole) * sky_light.ground_radiance.rgb;
    return optics.albedo * ((single_phase * exp(-depths.x) + optics.albedo * not_absorbed * again) * sun +
                            optics.ambient * not_absorbed * ambient);
}
#else
float octave_phase[OCTAVES];

void begin_cloud_light(float mu)
{
    float strength = 1.0;
    float turn = 1.0;
    for (int n = 0; n < OCTAVES; ++n) {
        octave_phase[n] = strength * mix(henyey_greenstein(mu, optics.lobes.y * turn),
                                         henyey_greenstein(mu, optics.lobes.x * turn), optics.lobes.z);
        strength *= optics.octave.x;
        turn *= optics.octave.z;
    }
}

// `sun`: its irradiance, but for the clouds; `depths`: optical depths towards the sun, up and down.
vec3 cloud_light(vec3 sun, vec3 depths)
{
    float scattered = 0.0;
#ifdef HALVING
    float passed = exp(-depths.x / float(1 << (OCTAVES - 1)));
    for (int n = OCTAVES - 1; n >= 0; --n) {
        scattered += octave_phase[n] * passed;
        passed *= passed;
    }
#else
    float thinner = 1.0;
    for (int n = 0; n < OCTAVES; ++n) {
        scattered += octave_phase[n] * exp(-thinner * depths.x);
        thinner *= optics.octave.y;
    }
#endif
    vec3 source = scattered * sun;
    // Half: each hemisphere is 2 pi of the isotropic phase function's 1 / (4 pi).
    source += optics.ambient * 0.5 *
              (exp(-depths.y) * sky_light.sky_radiance.rgb + exp(-depths.z) * sky_light.ground_radiance.rgb);
    return optics.albedo * source;
}
#endif
