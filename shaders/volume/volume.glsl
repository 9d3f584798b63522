// The medium 'measured volume': scalar grids with transfer functions, VOLUMES of them at once, for march.glsl.
// Spaces: texture space of each volume is [0,1]^3; the ray's parameter t counts steps of one world length, the same for
// all volumes.

#ifdef HOLES
#include "volume/absent.glsl"
#endif

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
// What is the same for all rays. It is copied to variables before each march: Mesa's software renderer gathers an element
// of a uniform array lane by lane wherever it is read, which took an eighth of a lit frame.
struct VolumeConstants {
    vec2 u_from_voxel;        // u = x * texel + y
    vec2 optics_from_voxel;   // coordinate in optics_table = x * texel + y
    vec2 optics_visible;      // no extinction outside of these two coordinates
    vec2 u_visible;           // the same in u
    float tau_scale;          // optical depth per step and per unit of sigma in the tables
    vec3 cells_from_texture;  // macrocells along each axis, fractional
    vec3 last_cell;           // indices of the last macrocell along each axis
    mat3 world_from_gradient; // from gradient texels to world, scaled to ranges of shading per smallest voxel edge
    vec3 gradient_zero;       // texel that means no gradient
#ifdef GRADIENTS_FROM_VOXELS
    vec3 samples;             // along each axis
#endif
#ifdef SCATTER
    vec2 half_cell;                // along z of the two light grids, as a share of one of them
    vec3 grid_from_texture_scale;  // texture space -> [0,1] over the light grid
    vec3 grid_from_texture_shift;
    vec3 light_cells;              // cells of the light grid per unit of texture space
    mat3 texture_from_world;       // texture space per step
    float asymmetry;               // g
    int scatter_kind;              // 0: not a scattering volume, 1: physical, 2: chromaticity
#endif
};
uniform VolumeConstants volume_uniforms[VOLUMES];
VolumeConstants constants[VOLUMES];

Volume ray_volumes[VOLUMES];
// The same ray in macrocells. Divisions are made once per ray: they are dear on a software renderer.
vec3 ray_cells_origin[VOLUMES];
vec3 ray_cells_step[VOLUMES];
vec3 ray_steps_per_cell[VOLUMES];  // 1 / step, huge where the ray does not move
// The border that the ray meets first, of a cube of cells around a cell: cell + ray_first_border + reach * ray_side.
vec3 ray_side[VOLUMES];
vec3 ray_first_border[VOLUMES];
float ray_enter[VOLUMES];
float ray_leave[VOLUMES];

const float depth_entries = 1021.0;
const float source_entries = 256.0;

// Where u stands in a table; beyond the ends the texture is clamped to its border entries.
float table_coordinate(float u, const float entries) { return u * ((entries - 1.0) / entries) + 0.5 / entries; }

void begin_ray(int m, Volume volume)
{
    constants[m] = volume_uniforms[m];
    ray_enter[m] = 0.0;
    ray_leave[m] = 0.0;
    ray_volumes[m] = volume;
    ray_cells_origin[m] = volume.origin * constants[m].cells_from_texture;
    ray_cells_step[m] = volume.direction * constants[m].cells_from_texture;
    bvec3 still = lessThan(abs(ray_cells_step[m]), vec3(1e-20));
    ray_steps_per_cell[m] = mix(1.0 / mix(ray_cells_step[m], vec3(1.0), still), vec3(1e20), still);
    ray_first_border[m] = vec3(lessThan(ray_steps_per_cell[m], vec3(0.0)));
    ray_side[m] = 1.0 - 2.0 * ray_first_border[m];
}

struct Sample {
#ifdef SAMPLE_AT_MIDPOINTS
    float at[VOLUMES];    // coordinate in the optics table
#else
    float u[VOLUMES];     // unclamped: 0 and 1 are the ends of the window
    vec2 depth[VOLUMES];  // K and sigma at u
#endif
};

Sample medium_nothing()
{
    Sample s;
    for (int m = 0; m < VOLUMES; ++m) {
#ifdef SAMPLE_AT_MIDPOINTS
        s.at[m] = 0.0;
#else
        s.u[m] = 0.0;
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
#ifdef SAMPLE_AT_MIDPOINTS
        s.at[m] = texel * constants[m].optics_from_voxel.x + constants[m].optics_from_voxel.y;
#ifdef HOLES
        s.at[m] = is_absent(texel) ? coordinate_of_absent : s.at[m];
#endif
#else
#ifdef HOLES
        if (is_absent(texel)) {
            s.u[m] = coordinate_of_absent;
            s.depth[m] = vec2(0.0);
            continue;
        }
#endif
        float u = texel * constants[m].u_from_voxel.x + constants[m].u_from_voxel.y;
        s.u[m] = u;
        // Beyond the window sigma is constant, so K goes on in a straight line.
        float inside = clamp(u, 0.0, 1.0);
        vec2 depth = textureLod(depth_table[m], table_coordinate(inside, depth_entries), 0.0).xy;
        s.depth[m] = vec2(depth.x + (u - inside) * depth.y, depth.y);
#endif
    }
    return s;
}

