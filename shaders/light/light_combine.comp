#version 450 core
// The sweeps of one light through a grid, weighted and summed into the texture that the marcher looks up.
// CHANNELS 1: direct light; 4: what was swept beside it. FROM_POINT: weights for each cell. FORMAT: of the texture.

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

#include "light/light_grid.glsl"

uniform int sweep_count;
uniform float weights[6];  // without FROM_POINT
uniform mat3 normals;      // columns: unit normals of the slices, in world axes
uniform mat3 world_from_cells;
uniform int accumulate;    // add to what the texture holds

#if CHANNELS == 4
#define State vec4
const State lit_fully = vec4(BORDER_LIGHT, 1.0);
#else
#define State float
const State lit_fully = 1.0;
#endif
layout(std430, binding = 0) restrict readonly buffer Swept { State swept[]; };
layout(binding = 0, FORMAT) uniform restrict image3D combined;
#ifdef ALSO_DIRECT
layout(binding = 1, ALSO_DIRECT) uniform restrict writeonly image3D direct;  // the fourth channel, apart
#endif

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(cell, cells))) {
        return;
    }
#ifdef FROM_POINT
    vec3 omega = world_from_cells * toward_light(cell);
    float squared = dot(omega, omega);
    vec3 along = omega * normals;  // along each slice normal
    vec3 by_axis = max(along * along / max(squared, 1e-30) - 1.0 / 1024.0, 0.0);
    by_axis /= max(by_axis.x + by_axis.y + by_axis.z, 1e-30);
#endif
    State sum = State(0.0);
    for (int n = 0; n < sweep_count; ++n) {
        ivec4 sweep = sweeps[n];
        int order = (sweep.z - cell[sweep.x]) * sweep.y;
        if (order < 0 || order >= sweep.w) {
            continue;
        }
#ifdef FROM_POINT
        float weight = by_axis[sweep.x];
#else
        float weight = weights[n];
#endif
        if (weight > 0.0) {
            ivec2 size = across(sweep.x, cells);
            ivec2 uv = across(sweep.x, cell);
            sum += weight * swept[sweep_begin[n] + (order * size.y + uv.y) * size.x + uv.x];
        }
    }
#ifdef FROM_POINT
    if (!(squared > 0.0) && accumulate == 0) {
        sum = lit_fully;  // the light stands in the middle of this cell
    }
#endif
    vec4 result = vec4(sum);
    if (accumulate != 0) {
        result += imageLoad(combined, cell);
    }
    imageStore(combined, cell, result);
#ifdef ALSO_DIRECT
    imageStore(direct, cell, vec4(result.w));
#endif
}
