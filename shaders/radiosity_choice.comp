#version 450 core
// Which texels of the maps around a translucent body come next: those that the picture looks up and that have had as many
// passes as was said.
#include "include/exit_texels.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 7) writeonly buffer Chosen { uint chosen[]; };  // numbers in texels, in any order
layout(std430, binding = 3) buffer Totals {
    uint read_texels;
    uint least_passes;
    uint chosen_texels;
};
uniform uint wanted_passes;

shared uint group_read;
shared uint group_least;
shared uint group_chosen;
shared uint group_first;

void main()
{
    if (gl_LocalInvocationIndex == 0u) {
        group_read = 0u;
        group_least = ~0u;
        group_chosen = 0u;
    }
    barrier();
    uint n = gl_GlobalInvocationID.x;
    bool wanted = false;
    uint place = 0u;
    if (n < texel_count && is_near_read(texel_at(n))) {
        uint passes = passes_of[n];
        atomicAdd(group_read, 1u);
        atomicMin(group_least, passes);
        wanted = passes == wanted_passes;
        if (wanted) {
            place = atomicAdd(group_chosen, 1u);
        }
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u && group_read > 0u) {
        atomicAdd(read_texels, group_read);
        atomicMin(least_passes, group_least);
        group_first = atomicAdd(chosen_texels, group_chosen);
    }
    barrier();
    if (wanted) {
        chosen[group_first + place] = n;
    }
}
