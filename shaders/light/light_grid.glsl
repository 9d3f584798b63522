// Cells of a light grid: cell (i, j, k) spans [i, i + 1] x ..., its centre is at i + 1/2. A sweep visits slices of one
// axis, away from the light; within a slice u and v are the other two axes, in order.

uniform ivec3 cells;
uniform vec3 light;            // the way to the light, in cells; with FROM_POINT the point where it stands
uniform mat3 unit_from_cells;  // to lengths in units of the grid's longest edge
uniform ivec4 sweeps[6];       // axis, sign, first slice, number of slices
uniform int sweep_begin[6];    // where each sweep's cells begin in the buffer

ivec3 cell_of(int axis, int slice, ivec2 uv)
{
    return axis == 0 ? ivec3(slice, uv) : axis == 1 ? ivec3(uv.x, slice, uv.y) : ivec3(uv, slice);
}

vec2 across(int axis, vec3 v) { return axis == 0 ? v.yz : axis == 1 ? v.xz : v.xy; }
ivec2 across(int axis, ivec3 v) { return axis == 0 ? v.yz : axis == 1 ? v.xz : v.xy; }

// The way from a cell's centre to the light, in cells; its length matters only with FROM_POINT.
vec3 toward_light(ivec3 cell)
{
#ifdef FROM_POINT
    return light - (vec3(cell) + 0.5);
#else
    return light;
#endif
}