// Extinction at a point, in the tables' unit.
float sigma_at(int m, vec3 x)
{
    float texel = textureLod(voxels[m], x, 0.0).x;
#ifdef HOLES
    if (is_absent(texel)) {
        return 0.0;
    }
#endif
#ifdef SAMPLE_AT_MIDPOINTS
    return textureLod(optics_table[m], texel * constants[m].optics_from_voxel.x + constants[m].optics_from_voxel.y, 0.0).x;
#else
    float u = clamp(texel * constants[m].u_from_voxel.x + constants[m].u_from_voxel.y, 0.0, 1.0);
    return textureLod(depth_table[m], table_coordinate(u, depth_entries), 0.0).y;
#endif
}

#ifdef LIT
#include "light/lights.glsl"
#if defined(REFLECT) || defined(SURFACES)
#include "volume/gradient_shading.glsl"
#endif
#ifdef SCATTER
#include "volume/scattering.glsl"
#endif

// Light sent towards the eye by matter at parameter t that covers `weight` of the pixel, with `color` its colour times
// that weight.
vec3 lit_source(int m, vec3 color, float weight, float t)
{
#if defined(SCATTER) && defined(REFLECT)
    return constants[m].scatter_kind != 0 ? scattered_source(m, color, weight, t) : reflected_source(m, color, weight, t);
#elif defined(SCATTER)
    return constants[m].scatter_kind != 0 ? scattered_source(m, color, weight, t) : color;
#else
    return reflected_source(m, color, weight, t);
#endif
}

// The segment judged last, per volume.
float segment_tau[VOLUMES];
vec3 segment_source[VOLUMES];
float segment_t[VOLUMES];
float segment_inverse_tau = 0.0;
#ifdef GLOW
vec3 segment_glow[VOLUMES];
#endif

void medium_begin()
{
    begin_lights();
    for (int m = 0; m < VOLUMES; ++m) {
#if defined(REFLECT) || defined(SURFACES)
        surfaces[m] = surface_uniforms[m];
#endif
        segment_tau[m] = 0.0;
        segment_source[m] = vec3(0.0);
        segment_t[m] = 0.0;
#ifdef GLOW
        segment_glow[m] = vec3(0.0);
#endif
    }
}
#endif

#if defined(HOLES) && !defined(SAMPLE_AT_MIDPOINTS)
// What there is of a segment that has one end in a hole: its other end moves to where the hole begins, found by halving.
float present_share = 1.0;
bool ends_present(int m, float t_front, float t_back, inout Sample front, inout Sample back)
{
    bool no_front = is_absent_coordinate(front.u[m]);
    bool no_back = is_absent_coordinate(back.u[m]);
    present_share = 1.0;
    if (no_front == no_back) {
        return !no_front;
    }
    float present = no_front ? 1.0 : 0.0;  // shares of the segment
    float hole = 1.0 - present;
    vec2 depth = no_front ? back.depth[m] : front.depth[m];
    float u = no_front ? back.u[m] : front.u[m];
    for (int k = 0; k < 4; ++k) {
        float middle = 0.5 * (present + hole);
        Sample between = medium_sample(mix(t_front, t_back, middle));
        if (is_absent_coordinate(between.u[m])) {
            hole = middle;
        } else {
            present = middle;
            u = between.u[m];
            depth = between.depth[m];
        }
    }
    float border = 0.5 * (present + hole);
    present_share = no_front ? 1.0 - border : border;
    if (no_front) {
        front.u[m] = u;
        front.depth[m] = depth;
    } else {
        back.u[m] = u;
        back.depth[m] = depth;
    }
    return true;
}
#endif

