#version 450 core
// Extinction of a volume on a light grid: means over each cell of the transfer function at the data, times the grid's
// longest edge. ALBEDO: also the mean albedo, weighted by the extinction.

layout(local_size_x = 8, local_size_y = 4, local_size_z = 4) in;

#ifdef HOLES
#include "volume/absent.glsl"
#endif

uniform sampler3D voxels;
uniform sampler1D optics_table;  // x: sigma, yzw: sigma * albedo
uniform usampler3D emptiness;
uniform vec2 optics_from_voxel;
uniform float depth_per_sigma;  // optical depth over the grid's longest edge per unit of sigma in the table
uniform ivec3 cells;
uniform vec3 texture_low;       // of cell (0, 0, 0)
uniform vec3 texture_per_cell;
uniform vec3 macrocells_from_texture;
uniform int samples;  // along each edge of a cell

layout(binding = 0, r32f) uniform writeonly restrict image3D extinction;
#ifdef ALBEDO
layout(binding = 1, rgba16f) uniform writeonly restrict image3D albedo;
#endif

void main()
{
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(cell, cells))) {
        return;
    }
    vec4 sum = vec4(0.0);
    vec3 corner = texture_low + vec3(cell) * texture_per_cell;
    // A cell whose two far corners lie in the same empty neighbourhood holds nothing.
    ivec3 last = textureSize(emptiness, 0) - 1;
    ivec3 a = clamp(ivec3(floor(corner * macrocells_from_texture)), ivec3(0), last);
    ivec3 b = clamp(ivec3(floor((corner + texture_per_cell) * macrocells_from_texture)), ivec3(0), last);
    ivec3 apart = b - a;
    if (texelFetch(emptiness, a, 0).x <= uint(max(apart.x, max(apart.y, apart.z)))) {
        for (int k = 0; k < samples; ++k) {
            for (int j = 0; j < samples; ++j) {
                for (int i = 0; i < samples; ++i) {
                    vec3 x = corner + (vec3(i, j, k) + 0.5) / float(samples) * texture_per_cell;
                    float texel = textureLod(voxels, x, 0.0).x;
#ifdef HOLES
                    if (is_absent(texel)) {
                        continue;
                    }
#endif
                    sum += textureLod(optics_table, texel * optics_from_voxel.x + optics_from_voxel.y, 0.0);
                }
            }
        }
    }
    imageStore(extinction, cell, vec4(sum.x * depth_per_sigma / float(samples * samples * samples)));
#ifdef ALBEDO
    imageStore(albedo, cell, vec4(sum.x > 0.0 ? clamp(sum.yzw / sum.x, 0.0, 1.0) : vec3(0.0), 0.0));
#endif
}
