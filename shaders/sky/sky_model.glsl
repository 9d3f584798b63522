// PREETHAM or LOOK, the models for comparison: the sky above the horizon as it is seen from the ground, for a sun of
// irradiance 1 above the air and without its disc. Needs sky_tables.glsl.
#ifdef PREETHAM
#include "sky/sky_preetham.glsl"
#endif
#ifdef LOOK
#include "sky/sky_look.glsl"
#endif

uniform float turbidity;
uniform vec3 look;  // strengths of air and haze, asymmetry of haze

// Before its scale, see sky_irradiance.comp. Below the horizon its colour goes on.
vec3 model_sky(vec3 direction, vec3 to_sun)
{
#ifdef PREETHAM
    // From the ground by day: a sun that has set stays on the horizon, and above a turbidity of 10 the fit is no sky.
    vec3 above = normalize(vec3(direction.x, max(direction.y, 1e-4), direction.z));
    vec3 sun = normalize(vec3(to_sun.x, max(to_sun.y, 0.0), to_sun.z) + vec3(0.0, 1e-6, 0.0));
    vec3 Yxy = preetham_Yxy(min(turbidity, 10.0), above.y, angle_between(sun, vec3(0.0, 1.0, 0.0)),
                            angle_between(above, sun));
    // kcd/m2 per unit of the sun's irradiance: the solar illuminance above the air is 127.5 klx (IES), which is 93.7
    // lm/W of 1361 W/m2.
    return max(rec709_from_Yxy(Yxy), 0.0) / 127.5;
#else
    return look_radiance(direction, to_sun, turbidity, look.x, look.y, look.z, 0.0);
#endif
}

// What brings it to the unit of the atmosphere; kept beside the light of the whole sky.
float model_scale(float sun_climb)
{
    vec2 size = vec2(textureSize(irradiance_table, 0));
    return textureLod(irradiance_table, table_texture_coordinate(vec2(irradiance_coordinate(sun_climb), 0.0), size), 0.0)
        .w;
}
