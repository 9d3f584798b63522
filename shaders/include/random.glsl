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
