// Surfaces inside a volume, lit by the gradient of the data (Levoy 1988), with a soft hand where there is none.
// All vectors are in world space and of unit length.

struct Light {
    vec3 irradiance;  // over pi, linear Rec.709; with a position: at a distance of 1 step
    vec3 toward;      // unit, towards the light; with a position: the position relative to the camera, in steps
    vec3 axis;        // spot: unit, against the beam; 0 for a point light
    vec2 cone;        // spot: cosine at the edge, 1 / (cosine where the edge begins to fade - that)
};
// Directional lights first, then point lights; the counts are compiled in, since a loop of unknown length around so few
// operations costs a software renderer more than the operations.
uniform Light lights[DIRECTIONAL_LIGHTS + POINT_LIGHTS + 1];

struct Surface {
    float ambient, diffuse, specular, shininess;
    int blinn_phong;
    int two_sided;
    float soft_from;           // gradient magnitude in data ranges per smallest voxel edge
    float soft_inverse_width;
};
uniform Surface surface[VOLUMES];

vec3 ray_direction_world = vec3(0.0);  // unit
vec3 ray_origin_steps = vec3(0.0);     // origin of this ray relative to the camera, in steps

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
    reflected.diffuse += irradiance * (s.diffuse * (s.two_sided != 0 ? abs(cosine) : max(cosine, 0.0)));
#ifdef HIGHLIGHTS
    float aligned = s.blinn_phong != 0 ? (cosine + facing_eye) * inversesqrt(max(2.0 + 2.0 * between, 1e-12))
                                       : 2.0 * cosine * facing_eye - between;
    // 0 to a power is left to no driver: the logarithm's argument is kept positive, and the factor decides.
    float shine = exp2(s.shininess * log2(max(aligned, 1e-20)));
    reflected.highlight += irradiance * (min(cosine, aligned) > 0.0 ? s.specular * shine : 0.0);
#endif
}

// Light reflected towards the eye by matter at parameter t that covers `weight` of the pixel, with `color` its unlit
// source radiance times that weight.
vec3 lit_source(int m, vec3 color, float weight, float t)
{
    Surface s = surface[m];
#if VOLUMES > 1
    if (s.soft_from >= 1e30) {
        return color;  // an unlit volume beside lit ones
    }
#endif
    vec3 x = ray_volumes[m].origin + t * ray_volumes[m].direction;
    vec3 texel = textureLod(gradients[m], x, 0.0).xyz - gradient_zero[m];
    vec3 gradient = world_from_gradient[m] * texel;
    float squared_magnitude = dot(gradient, gradient);
    float inverse = inversesqrt(max(squared_magnitude, 1e-30));
    float magnitude = squared_magnitude * inverse;
    // A hard edge where both ends of the soft range are one; no gradient at all is never shaded.
    float rise = clamp((magnitude - s.soft_from) * s.soft_inverse_width, 0.0, 1.0);
    float shaded = squared_magnitude > 1e-30 ? rise * rise * (3.0 - 2.0 * rise) : 0.0;
    vec3 toward_eye = -ray_direction_world;
    float facing_eye = -inverse * dot(gradient, toward_eye);
    float turn = s.two_sided != 0 && facing_eye < 0.0 ? inverse : -inverse;
    facing_eye = turn < 0.0 ? facing_eye : -facing_eye;
    vec3 normal = gradient * turn;
    Reflected reflected = Reflected(vec3(s.ambient), vec3(0.0));
    for (int n = 0; n < DIRECTIONAL_LIGHTS; ++n) {
        reflect_light(s, lights[n].toward, lights[n].irradiance, normal, toward_eye, facing_eye, reflected);
    }
    for (int n = DIRECTIONAL_LIGHTS; n < DIRECTIONAL_LIGHTS + POINT_LIGHTS; ++n) {
        vec3 way = lights[n].toward - (ray_origin_steps + t * ray_direction_world);
        float squared = max(dot(way, way), 1e-12);
        vec3 toward = way * inversesqrt(squared);
        float inside = clamp((dot(toward, lights[n].axis) - lights[n].cone.x) * lights[n].cone.y, 0.0, 1.0);
        float share = inside * inside * (3.0 - 2.0 * inside) / squared;
        reflect_light(s, toward, lights[n].irradiance * share, normal, toward_eye, facing_eye, reflected);
    }
    return mix(color, color * reflected.diffuse + weight * reflected.highlight, shaded);
}
