#version 450 core
// Optical depth from each node of a grid up to the highest cloud, column by column from above. The grid covers one tile
// of the weather map; its lowest nodes lie on the lower altitude of the clouds, its highest on the upper one.
layout(local_size_x = 8, local_size_y = 8) in;
#include "clouds/cloud_field.glsl"

layout(r16f, binding = 0) writeonly uniform image3D depth_up;
uniform vec2 band;        // altitudes, m
uniform float extinction; // 1/m

void main()
{
    ivec3 size = imageSize(depth_up);
    ivec2 column = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(column, size.xy))) {
        return;
    }
    vec2 place = (vec2(column) + 0.5) / vec2(size.xy) / layer.scales.x;
    float slice = (band.y - band.x) / float(size.z - 1);
    float depth = 0.0;
    imageStore(depth_up, ivec3(column, size.z - 1), vec4(0.0));
    for (int k = size.z - 2; k >= 0; --k) {
        float altitude = band.x + (float(k) + 0.5) * slice;
        depth += extinction * cloud_density(vec3(place.x, altitude, place.y)) * slice;
        imageStore(depth_up, ivec3(column, k), vec4(min(depth, 6e4)));
    }
}
