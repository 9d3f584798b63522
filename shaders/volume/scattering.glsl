// Light scattered to the eye inside a volume: single scattering with the phase function of Henyey and Greenstein (1941)
// from a grid of direct light, and what was scattered before from a grid of diffuse light.
// Below the grid's resolution the last stretch to the light is looked up in the data themselves.
// DIFFUSE_LIGHT: there is such a grid. SURFACES: surfaces are shaded by their normals as well. NEAR_STEPS: samples.

#include "include/phase_function.glsl"

// The grids of all lights are stacked along z in one texture: indexing samplers by light is beyond some drivers.
uniform sampler3D direct_light[VOLUMES];
uniform sampler3D diffuse_light[VOLUMES];
const float near_cells = NEAR_STEPS > 0 ? 1.5 : 0.5;

// A place in the grid of light n, within its slab of the stack.
vec3 in_stack(vec3 place, int n, float half_cell)
{
    return vec3(place.xy, (float(n) + clamp(place.z, half_cell, 1.0 - half_cell)) * (1.0 / float(max(light_count, 1))));
}

// Direct light of light n at the end of the stretch towards it that is looked up in the data, where its grids are to be
// looked up, and the optical depth of that stretch.
struct Arriving {
    float direct;
    float depth;
    vec3 lookup;
    float beyond;  // what lies between there and the border, in half cells of the grid of direct light
};

Arriving arriving_light(int m, int n, vec3 x, Incident incident)
{
    vec3 way = constants[m].texture_from_world * incident.toward;
    vec3 cells_per_step = abs(way) * constants[m].light_cells;
    float rate = max(max(cells_per_step.x, cells_per_step.y), max(cells_per_step.z, 1e-20));
    vec3 room = mix(x - ray_volumes[m].low, ray_volumes[m].high - x, greaterThan(way, vec3(0.0)));
    vec3 exits = max(room, 0.0) / max(abs(way), vec3(1e-20));
    float outside = min(incident.distance, min(exits.x, min(exits.y, exits.z)));
    float reach = min(near_cells / rate, outside);
    Arriving arriving;
    arriving.depth = 0.0;
#if NEAR_STEPS > 0
    for (int k = 0; k < NEAR_STEPS; ++k) {
        arriving.depth += sigma_at(m, x + way * (reach * ((float(k) + 0.5) / float(NEAR_STEPS))));
    }
    arriving.depth *= (reach / float(NEAR_STEPS)) * constants[m].tau_scale;
#endif
    arriving.lookup = (x + way * reach) * constants[m].grid_from_texture_scale + constants[m].grid_from_texture_shift;
    // Cells at the border hold light from inside of them: over their outer half it is led to what comes from outside.
    arriving.beyond = 2.0 * rate * (outside - reach);
    float direct = textureLod(direct_light[m], in_stack(arriving.lookup, n, constants[m].half_cell.x), 0.0).x;
    arriving.direct = mix(1.0, direct, clamp(arriving.beyond, 0.0, 1.0));
    return arriving;
}

vec3 scattered_source(int m, vec3 color, float weight, float t)
{
    vec3 x = ray_volumes[m].origin + t * ray_volumes[m].direction;
    vec3 light = vec3(0.0);
    vec3 albedo = clamp(color / max(weight, 1e-20), 0.0, 1.0);
#ifdef SURFACES
    SurfacePoint point = surface_at(m, x);
    vec3 reflected_light = vec3(0.0);
#endif
    for (int n = 0; n < light_count; ++n) {
        Incident incident = n < DIRECTIONAL_LIGHTS ? incident_from_afar(n) : incident_from_point(n, t);
#ifdef CLOUD_SHADOWS
        incident.irradiance *= light_through_clouds(n, ray_origin_steps + t * ray_direction_world);
#endif
        Arriving arriving = arriving_light(m, n, x, incident);
        float opacity = opacity_of(arriving.depth);
        float direct = (1.0 - opacity) * arriving.direct;
        vec3 chromaticity = vec3(1.0);
        vec3 diffuse = vec3(0.0);
#ifdef DIFFUSE_LIGHT
        vec3 beside = textureLod(diffuse_light[m], in_stack(arriving.lookup, n, constants[m].half_cell.y), 0.0).xyz;
        float inside = clamp(arriving.beyond * constants[m].half_cell.x / constants[m].half_cell.y, 0.0, 1.0);
        if (constants[m].scatter_kind == 2) {
            chromaticity = mix(vec3(1.0), 4.0 * beside, inside);
        } else {
            beside *= inside;
            // The recurrence of the sweep over the last stretch, with the albedo of its end.
            vec3 depth = (1.0 - albedo) * arriving.depth;
            vec3 absorbed = vec3(opacity_of(depth.x), opacity_of(depth.y), opacity_of(depth.z));
            diffuse = (1.0 - opacity) * beside + (opacity - absorbed) * (beside + arriving.direct);
        }
#endif
        // Times 4 pi, since irradiance is over pi: p E = phase / 4 * (E / pi).
        float phase = 1.0;
        if (constants[m].scatter_kind != 2) {
            phase = 12.5663706143592 * phase_function(dot(incident.toward, ray_direction_world), constants[m].asymmetry);
        }
        vec3 by_phase = 0.25 * incident.irradiance * (phase * direct * chromaticity + diffuse);
#ifdef SURFACES
        Reflected reflected = Reflected(vec3(0.0), vec3(0.0));
        Surface surface = surfaces[m];
        reflect_light(surface, incident.toward, incident.irradiance * direct, point.normal, -ray_direction_world,
                      point.facing_eye, reflected);
        light += mix(by_phase, reflected.diffuse + 0.25 * incident.irradiance * diffuse, point.shaded);
        reflected_light += point.shaded * reflected.highlight;
#else
        light += by_phase;
#endif
    }
#ifdef SURFACES
    return color * light + weight * reflected_light;
#else
    return color * light;
#endif
}
