#version 450 core
// Looks up clouds/cloud_field.glsl at points (x, altitude, z) that a test gives: density, coverage, shape, density without
// detail. INTERVALS: instead the intervals of rays (altitude, climb, lower and upper altitude of the layer).
layout(local_size_x = 64) in;
#ifdef INTERVALS
#include "clouds/cloud_intervals.glsl"
uniform float planet_radius;
#else
#include "clouds/cloud_field.glsl"
#endif

layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };
layout(std430, binding = 1) writeonly buffer Values { vec4 values[]; };

void main()
{
    uint n = gl_GlobalInvocationID.x;
    if (n >= uint(points.length())) {
        return;
    }
    vec4 p = points[n];
#ifdef INTERVALS
    values[n] = shell_intervals(planet_radius, p.x, p.y, p.z, p.w);
#else
    CloudColumn column = cloud_column(p.xyz);
    values[n] = vec4(cloud_density(p.xyz), column.coverage, cloud_shape(column), cloud_density_without_detail(p.xyz));
#endif
}
