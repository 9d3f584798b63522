// What the shadows of clouds take from the air before clouds, surfaces and sky: the grid of cloud_shafts.comp, looked up
// where each of them is. Needs view_ray.glsl, and opaque.glsl where there are surfaces.
#include "include/shafts.glsl"
uniform sampler3D shafts_missing;    // light missing up to a distance, per irradiance of the sun
uniform sampler3D shafts_share;      // the same as a share of all light that the air would have up to there
uniform vec3 shafts_sun;             // irradiance above the air
uniform vec2 shafts_from_pixels;     // texture coordinates per pixel
uniform float shafts_background;     // 1: the background has this air before it, 0: a sky without
uniform vec4 shafts_eye;             // vertical component of the camera's axes (right, up, back); altitude, m
uniform float shafts_planet_radius;  // m
#ifdef OPAQUE
uniform vec2 shafts_surface;         // metres = x times the distance of surfaces, plus y
#endif

// Of light `from` a way through the air, `air` of which is that air's. Under a low sun all but a hundredth of the air's
// light may be missing, and the difference of two tables would be noise of any colour, or none of one: what is left then
// is the right share of what is there.
vec3 missing_light(vec3 from, float air, float distance)
{
    float slices = float(textureSize(shafts_missing, 0).z);
    vec3 at = vec3(gl_FragCoord.xy * shafts_from_pixels, (shaft_coordinate(distance) * (slices - 1.0) + 0.5) / slices);
    return min(air * shafts_sun * textureLod(shafts_missing, at, 0.0).xyz, textureLod(shafts_share, at, 0.0).xyz * from);
}

// Where the ray ends: at a surface, on the ground or never.
float end_of_ray(float covered)
{
    ViewRay ray = view_ray();
    float altitude = max(shafts_eye.w + dot(shafts_eye.xyz, ray.start) * metres_per_step, 1.0);
    float climb = dot(shafts_eye.xyz, ray.toward) / length(ray.toward);
    float product = altitude * (2.0 * shafts_planet_radius + altitude);
    float half_sum = (shafts_planet_radius + altitude) * climb;
    float discriminant = half_sum * half_sum - product;
    float end = climb < 0.0 && discriminant >= 0.0 ? product / (sqrt(discriminant) - half_sum) : 1e30;
#ifdef OPAQUE
    float surface = texelFetch(opaque_distance, ivec2(gl_FragCoord.xy), 0).x;
    end = covered > 0.0 ? surface * shafts_surface.x + shafts_surface.y : end;
#endif
    return end;
}