bool medium_segment(Sample front, Sample back, float t_front, float t_back, out float tau, out vec3 source)
{
    tau = 0.0;
    source = vec3(0.0);
    for (int m = 0; m < VOLUMES; ++m) {
#ifdef LIT
        segment_tau[m] = 0.0;
#endif
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
#ifdef HOLES
        if (is_absent_coordinate(front.at[m])) {
            continue;
        }
#endif
        // A comparison is cheaper than a look at the table, and most of what is not leapt over is empty still.
        if (front.at[m] < constants[m].optics_visible.x || front.at[m] > constants[m].optics_visible.y) {
            continue;
        }
        vec4 optics = textureLod(optics_table[m], front.at[m], 0.0);
        if (!(optics.x > 0.0)) {
            continue;
        }
        part_tau = optics.x * part * constants[m].tau_scale;
        part_source = optics.yzw * (1.0 / optics.x);
#else
#ifdef HOLES
        if (!ends_present(m, t_front, t_back, front, back)) {
            continue;
        }
        part *= present_share;
#endif
        // Mean of sigma over the values in between: exactly from K, or by the trapezoid where the difference of two
        // prefixes would lose its digits.
        float du = back.u[m] - front.u[m];
        float mean = abs(du) * (depth_entries - 1.0) > 1.0 ? (back.depth[m].x - front.depth[m].x) / du
                                                           : 0.5 * (back.depth[m].y + front.depth[m].y);
        if (!(mean > 0.0)) {
            continue;
        }
        part_tau = mean * part * constants[m].tau_scale;
        part_source = textureLod(source_table[m], vec2(table_coordinate(front.u[m], source_entries),
                                                       table_coordinate(back.u[m], source_entries)), 0.0).xyz;
#endif
#ifdef LIT
        segment_tau[m] = part_tau;
        segment_source[m] = part_source;
#ifdef SCATTER
        // Where the light that reaches the eye comes from on average: near the front of dense matter.
        float seen = part_tau < 0.05 ? 0.5 - part_tau * (1.0 / 12.0)
                                     : 1.0 / part_tau - 1.0 / (exp(min(part_tau, 80.0)) - 1.0);
        segment_t[m] = mix(part_front, part_back, seen);
#else
        segment_t[m] = 0.5 * (part_front + part_back);
#endif
#ifdef GLOW
        // Light of its own is not lit, so it has a table apart.
#ifdef SAMPLE_AT_MIDPOINTS
        vec2 ends = vec2((front.at[m] * depth_entries - 0.5) / (depth_entries - 1.0));
#else
        vec2 ends = vec2(front.u[m], back.u[m]);
#endif
        segment_glow[m] = textureLod(glow_table[m], vec2(table_coordinate(ends.x, source_entries),
                                                         table_coordinate(ends.y, source_entries)), 0.0).xyz;
#endif
#elif VOLUMES > 1
        source += part_tau * part_source;
#else
        source = part_source;
#endif
        tau += part_tau;
    }
    if (!(tau > 0.0)) {
        return false;
    }
#if defined(LIT)
    segment_inverse_tau = 1.0 / tau;
#elif VOLUMES > 1
    source /= tau;
#endif
    return true;
}

#ifdef LIT
vec3 medium_lit(float weight)
{
    vec3 light = vec3(0.0);
    for (int m = 0; m < VOLUMES; ++m) {
#if VOLUMES > 1
        float share = weight * segment_tau[m] * segment_inverse_tau;
#else
        float share = weight;
#endif
        light += lit_source(m, share * segment_source[m], share, segment_t[m]);
#ifdef GLOW
        light += share * segment_glow[m];
#endif
    }
    return light;
}
#endif

#if defined(REFINE) && defined(HOLES)
bool medium_has_hole(Sample front, Sample middle, Sample back)
{
    bool has = false;
    for (int m = 0; m < VOLUMES; ++m) {
        has = has || is_absent_coordinate(front.u[m]) || is_absent_coordinate(middle.u[m]) ||
              is_absent_coordinate(back.u[m]);
    }
    return has;
}
#endif

#ifdef REFINE
bool medium_may_show(Sample front, Sample back)
{
    bool shows = false;
    for (int m = 0; m < VOLUMES; ++m) {
#ifdef HOLES
        if (is_absent_coordinate(front.u[m]) || is_absent_coordinate(back.u[m])) {
            shows = true;  // the hole may end in between
            continue;
        }
#endif
        // Data that are not straight may leave the range of the two ends.
        float low = min(front.u[m], back.u[m]);
        float high = max(front.u[m], back.u[m]);
        float bend = 0.05 + 0.5 * (high - low);
        shows = shows || (high + bend >= constants[m].u_visible.x && low - bend <= constants[m].u_visible.y);
    }
    return shows;
}
#endif

// How far from its sample a segment reaches, with a quarter of a step for rounding.
#ifdef SAMPLE_AT_MIDPOINTS
const float segment_reach = 0.75;
#else
const float segment_reach = 0.25;
#endif

bool medium_empty(float t, out float until)
{
    until = t + 1e6;  // keeps the integer arithmetic of the leap in range
    bool empty = true;
    for (int m = 0; m < VOLUMES; ++m) {
#if VOLUMES > 1
        // A segment that only touches the stretch of this volume counts too, though its midpoint lies outside.
        if (t > ray_leave[m] + segment_reach) {
            continue;
        }
        if (t < ray_enter[m] - segment_reach) {
            until = min(until, ray_enter[m] - segment_reach);
            continue;
        }
#endif
        vec3 x = ray_cells_origin[m] + t * ray_cells_step[m];
        vec3 cell = floor(x);
        float reach = float(texelFetch(emptiness[m], ivec3(clamp(cell, vec3(0.0), constants[m].last_cell)), 0).x);
        empty = empty && reach > 0.0;
        // Every cell nearer than `reach` is empty: leave the cube of cells around this one. An occupied cell is left
        // as soon as the ray leaves it.
        reach = max(reach, 1.0);
        vec3 border = cell + (ray_first_border[m] + reach * ray_side[m]);
        vec3 distances = (border - x) * ray_steps_per_cell[m];
        until = min(until, t + max(0.0, min(distances.x, min(distances.y, distances.z))));
    }
    return empty;
}
