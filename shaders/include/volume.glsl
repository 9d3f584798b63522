// The medium 'measured volume': scalar grids with transfer functions, VOLUMES of them at once, for march.glsl.
// Spaces: texture space of each volume is [0,1]^3; the ray's parameter t counts steps of one world length, the same for
// all volumes.

uniform sampler3D voxels[VOLUMES];         // data value, affinely mapped to [0,1]
uniform sampler1D optics_table[VOLUMES];   // x: sigma, yzw: sigma * S, per reference length, over u in [0,1]
uniform sampler1D depth_table[VOLUMES];    // x: K(u) = integral of sigma from 0 to u, y: sigma
uniform sampler2D source_table[VOLUMES];   // S(u_front, u_back): mean source radiance of a segment, self-attenuated
uniform sampler2D glow_table[VOLUMES];     // the part of S that needs no light (GLOW)
uniform sampler3D gradients[VOLUMES];      // per-voxel differences, mapped to [0,1] per channel
uniform usampler3D emptiness[VOLUMES];     // distance to the nearest occupied macrocell, in cells; 0: occupied

struct Volume {
    vec3 origin;          // ray origin at t = 0, texture space
    vec3 direction;       // texture space per step
    vec3 low, high;       // what is shown, texture space
};
uniform vec2 u_from_voxel[VOLUMES];        // u = x * texel + y
uniform vec2 u_visible[VOLUMES];           // no extinction outside of these two
uniform float tau_scale[VOLUMES];          // optical depth per step and per unit of sigma in the tables
uniform vec3 cells_from_texture[VOLUMES];  // macrocells along each axis, fractional
uniform mat3 world_from_gradient[VOLUMES]; // from gradient texels to world, scaled to data ranges per smallest voxel edge
uniform vec3 gradient_zero[VOLUMES];       // texel that means no gradient

Volume ray_volumes[VOLUMES];
float ray_enter[VOLUMES];
float ray_leave[VOLUMES];

const float depth_entries = 1021.0;
const float source_entries = 256.0;

float table_coordinate(float u, float entries) { return (clamp(u, 0.0, 1.0) * (entries - 1.0) + 0.5) / entries; }

struct Sample {
    float u[VOLUMES];     // unclamped: 0 and 1 are the ends of the window
#ifndef SAMPLE_AT_MIDPOINTS
    vec2 depth[VOLUMES];  // K and sigma at u
#endif
};

Sample medium_nothing()
{
    Sample s;
    for (int m = 0; m < VOLUMES; ++m) {
        s.u[m] = 0.0;
#ifndef SAMPLE_AT_MIDPOINTS
        s.depth[m] = vec2(0.0);
#endif
    }
    return s;
}

Sample medium_sample(float t)
{
    Sample s;
    for (int m = 0; m < VOLUMES; ++m) {
        vec3 x = ray_volumes[m].origin + t * ray_volumes[m].direction;
        float texel = textureLod(voxels[m], x, 0.0).x;
        float u = texel * u_from_voxel[m].x + u_from_voxel[m].y;
        s.u[m] = u;
#ifndef SAMPLE_AT_MIDPOINTS
        // Beyond the window sigma is constant, so K goes on in a straight line.
        float inside = clamp(u, 0.0, 1.0);
        vec2 depth = textureLod(depth_table[m], table_coordinate(inside, depth_entries), 0.0).xy;
        s.depth[m] = vec2(depth.x + (u - inside) * depth.y, depth.y);
#endif
    }
    return s;
}

#ifdef LIT
#include "include/gradient_shading.glsl"
#endif

bool medium_segment(Sample front, Sample back, float t_front, float t_back, out float tau, out vec3 source)
{
    tau = 0.0;
    source = vec3(0.0);
    for (int m = 0; m < VOLUMES; ++m) {
#if VOLUMES > 1
        // Each volume has its own stretch of the common ray.
        float part_front = max(t_front, ray_enter[m]);
        float part_back = min(t_back, ray_leave[m]);
#else
        float part_front = t_front;
        float part_back = t_back;
#endif
        float part = part_back - part_front;
        if (!(part > 0.0)) {
            continue;
        }
        float part_tau;
        vec3 part_source;
#ifdef SAMPLE_AT_MIDPOINTS
        if (front.u[m] < u_visible[m].x || front.u[m] > u_visible[m].y) {
            continue;
        }
        vec4 optics = textureLod(optics_table[m], table_coordinate(front.u[m], depth_entries), 0.0);
        if (!(optics.x > 0.0)) {
            continue;
        }
        part_tau = optics.x * part * tau_scale[m];
        part_source = optics.yzw / optics.x;
#else
        // Mean of sigma over the values in between: exactly from K, or by the trapezoid where the difference of two
        // prefixes would lose its digits.
        float du = back.u[m] - front.u[m];
        float mean = abs(du) * (depth_entries - 1.0) > 1.0 ? (back.depth[m].x - front.depth[m].x) / du
                                                           : 0.5 * (back.depth[m].y + front.depth[m].y);
        if (!(mean > 0.0)) {
            continue;
        }
        part_tau = mean * part * tau_scale[m];
        part_source = textureLod(source_table[m], vec2(table_coordinate(front.u[m], source_entries),
                                                       table_coordinate(back.u[m], source_entries)), 0.0).xyz;
#endif
#ifdef LIT
        part_source = lit_source(m, part_source, 0.5 * (part_front + part_back));
#endif
#ifdef GLOW
        // Light of its own is not lit, so it has a table apart.
        part_source += textureLod(glow_table[m], vec2(table_coordinate(front.u[m], source_entries),
                                                      table_coordinate(back.u[m], source_entries)), 0.0).xyz;
#endif
        tau += part_tau;
        source += part_tau * part_source;
    }
    if (!(tau > 0.0)) {
        return false;
    }
    source /= tau;
    return true;
}

bool medium_empty(float t, out float until)
{
    until = t + 1e6;  // keeps the integer arithmetic of the leap in range
    bool empty = true;
    for (int m = 0; m < VOLUMES; ++m) {
#if VOLUMES > 1
        // A segment whose middle lies outside of a volume may still reach into it, by half a step at most.
        if (t > ray_leave[m] + 1.0) {
            continue;
        }
        if (t < ray_enter[m] - 1.0) {
            until = min(until, ray_enter[m] - 1.0);
            continue;
        }
#endif
        vec3 x = (ray_volumes[m].origin + t * ray_volumes[m].direction) * cells_from_texture[m];
        vec3 per_step = ray_volumes[m].direction * cells_from_texture[m];
        ivec3 cell = clamp(ivec3(x), ivec3(0), textureSize(emptiness[m], 0) - 1);
        float reach = float(texelFetch(emptiness[m], cell, 0).x);
        empty = empty && reach > 0.0;
        // Every cell nearer than `reach` is empty: leave the cube of cells around this one. An occupied cell is left
        // as soon as the ray leaves it.
        reach = max(reach, 1.0);
        vec3 border = vec3(cell) + mix(vec3(1.0 - reach), vec3(reach), greaterThanEqual(per_step, vec3(0.0)));
        bvec3 still = lessThan(abs(per_step), vec3(1e-20));
        vec3 distances = mix((border - x) / mix(per_step, vec3(1.0), still), vec3(1e6), still);
        until = min(until, t + max(0.0, min(distances.x, min(distances.y, distances.z))));
    }
    return empty;
}
