#version 450 core
// Optical depths from each node towards the sun, up and down, in columns that lean towards the sun: along a column the
// light only travels, so that one sum serves all its nodes and nothing is spread sideways.
layout(local_size_x = 8, local_size_y = 8) in;
#include "clouds/cloud_field.glsl"

layout(rgba16f, binding = 0) writeonly uniform image3D depths;
uniform sampler3D depth_up;
uniform vec2 band;         // altitudes, m
uniform float extinction;  // 1/m
uniform vec2 lean;         // x and z per metre of altitude
uniform float lengthening; // metres of the way per metre of altitude
uniform int parts;         // samples between two nodes

void main()
{
    ivec3 size = imageSize(depths);
    ivec2 column = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(column, size.xy))) {
        return;
    }
    vec2 place = (vec2(column) + 0.5) / vec2(size.xy) / layer.scales.x;
    float slice = (band.y - band.x) / float(size.z - 1);
    float rise = slice / float(parts);
    float up_slices = float(textureSize(depth_up, 0).z);
    float depth = 0.0;
    for (int k = size.z - 1; k >= 0; --k) {
        vec2 at = (place + lean * (float(k) * slice)) * layer.scales.x;
        float share = float(k) / float(size.z - 1);
        float up = textureLod(depth_up, vec3(at, (share * (up_slices - 1.0) + 0.5) / up_slices), 0.0).x;
        float whole = textureLod(depth_up, vec3(at, 0.5 / up_slices), 0.0).x;
        imageStore(depths, ivec3(column, k), vec4(min(depth, 6e4), up, max(0.0, whole - up), 0.0));
        for (int n = 0; n < parts; ++n) {
            float above = float(k) * slice - (float(n) + 0.5) * rise;
            vec2 foot = place + lean * above;
            depth += k > 0 ? extinction * cloud_density(vec3(foot.x, band.x + above, foot.y)) * rise * lengthening : 0.0;
        }
    }
}
