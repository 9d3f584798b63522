// The medium that paths are traced through: VOLUMES measured volumes, overlapping freely; their extinctions add up.
// Medium space has the world's axes, the volumes' centre for its origin and half their diagonal for its unit; the
// parameter t of a ray is a length in it, sigma an extinction per such unit.

#ifdef HOLES
#include "volume/absent.glsl"
#endif

uniform sampler3D voxels[VOLUMES];          // data value, affinely mapped to [0,1]
uniform sampler1D optics_table[VOLUMES];    // x: sigma per reference length, yzw: albedo; over u in [0,1]
uniform sampler1D glow_table[VOLUMES];      // own light per unit of extinction (GLOW)
uniform sampler3D extinction_bounds[VOLUMES];  // least and most sigma per reference length in each macrocell
uniform vec2 table_from_voxel[VOLUMES];     // coordinate in the tables = x * texel + y
uniform float sigma_scale[VOLUMES];         // sigma per unit of medium space and unit of the tables
uniform vec3 cells_from_texture[VOLUMES];   // macrocells along each axis, fractional
uniform mat4 texture_from_medium[VOLUMES];
uniform vec3 clip_low[VOLUMES];             // what is shown, texture space
uniform vec3 clip_high[VOLUMES];
uniform float mean_cosine[VOLUMES];         // g of the phase function

// DO(v) for each volume, with a constant: samplers are chosen by constants only. In a loop that is too long to be unrolled
// a software renderer was seen to look up the wrong one.
#if VOLUMES == 1
#define EACH_VOLUME(DO) DO(0)
#elif VOLUMES == 2
#define EACH_VOLUME(DO) DO(0) DO(1)
#elif VOLUMES == 3
#define EACH_VOLUME(DO) DO(0) DO(1) DO(2)
#elif VOLUMES == 4
#define EACH_VOLUME(DO) DO(0) DO(1) DO(2) DO(3)
#elif VOLUMES == 5
#define EACH_VOLUME(DO) DO(0) DO(1) DO(2) DO(3) DO(4)
#elif VOLUMES == 6
#define EACH_VOLUME(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5)
#elif VOLUMES == 7
#define EACH_VOLUME(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6)
#else
#define EACH_VOLUME(DO) DO(0) DO(1) DO(2) DO(3) DO(4) DO(5) DO(6) DO(7)
#endif

const float never = 1e30;

// A ray's way through the macrocells of one volume. Borders are computed from whole numbers, not by adding up, and each
// crossing moves on by a cell, so that rounding can neither drift nor stand still.
struct Walk {
    vec3 origin, direction;          // texture space
    vec3 cells_origin, cells_inverse;
    ivec3 stride;                    // to the next cell along each axis; 0 where the ray does not move
    float enter, leave;              // where the volume is shown; a miss has both at `never`
    ivec3 cell;
    vec3 borders;                    // t at which the cell is left along each axis
    vec2 sigma;                      // bounds in the cell
};
Walk walks[VOLUMES];

// A ray in texture space, and where the volume is shown along it.
void set_walk(int v, vec3 origin, vec3 direction, vec2 stretch)
{
    vec3 cells_direction = direction * cells_from_texture[v];
    bvec3 still = lessThan(abs(cells_direction), vec3(1e-20));
    walks[v].origin = origin;
    walks[v].direction = direction;
    walks[v].cells_origin = origin * cells_from_texture[v];
    walks[v].cells_inverse = 1.0 / mix(cells_direction, vec3(1.0), still);
    walks[v].stride = mix(ivec3(sign(cells_direction)), ivec3(0), still);
    walks[v].enter = stretch.x;
    walks[v].leave = stretch.y;
    vec3 first = walks[v].cells_origin + stretch.x * cells_direction;
    walks[v].cell = clamp(ivec3(floor(first)), ivec3(0), textureSize(extinction_bounds[v], 0) - 1);
}

void enter_cell(int v)
{
    vec3 ahead = vec3(max(walks[v].stride, ivec3(0)));
    vec3 borders = (vec3(walks[v].cell) + ahead - walks[v].cells_origin) * walks[v].cells_inverse;
    walks[v].borders = mix(borders, vec3(never), equal(walks[v].stride, ivec3(0)));
    walks[v].sigma = texelFetch(extinction_bounds[v], walks[v].cell, 0).xy * sigma_scale[v];
}

float cell_end(int v) { return min(walks[v].borders.x, min(walks[v].borders.y, walks[v].borders.z)); }

