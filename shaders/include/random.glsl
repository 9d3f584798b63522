// Random numbers are integer hashes: the same inputs give the same picture, on every machine.

// PCG as a hash (Jarzynski and Olano 2020, "Hash Functions for GPU Rendering").
uint hash_pcg(uint v)
{
    uint state = v * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// Uniform in [0, 1) from pixel, frame and dimension.
float random_unit(uvec2 pixel, uint frame, uint dimension)
{
    uint h = hash_pcg(pixel.x + hash_pcg(pixel.y + hash_pcg(frame + hash_pcg(dimension))));
    return float(h >> 8) * (1.0 / 16777216.0);
}

// The same quality in four dimensions at once: one hash for four numbers ("pcg4d" of the same article).
uvec4 hash_pcg4d(uvec4 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> 16u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v;
}

// Four numbers, uniform in [0, 1), from pixel, frame and a block of four dimensions.
vec4 random_units(uvec2 pixel, uint frame, uint block)
{
    return vec4(hash_pcg4d(uvec4(pixel, frame, block)) >> 8u) * (1.0 / 16777216.0);
}
