// What sun and sky send into the scene, for matter that is lit by both. Linear Rec.709; world space, y up.
#ifndef SKY_LIGHT_BINDING
#define SKY_LIGHT_BINDING 7
#endif
#ifndef SKY_LIGHT_ACCESS
#define SKY_LIGHT_ACCESS readonly
#endif

layout(std430, binding = SKY_LIGHT_BINDING) SKY_LIGHT_ACCESS buffer SkyLight {
    vec4 to_sun;          // xyz: unit, from the scene to the middle of the sun's disc
    vec4 sun_irradiance;  // rgb: of a plane that faces the sun, behind the air that its light has crossed
    vec4 sky_radiance;    // rgb: mean over the upper half of all directions, weighted evenly, without the sun's disc
    vec4 ground_radiance; // rgb: mean over the lower half
} sky_light;