void begin_walk_through(int v, vec3 origin, vec3 direction, float near, float far)
{
    vec3 o = (texture_from_medium[v] * vec4(origin, 1.0)).xyz;
    vec3 d = mat3(texture_from_medium[v]) * direction;
    vec2 stretch = ray_box(o, d, clip_low[v], clip_high[v]);
    stretch = vec2(max(stretch.x, near), min(stretch.y, far));
    if (stretch.y > stretch.x) {
        set_walk(v, o, d, stretch);
        enter_cell(v);
    } else {
        walks[v].enter = never;
        walks[v].leave = never;
    }
}

void begin_walk(vec3 origin, vec3 direction, float near, float far)
{
#define BEGIN(v) begin_walk_through(v, origin, direction, near, far);
    EACH_VOLUME(BEGIN)
}

// Bounds of sigma from t to `until`, which is `never` when nothing lies ahead.
vec2 walk_bounds(float t, out float until)
{
    vec2 sigma = vec2(0.0);
    until = never;
    for (int v = 0; v < VOLUMES; ++v) {
        if (t < walks[v].enter) {
            until = min(until, walks[v].enter);
        } else if (t < walks[v].leave) {
            sigma += walks[v].sigma;
            until = min(until, min(cell_end(v), walks[v].leave));
        }
    }
    until = max(until, t);  // never back, where rounding put t behind the border of its cell
    return sigma;
}

void walk_on_through(int v, float t)
{
    float end = cell_end(v);
    if (t >= walks[v].enter && t < walks[v].leave && end <= t) {
        walks[v].cell += mix(ivec3(0), walks[v].stride, lessThanEqual(walks[v].borders, vec3(end)));
        if (any(lessThan(walks[v].cell, ivec3(0))) ||
            any(greaterThanEqual(walks[v].cell, textureSize(extinction_bounds[v], 0)))) {
            walks[v].leave = t;
        } else {
            enter_cell(v);
        }
    }
}

// Moves into the cells that begin at t, an `until` of walk_bounds.
void walk_on(float t)
{
#define WALK_ON(v) walk_on_through(v, t);
    EACH_VOLUME(WALK_ON)
}

bool is_inside(int v, float t) { return t >= walks[v].enter && t < walks[v].leave; }

// Where the 1-D tables of a volume are to be looked up for the point at t.
float table_coordinate(int v, float t)
{
    vec3 x = walks[v].origin + t * walks[v].direction;
    float texel = textureLod(voxels[v], x, 0.0).x;
#ifdef HOLES
    if (is_absent(texel)) {
        return coordinate_of_absent;
    }
#endif
    return texel * table_from_voxel[v].x + table_from_voxel[v].y;
}

float sigma_of(int v, float t)
{
#ifdef HOLES
    if (!is_inside(v, t)) {
        return 0.0;
    }
    float at = table_coordinate(v, t);
    return is_absent_coordinate(at) ? 0.0 : textureLod(optics_table[v], at, 0.0).x * sigma_scale[v];
#else
    return is_inside(v, t) ? textureLod(optics_table[v], table_coordinate(v, t), 0.0).x * sigma_scale[v] : 0.0;
#endif
}

float sigma_at(float t)
{
    float sigma = 0.0;
#define ADD_SIGMA(v) sigma += sigma_of(v, t);
    EACH_VOLUME(ADD_SIGMA)
    return sigma;
}

// What light meets at a point.
struct Collision {
    float t;
    vec3 albedo;
    vec3 glow;
    float g;
};

// Adds one volume's sigma; the one that lifts it above the threshold is what light collides with.
bool collides_with(int v, float threshold, inout float sigma, inout Collision c)
{
    if (!is_inside(v, c.t)) {
        return false;
    }
    float at = table_coordinate(v, c.t);
#ifdef HOLES
    if (is_absent_coordinate(at)) {
        return false;
    }
#endif
    vec4 optics = textureLod(optics_table[v], at, 0.0);
    sigma += optics.x * sigma_scale[v];
    if (!(threshold < sigma)) {
        return false;
    }
    c.albedo = optics.yzw;
    c.g = mean_cosine[v];
#ifdef GLOW
    c.glow = textureLod(glow_table[v], at, 0.0).xyz;
#endif
    return true;
}

// Whether light collides at c.t: when sigma there is above a threshold drawn below its bound. The same number decides
// with which of the volumes.
bool collides(float threshold, inout Collision c)
{
    float sigma = 0.0;
    bool found = false;
#define COLLIDE(v) found = found || collides_with(v, threshold, sigma, c);
    EACH_VOLUME(COLLIDE)
    return found;
}
