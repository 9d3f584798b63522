#version 450 core
// Light swept through the slices of a grid, away from the light, several axes side by side (gl_WorkGroupID.z). Each cell
// takes what the slice before it holds where its ray to the light crosses, attenuated on the way.
//
// What is swept: l, the share of direct light that arrives at a cell's centre, alone (nothing defined), or with
//   DIFFUSE: m.rgb, light scattered at least once, all of it forward:
//            m = T m' + S K[l' + m'],   S = exp(-(1 - w) tau) - T,   T = exp(-tau),   w the albedo
//            so that l + m = exp(-(1 - w) tau) for any number of slices. K spreads sideways.
//   PAPER:   c.rgb, the chromaticity of Ropinski et al. 2010: c = T K[c'] + (1 - T) w
// FROM_POINT: the light stands near by. WHOLE_SLICES: one work group sweeps all of an axis, slice by slice.
// The recurrences are in single precision whatever is kept of them.

#ifdef WHOLE_SLICES
layout(local_size_x = 32, local_size_y = 16) in;
#else
layout(local_size_x = 16, local_size_y = 8) in;
#endif

#include "light/light_grid.glsl"
#include "march/optical_depth.glsl"

uniform sampler3D extinction;  // times the grid's longest edge; filtered linearly, clamped
#ifdef LEAP
uniform usampler3D emptiness;  // distance to the nearest occupied macrocell; 0: occupied
uniform vec3 macrocells_per_cell;
uniform vec3 macrocell_of_origin;
#endif
uniform int slice_begin;       // counted from the light
uniform int slice_end;

#if defined(DIFFUSE) || defined(PAPER)
#define State vec4
const State unshadowed = vec4(BORDER_LIGHT, 1.0);
uniform sampler3D albedo;
#else
#define State float
const State unshadowed = 1.0;
#endif

layout(std430, binding = 0) restrict coherent buffer Swept { State swept[]; };

#ifdef DIFFUSE
uniform vec2 spread_cells[6];  // standard deviation of one scattering, in cells along u and v
#endif
#ifdef PAPER
uniform float cone_weights[6 * 9];  // of the 3 x 3 cells around the crossing
uniform int soft;                   // the direct light takes the kernel as well
#endif

int slice_cells(ivec2 size) { return size.x * size.y; }

#ifdef FROM_POINT
// How far beyond each face the light stands, in half cells up to 1: beyond faces where it does, cells outside see it past
// the volume; where it does not, they are as their neighbours inside. In between they are led over, or light would jump.
vec2 beyond_low = vec2(1.0), beyond_high = vec2(1.0);
#endif

// The slice before, at whole cells; outside of the grid nothing casts a shadow.
State before(int base, ivec2 size, ivec2 at)
{
    ivec2 inside = clamp(at, ivec2(0), size - 1);
    State state = swept[base + inside.y * size.x + inside.x];
#ifdef FROM_POINT
    vec2 shadowed = 1.0 - (vec2(lessThan(at, ivec2(0))) * beyond_low + vec2(greaterThanEqual(at, size)) * beyond_high);
    return mix(unshadowed, state, shadowed.x * shadowed.y);
#else
    return at == inside ? state : unshadowed;
#endif
}

State bilinear(int base, ivec2 size, ivec2 at, vec2 f)
{
    return mix(mix(before(base, size, at), before(base, size, at + ivec2(1, 0)), f.x),
               mix(before(base, size, at + ivec2(0, 1)), before(base, size, at + ivec2(1, 1)), f.x), f.y);
}

#ifdef DIFFUSE
// Spreads what is scattered in this slice by three taps (w/2, 1 - w, w/2) on a diagonal, whose variance along u and v is
// w times their distance squared. Diagonals and distances alternate from slice to slice, so that no copies of an edge
// stand out.
// A slice of optical depth tau scatters light tau / (1 - exp(-tau)) times where it does so at all.
State spread(int base, ivec2 size, vec2 p, State centre, vec2 standard_deviation, float tau, float opacity, int order)
{
    float squared_reach = float(order / 2 % 3 + 1);  // 1, 2, 3
    float w = 1.0 / squared_reach;
    float scatterings = opacity > 0.0 ? min(tau / opacity, 16.0) : 1.0;
    // Bilinear interpolation n + f cells away has the variance n^2 + f (2 n + 1).
    vec2 variance = standard_deviation * standard_deviation * (squared_reach * scatterings);
    vec2 n = floor(sqrt(variance));
    vec2 reach = (n + (variance - n * n) / (2.0 * n + 1.0)) * vec2(order % 2 == 0 ? 1.0 : -1.0, 1.0);
    State sum = (1.0 - w) * centre;
    for (int side = -1; side <= 1; side += 2) {
        // Outside nothing scatters, so nothing comes from there.
        vec2 q = clamp(p + float(side) * reach, min(p, 0.0), max(p, vec2(size) - 1.0));
        sum += 0.5 * w * bilinear(base, size, ivec2(floor(q)), q - floor(q));
    }
    return sum;
}
#endif

