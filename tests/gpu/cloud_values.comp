#version 450 core
// Looks up include/cloud_field.glsl and include/cloud_intervals.glsl at points that a test gives.
layout(local_size_x = 64) in;
#include "include/cloud_field.glsl"
#include "include/cloud_intervals.glsl"

layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };
layout(std430, binding = 1) writeonly buffer Values { vec4 values[]; };
uniform int what; // 0: density, coverage, shape, density without detail; 1: intervals of points' (altitude, climb, low, high)
uniform float planet_radius;

void main()
{
    uint n = gl_GlobalInvocationID.x;
    if (n >= uint(points.length())) {
        return;
    }
    vec4 p = points[n];
    if (what == 1) {
        values[n] = shell_intervals(planet_radius, p.x, p.y, p.z, p.w);
        return;
    }
    CloudColumn column = cloud_column(p.xyz);
    values[n] = vec4(cloud_density(p.xyz), column.coverage, cloud_shape(column), cloud_density_without_detail(p.xyz));
}
