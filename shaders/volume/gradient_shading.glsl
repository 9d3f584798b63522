// Surfaces inside a volume, lit by the gradient of the data (Levoy 1988), with a soft hand where there is none.
// All vectors are in world space and of unit length.

struct Surface {
    float ambient, diffuse, specular, shininess;
    int blinn_phong;
    int two_sided;
    float soft_from;           // gradient magnitude in ranges of shading (scene/volume/volume.h) per smallest voxel edge
    float soft_inverse_width;
};
uniform Surface surface_uniforms[VOLUMES];
Surface surfaces[VOLUMES];

// TWO_SIDED, BLINN_PHONG: true or false for all volumes alike, which saves a choice at each of their segments.
#ifdef TWO_SIDED
bool is_two_sided(Surface s) { return TWO_SIDED; }
#else
bool is_two_sided(Surface s) { return s.two_sided != 0; }
#endif
#ifdef BLINN_PHONG
bool is_blinn_phong(Surface s) { return BLINN_PHONG; }
#else
bool is_blinn_phong(Surface s) { return s.blinn_phong != 0; }
#endif

struct Reflected {
    vec3 diffuse;    // factor of the surface's colour
    vec3 highlight;
};

// Adds one light. Phong's mirrored light and Blinn's half vector both come from three cosines. No branches: lanes that
// run side by side would take both sides anyway.
void reflect_light(Surface s, vec3 toward_light, vec3 irradiance, vec3 normal, vec3 toward_eye, float facing_eye,
                   inout Reflected reflected)
{
    float cosine = dot(normal, toward_light);
    float between = dot(toward_light, toward_eye);
    reflected.diffuse += irradiance * (s.diffuse * (is_two_sided(s) ? abs(cosine) : max(cosine, 0.0)));
#ifdef HIGHLIGHTS
    float aligned = is_blinn_phong(s) ? (cosine + facing_eye) * inversesqrt(max(2.0 + 2.0 * between, 1e-12))
                                       : 2.0 * cosine * facing_eye - between;
    // 0 to a power is left to no driver: the logarithm's argument is kept positive, and the factor decides.
    float shine = exp2(s.shininess * log2(max(aligned, 1e-20)));
    reflected.highlight += irradiance * (min(cosine, aligned) > 0.0 ? s.specular * shine : 0.0);
#endif
}

// Where the data have a surface, and how much of one.
struct SurfacePoint {
    vec3 normal;       // unit, on the side of the eye if two-sided
    float facing_eye;  // cosine
    float shaded;      // 0: no surface .. 1: all of one
};

#ifdef GRADIENTS_FROM_VOXELS
// Texels at three places, each moved along one axis.
vec3 texels_along_axes(int m, vec3 x, vec3 moved)
{
    return vec3(textureLod(voxels[m], vec3(moved.x, x.yz), 0.0).x,
                textureLod(voxels[m], vec3(x.x, moved.y, x.z), 0.0).x,
                textureLod(voxels[m], vec3(x.xy, moved.z), 0.0).x);
}

// Differences per voxel along each axis, in texels: what filtering `gradients` gives, since the mean of neighbouring
// differences is the difference of neighbouring means.
vec3 voxel_differences(int m, vec3 x)
{
    vec3 edge = 1.0 / constants[m].samples;
    x = clamp(x, 0.5 * edge, 1.0 - 0.5 * edge);
    vec3 above = texels_along_axes(m, x, x + edge);
    vec3 below = texels_along_axes(m, x, x - edge);
    vec3 apart = vec3(2.0);
#ifdef HOLES
    float here = textureLod(voxels[m], x, 0.0).x;
    for (int k = 0; k < 3; ++k) {
        if (is_absent(above[k])) {
            above[k] = here;
            apart[k] -= 1.0;
        }
        if (is_absent(below[k])) {
            below[k] = here;
            apart[k] -= 1.0;
        }
    }
#endif
    vec3 differences = (above - below) / max(apart, vec3(1.0));
    // Those of the outermost samples are one-sided, twice of what is found there.
    vec3 from_low = x * constants[m].samples - 0.5;
    vec3 from_high = constants[m].samples - 1.0 - from_low;
    vec3 near_low = clamp(1.0 - from_low, 0.0, 1.0);
    vec3 near_high = clamp(1.0 - from_high, 0.0, 1.0);
    if (any(greaterThan(near_low + near_high, vec3(0.0)))) {
        vec3 low = texels_along_axes(m, x, 1.5 * edge) - texels_along_axes(m, x, 0.5 * edge);
        vec3 high = texels_along_axes(m, x, 1.0 - 0.5 * edge) - texels_along_axes(m, x, 1.0 - 1.5 * edge);
        vec3 more = 0.5 * (near_low * low + near_high * high);
        differences += mix(more, vec3(0.0), greaterThan(abs(more), vec3(1e14)));  // beside absent samples there is none
    }
    return differences;
}
#endif

SurfacePoint surface_at(int m, vec3 x)
{
    Surface s = surfaces[m];
#ifdef GRADIENTS_FROM_VOXELS
    vec3 texel = voxel_differences(m, x);
#else
    vec3 texel = textureLod(gradients[m], x, 0.0).xyz - constants[m].gradient_zero;
#endif
    vec3 gradient = constants[m].world_from_gradient * texel;
    float squared_magnitude = dot(gradient, gradient);
    float inverse = inversesqrt(max(squared_magnitude, 1e-30));
    float magnitude = squared_magnitude * inverse;
    // A hard edge where both ends of the soft range are one; no gradient at all is never shaded.
    float rise = clamp((magnitude - s.soft_from) * s.soft_inverse_width, 0.0, 1.0);
    SurfacePoint point;
    point.shaded = squared_magnitude > 1e-30 ? rise * rise * (3.0 - 2.0 * rise) : 0.0;
    float facing_eye = inverse * dot(gradient, ray_direction_world);
    float turn = is_two_sided(s) && facing_eye < 0.0 ? inverse : -inverse;
    point.facing_eye = turn < 0.0 ? facing_eye : -facing_eye;
    point.normal = gradient * turn;
    return point;
}

// Light reflected towards the eye by matter at parameter t that covers `weight` of the pixel, with `color` its unlit
// source radiance times that weight.
vec3 reflected_source(int m, vec3 color, float weight, float t)
{
    Surface s = surfaces[m];
#if VOLUMES > 1
    if (s.soft_from >= 1e30) {
        return color;  // an unlit volume beside lit ones
    }
#endif
    SurfacePoint point = surface_at(m, ray_volumes[m].origin + t * ray_volumes[m].direction);
    vec3 toward_eye = -ray_direction_world;
    Reflected reflected = Reflected(vec3(s.ambient), vec3(0.0));
    for (int n = 0; n < DIRECTIONAL_LIGHTS; ++n) {
        vec3 irradiance = lights[n].irradiance;
#ifdef CLOUD_SHADOWS
        irradiance *= light_through_clouds(n, ray_origin_steps + t * ray_direction_world);
#endif
        reflect_light(s, lights[n].toward, irradiance, point.normal, toward_eye, point.facing_eye, reflected);
    }
    for (int n = DIRECTIONAL_LIGHTS; n < light_count; ++n) {
        Incident incident = incident_from_point(n, t);
        reflect_light(s, incident.toward, incident.irradiance, point.normal, toward_eye, point.facing_eye, reflected);
    }
    return mix(color, color * reflected.diffuse + weight * reflected.highlight, point.shaded);
}