void sweep_cell(int slot, int order, ivec2 uv, ivec2 size)
{
    int axis = sweeps[slot].x;
    int sign_of_axis = sweeps[slot].y;
    ivec3 cell = cell_of(axis, sweeps[slot].z - sign_of_axis * order, uv);
    vec3 e = toward_light(cell);
    float ahead = abs(e[axis]);
    vec3 way = e / max(ahead, 1e-30);  // to the slice before, in cells
    // Where along that way the segment ends: at the slice before, at the border of the grid, or at the light.
    vec3 x = vec3(cell) + 0.5;
    vec3 room = mix(x, vec3(cells) - x, greaterThan(way, vec3(0.0)));
    vec3 exits = room / max(abs(way), vec3(1e-20));
    float end = min(1.0, min(exits.x, min(exits.y, exits.z)));
    bool lit_directly = order == 0;
#ifdef FROM_POINT
    beyond_low = clamp(-2.0 * across(axis, light), 0.0, 1.0);
    beyond_high = clamp(2.0 * (across(axis, light) - vec2(size)), 0.0, 1.0);
    end = min(end, ahead);
    lit_directly = lit_directly || ahead <= 1.0;
#endif
    vec2 shift = across(axis, way);
    vec2 p = vec2(uv) + shift;
    ivec2 at = ivec2(floor(p));
    vec2 f = p - floor(p);
    int slice = slice_cells(size);
    int base = sweep_begin[slot] + (order - 1) * slice;

    // Trapezoids between samples after each whole cell of sideways shift and at the end: a wall as thin as a cell is
    // not jumped over.
    float opacity = 0.0;
    float tau = 0.0;
#ifdef LEAP
    // All that the segment looks up: its points, a cell around for interpolation, and the cells' own halves.
    vec3 reach = (abs(way) * end + 1.5) * macrocells_per_cell;
    uint free = texelFetch(emptiness, ivec3(x * macrocells_per_cell + macrocell_of_origin), 0).x;
    if (max(reach.x, max(reach.y, reach.z)) > float(free) - 1.0)
#endif
    {
        float shifted = length(shift);
        float sigma = texelFetch(extinction, cell, 0).x;
        float depth = 0.0;
        float t = 0.0;
        int whole = int(min(ceil(shifted * end), 8192.0));
        vec3 inverse_cells = 1.0 / vec3(cells);
        for (int n = 1; n <= whole || n == 1; ++n) {
            float next = n < whole ? float(n) / shifted : end;
            float sigma_next = textureLod(extinction, (x + next * way) * inverse_cells, 0.0).x;
            depth += 0.5 * (sigma + sigma_next) * (next - t);
            sigma = sigma_next;
            t = next;
        }
        tau = depth * length(unit_from_cells * way);
        opacity = opacity_of(tau);
    }

    State arriving = unshadowed;
    if (!lit_directly) {
        arriving = bilinear(base, size, at, f);
    }
#if defined(DIFFUSE)
    vec4 scattering = arriving;
    if (!lit_directly) {
        scattering = spread(base, size, p, arriving, spread_cells[slot], tau, opacity, order);
    }
    vec3 w = texelFetch(albedo, cell, 0).xyz;
    vec3 absorbed = vec3(opacity_of((1.0 - w.x) * tau), opacity_of((1.0 - w.y) * tau), opacity_of((1.0 - w.z) * tau));
    vec3 m = (1.0 - opacity) * arriving.xyz + (opacity - absorbed) * (scattering.xyz + scattering.w);
    State result = vec4(m, (1.0 - opacity) * arriving.w);
#elif defined(PAPER)
    vec4 gathered = arriving;
    if (!lit_directly) {
        gathered = vec4(0.0);
        for (int n = 0; n < 9; ++n) {
            gathered += cone_weights[slot * 9 + n] * bilinear(base, size, at + ivec2(n % 3, n / 3) - 1, f);
        }
    }
    vec3 w = texelFetch(albedo, cell, 0).xyz;
    State result = vec4((1.0 - opacity) * gathered.xyz + opacity * w,
                        (1.0 - opacity) * (soft != 0 ? gathered.w : arriving.w));
#else
    State result = (1.0 - opacity) * arriving;
#endif
    swept[base + slice + uv.y * size.x + uv.x] = result;
}

void main()
{
    int slot = int(gl_WorkGroupID.z);
    ivec2 size = across(sweeps[slot].x, cells);
    int end = min(slice_end, sweeps[slot].w);
    for (int order = slice_begin; order < end; ++order) {
#ifdef WHOLE_SLICES
        ivec2 stride = ivec2(gl_WorkGroupSize.xy);
        for (int v = int(gl_LocalInvocationID.y); v < size.y; v += stride.y) {
            for (int u = int(gl_LocalInvocationID.x); u < size.x; u += stride.x) {
                sweep_cell(slot, order, ivec2(u, v), size);
            }
        }
        memoryBarrierBuffer();
        barrier();
#else
        ivec2 uv = ivec2(gl_GlobalInvocationID.xy);
        if (all(lessThan(uv, size))) {
            sweep_cell(slot, order, uv, size);
        }
#endif
    }
}
