// What the shadows of clouds take from the air before clouds, surfaces and sky, and from the ground that belongs to the
// sky: the grid of cloud_shafts.comp, looked up where each of them is. Needs view_ray.glsl, cloud_shadow.glsl, and
// opaque.glsl where there are surfaces.
#include "clouds/shafts.glsl"
uniform sampler3D shafts_missing;    // light missing up to a distance, per irradiance of the sun
uniform sampler3D shafts_share;      // the same as a share of all light that the air would have up to there
uniform sampler3D shafts_ground;     // the sun's light from ground at a distance, were it there, per irradiance of the sun
uniform vec3 shafts_sun;             // irradiance above the air
uniform vec2 shafts_from_pixels;     // texture coordinates per pixel
uniform mat3 shafts_axes;            // the camera's right, up and back
uniform float shafts_altitude;       // of the eye, m
uniform float shafts_planet_radius;  // m
uniform float shafts_skipped;        // where rays start, m from the camera's own eye
#ifdef OPAQUE
uniform float shafts_surface;        // metres per unit of the distance of surfaces, which begins there
#endif

// Texture coordinate of a pixel's ray at a distance.
vec3 shafts_place(float distance)
{
    float slices = float(textureSize(shafts_missing, 0).z);
    return vec3(gl_FragCoord.xy * shafts_from_pixels, (shaft_coordinate(distance) * (slices - 1.0) + 0.5) / slices);
}

// Of light `from` a way through the air, `air` of which is that air's. Under a low sun all but a hundredth of the air's
// light may be missing, and the difference of two tables would be noise of any colour, or none of one: what is left then
// is the right share of what is there.
vec3 missing_light(vec3 from, float air, float distance)
{
    vec3 at = shafts_place(distance);
    return min(air * shafts_sun * textureLod(shafts_missing, at, 0.0).xyz, textureLod(shafts_share, at, 0.0).xyz * from);
}

// Distance to the ground, 1e30: the ray misses it.
float distance_to_sky_ground(ViewRay ray)
{
    float altitude = max(shafts_altitude + (shafts_axes * ray.start).y * metres_per_step, 1.0);
    float climb = (shafts_axes * ray.toward).y / length(ray.toward);
    float product = altitude * (2.0 * shafts_planet_radius + altitude);
    float half_sum = (shafts_planet_radius + altitude) * climb;
    float discriminant = half_sum * half_sum - product;
    return climb < 0.0 && discriminant >= 0.0 ? product / (sqrt(discriminant) - half_sum) : 1e30;
}

// Light that the ground of the sky lacks in the shadows of clouds, as far as there are any.
vec3 missing_on_ground(ViewRay ray, float distance)
{
    vec3 from_eye =
        shafts_axes * (ray.start * metres_per_step + (distance - shafts_skipped) / length(ray.toward) * ray.toward);
    float reach = shaft_distance(1.0);
    float shaded = 1.0 - light_on_ground_below_clouds(vec3(from_eye.x, 0.0, from_eye.z));
    shaded *= clamp(10.0 * (1.0 - distance / reach), 0.0, 1.0);
    return shaded * shafts_sun * textureLod(shafts_ground, shafts_place(distance), 0.0).xyz;
}

// `behind`: all that stands behind the clouds, alpha = the share of it that is surfaces.
vec3 without_missing_light(vec4 behind)
{
    ViewRay ray = view_ray();
    float end = distance_to_sky_ground(ray);
    vec3 light = behind.rgb;
#ifdef OPAQUE
    float surface = texelFetch(opaque_distance, ivec2(gl_FragCoord.xy), 0).x;
    end = behind.a > 0.0 ? surface * shafts_surface + shafts_skipped : end;
#endif
    if (behind.a == 0.0 && end < 1e29) {
        light -= min(missing_on_ground(ray, end), light);
    }
    return light - missing_light(light, 1.0, end);
}
