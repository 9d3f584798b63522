#version 450 core
// What sun and sky send to the scene's origin.
layout(local_size_x = 1) in;
#define SKY_LIGHT_ACCESS writeonly
#include "sky/sky_light.glsl"
#include "sky/sky_air.glsl"
#include "sky/sky_tables.glsl"

uniform vec3 to_sun;
uniform vec3 irradiance;      // above the air
uniform vec3 irradiance_behind_air;

void main()
{
    float x = irradiance_coordinate(to_sun.y);
    vec3 planar = irradiance * look_up(irradiance_table, vec2(x, 0.0));
    vec3 scalar = irradiance * look_up(irradiance_table, vec2(x, 1.0));
    vec3 ground = air.ground_albedo * 0.318309886 * (max(to_sun.y, 0.0) * irradiance_behind_air + planar);
    sky_light.to_sun = vec4(to_sun, 0.0);
    sky_light.sun_irradiance = vec4(irradiance_behind_air, 0.0);
    sky_light.sky_radiance = vec4(scalar * 0.159154943, 0.0);
    sky_light.ground_radiance = vec4(ground, 0.0);
}
