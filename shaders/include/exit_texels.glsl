// The texels of the maps around a translucent body that see it, and which of them the picture looks up.

layout(std430, binding = 5) readonly buffer Texels { uint texels[]; };  // x + (y + map * edge) * edge
layout(std430, binding = 6) buffer PassesOf { uint passes_of[]; };      // that each of them has had
uniform uint texel_count;
uniform uint edge;               // of a map, texels
uniform int all_are_read;
uniform usampler2DArray reads;   // 1 in the middle of each 3 x 3 that is looked up

ivec3 texel_at(uint n)
{
    uint number = texels[n];
    return ivec3(number % edge, (number / edge) % edge, number / (edge * edge));
}

bool is_middle_of_read(ivec3 at) { return all_are_read != 0 || texelFetch(reads, at, 0).x != 0u; }

bool is_near_read(ivec3 at)
{
    if (all_are_read != 0) {
        return true;
    }
    uint found = 0u;
    for (int n = 0; n < 9; ++n) {
        ivec2 beside = clamp(at.xy + ivec2(n % 3, n / 3) - 1, ivec2(0), ivec2(edge) - 1);
        found |= texelFetch(reads, ivec3(beside, at.z), 0).x;
    }
    return found != 0u;
}
