// Surfaces inside a volume, lit by the gradient of the data (Levoy 1988), with a soft hand where there is none.
// All vectors are in world space and of unit length.

struct Light {
    vec3 irradiance;  // linear Rec.709; of a point light at a distance of 1 step
    vec3 toward;      // directional: towards the light; point: its position relative to the ray's origin, in steps
    int is_point;
};
uniform Light lights[MAX_LIGHTS];
uniform int light_count;

struct Surface {
    float ambient, diffuse, specular, shininess;
    int blinn_phong;
    int two_sided;
    float soft_from, soft_to;  // gradient magnitude in data ranges per smallest voxel edge
};
uniform Surface surface[VOLUMES];

vec3 ray_direction_world;   // unit
vec3 ray_origin_steps;      // origin of this ray relative to the camera, in steps

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
    vec3 diffuse = vec3(s.ambient);
    vec3 highlight = vec3(0.0);
    for (int n = 0; n < light_count; ++n) {
        vec3 toward_light = lights[n].toward;
        vec3 irradiance = lights[n].irradiance;
        if (lights[n].is_point != 0) {
            vec3 way = toward_light - (ray_origin_steps + t * ray_direction_world);
            float squared = max(dot(way, way), 1e-12);
            toward_light = way * inversesqrt(squared);
            irradiance /= squared;
        }
        float cosine = dot(normal, toward_light);
        diffuse += irradiance * (s.diffuse * (s.two_sided != 0 ? abs(cosine) : max(cosine, 0.0)));
        if (cosine > 0.0 && s.specular > 0.0) {
            float aligned;
            if (s.blinn_phong != 0) {
                vec3 between = toward_light + toward_eye;
                float squared = dot(between, between);
                aligned = squared > 0.0 ? dot(normal, between) * inversesqrt(squared) : 0.0;
            } else {
                aligned = dot(2.0 * cosine * normal - toward_light, toward_eye);
            }
            if (aligned > 0.0) {
                highlight += irradiance * (s.specular * pow(aligned, s.shininess));
            }
        }
    }
    return mix(color, color * diffuse + highlight, weight);
}
