#version 450 core
// Which texels of the maps around a translucent body come next: those that the picture looks up and that have had as many
// passes as was said. One invocation looks at a word of 32.
#include "subsurface/exit_texels.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 7) writeonly buffer Chosen { uint chosen[]; };  // addresses, in any order
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
    uint word = gl_GlobalInvocationID.x;
    uint first = first_address(word);
    uint near = word < word_count ? near_read(word) : 0u;
    uint wanted = 0u;
    uint least = ~0u;
    for (uint left = near; left != 0u; left &= left - 1u) {
        uint bit = uint(findLSB(left));
        uint passes = passes_of[first + bit];
        least = min(least, passes);
        wanted |= passes == wanted_passes ? 1u << bit : 0u;
    }
    uint place = 0u;
    if (near != 0u) {
        atomicAdd(group_read, uint(bitCount(near)));
        atomicMin(group_least, least);
        place = atomicAdd(group_chosen, uint(bitCount(wanted)));
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u && group_read > 0u) {
        atomicAdd(read_texels, group_read);
        atomicMin(least_passes, group_least);
        group_first = atomicAdd(chosen_texels, group_chosen);
    }
    barrier();
    place += group_first;
    for (uint left = wanted; left != 0u; left &= left - 1u) {
        chosen[place++] = first + uint(findLSB(left));
    }
}
