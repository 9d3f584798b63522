// The lights that shine, for matter that reflects or scatters them. All vectors are in world space.

struct Light {
    vec3 irradiance;  // over pi, linear Rec.709; with a position: at a distance of 1 step
    vec3 toward;      // unit, towards the light; with a position: the position relative to the camera, in steps
    vec3 axis;        // spot: unit, against the beam; 0 for a point light
    vec2 cone;        // spot: cosine at the edge, 1 / (cosine where the edge begins to fade - that)
};
// Directional lights first, then point lights; the counts are compiled in, since a loop of unknown length around so few
// operations costs a software renderer more than the operations.
const int light_count = DIRECTIONAL_LIGHTS + POINT_LIGHTS;
uniform Light light_uniforms[light_count + 1];
Light lights[light_count + 1];

// Before any other: see VolumeConstants for why there are two.
void begin_lights()
{
    for (int n = 0; n < light_count; ++n) {
        lights[n] = light_uniforms[n];
    }
}


vec3 ray_direction_world = vec3(0.0);  // unit
vec3 ray_origin_steps = vec3(0.0);     // origin of this ray relative to the camera, in steps

// A light as it arrives at parameter t of the ray. irradiance is over pi.
struct Incident {
    vec3 toward;  // unit
    float distance;  // steps
    vec3 irradiance;
};

Incident incident_from_afar(int n) { return Incident(lights[n].toward, 1e30, lights[n].irradiance); }

Incident incident_from_point(int n, float t)
{
    vec3 way = lights[n].toward - (ray_origin_steps + t * ray_direction_world);
    float squared = max(dot(way, way), 1e-12);
    float inverse = inversesqrt(squared);
    vec3 toward = way * inverse;
    float inside = clamp((dot(toward, lights[n].axis) - lights[n].cone.x) * lights[n].cone.y, 0.0, 1.0);
    float share = inside * inside * (3.0 - 2.0 * inside) / squared;
    return Incident(toward, squared * inverse, lights[n].irradiance * share);
}

