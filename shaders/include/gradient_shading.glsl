// Surfaces inside a volume, lit by the gradient of the data (Levoy 1988), with a soft hand where there is none.
// All vectors are in world space and of unit length.

struct Light {
    vec3 irradiance;  // linear Rec.709; of a point light at a distance of 1 step
    vec3 toward;      // directional: unit, towards the light; point: its position relative to the camera, in steps
};
// Directional lights first, then point lights; the counts are compiled in, since a loop of unknown length around so few
// operations costs a software renderer more than the operations.
uniform Light lights[DIRECTIONAL_LIGHTS + POINT_LIGHTS + 1];

struct Surface {
    float ambient, diffuse, specular, shininess;
    int blinn_phong;
    int two_sided;
    float soft_from, soft_to;  // gradient magnitude in data ranges per smallest voxel edge
};
uniform Surface surface[VOLUMES];

vec3 ray_direction_world = vec3(0.0);  // unit
vec3 ray_origin_steps = vec3(0.0);     // origin of this ray relative to the camera, in steps

struct Reflected {
    vec3 diffuse;    // factor of the surface's colour
    vec3 highlight;
};

// Adds one light. Phong's mirrored light and Blinn's half vector both come from three cosines, without a branch.
void reflect_light(Surface s, vec3 toward_light, vec3 irradiance, vec3 normal, vec3 toward_eye, float facing_eye,
                   inout Reflected reflected)
{
    float cosine = dot(normal, toward_light);
    float between = dot(toward_light, toward_eye);
    reflected.diffuse += irradiance * (s.diffuse * (s.two_sided != 0 ? abs(cosine) : max(cosine, 0.0)));
    float aligned = s.blinn_phong != 0 ? (cosine + facing_eye) * inversesqrt(max(2.0 + 2.0 * between, 1e-12))
                                       : 2.0 * cosine * facing_eye - between;
    // 0 to a power is left to no driver: the logarithm's argument is kept positive, and the factor decides.
    float shine = cosine > 0.0 && aligned > 0.0 ? exp2(s.shininess * log2(max(aligned, 1e-20))) : 0.0;
    reflected.highlight += irradiance * (s.specular * shine);
}

// Light reflected towards the eye by colour `color` (the unlit source) at parameter t.
vec3 lit_source(int m, vec3 color, float t)
{
    Surface s = surface[m];
    if (s.soft_from >= 1e30) {
        return color;  // an unlit volume beside lit ones
    }
    vec3 x = ray_volumes[m].origin + t * ray_volumes[m].direction;
    vec3 texel = textureLod(gradients[m], x, 0.0).xyz - gradient_zero[m];
    vec3 gradient = world_from_gradient[m] * texel;
    float magnitude = length(gradient);
    float weight = s.soft_to > s.soft_from ? smoothstep(s.soft_from, s.soft_to, magnitude)
                                           : (magnitude >= s.soft_from ? 1.0 : 0.0);
    if (!(magnitude > 0.0) || weight == 0.0) {
        return color;
    }
    vec3 normal = -gradient / magnitude;
    vec3 toward_eye = -ray_direction_world;
    if (s.two_sided != 0 && dot(normal, toward_eye) < 0.0) {
        normal = -normal;
    }
    float facing_eye = dot(normal, toward_eye);
    Reflected reflected = Reflected(vec3(s.ambient), vec3(0.0));
    for (int n = 0; n < DIRECTIONAL_LIGHTS; ++n) {
        reflect_light(s, lights[n].toward, lights[n].irradiance, normal, toward_eye, facing_eye, reflected);
    }
    for (int n = DIRECTIONAL_LIGHTS; n < DIRECTIONAL_LIGHTS + POINT_LIGHTS; ++n) {
        vec3 way = lights[n].toward - (ray_origin_steps + t * ray_direction_world);
        float squared = max(dot(way, way), 1e-12);
        reflect_light(s, way * inversesqrt(squared), lights[n].irradiance / squared, normal, toward_eye, facing_eye,
                      reflected);
    }
    return mix(color, color * reflected.diffuse + reflected.highlight, weight);
}
