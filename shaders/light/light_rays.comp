#version 450 core
// Direct light in each cell of a light grid by a ray of its own to the light, through the data themselves: shadows as
// sharp as the grid. FROM_POINT: the light stands near by. The other switches are march.glsl's.

layout(local_size_x = 8, local_size_y = 4, local_size_z = 4) in;

#include "march/optical_depth.glsl"
#include "include/ray_box.glsl"
#include "volume/volume.glsl"
#include "march/march.glsl"

uniform ivec3 cells;
uniform vec3 texture_low;  // of cell (0, 0, 0)
uniform vec3 texture_per_cell;
uniform vec3 clip_low;
uniform vec3 clip_high;
uniform vec3 light;            // texture space: the way to the light per step, or with FROM_POINT its place
uniform mat3 steps_from_texture;
layout(binding = 0, FORMAT) uniform writeonly restrict image3D direct;

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(cell, cells))) {
        return;
    }
    Volume volume;
    volume.origin = texture_low + (vec3(cell) + 0.5) * texture_per_cell;
    volume.low = clip_low;
    volume.high = clip_high;
    float distance = 1e30;
#ifdef FROM_POINT
    vec3 way = light - volume.origin;
    distance = length(steps_from_texture * way);
    volume.direction = way / max(distance, 1e-20);
#else
    volume.direction = light;
#endif
    begin_ray(0, volume);
    vec2 stretch = ray_box(volume.origin, volume.direction, volume.low, volume.high);
    ray_enter[0] = 0.0;
    ray_leave[0] = min(stretch.y, distance);
    float transmittance = 1.0;
    if (ray_leave[0] > 0.0) {
        transmittance = march(March(0.0, ray_leave[0], 1.0, 1e-4)).transmittance;
    }
    imageStore(direct, cell, vec4(transmittance));
}
