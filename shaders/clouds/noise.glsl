// Tileable noise of clouds over p in [0,1)^3, from integer hashes: the same numbers on every driver up to the rounding of
// square roots. `cells` is the number of lattice cells along an edge of the tile, `stream` chooses one of many lattices.

// Jarzynski and Olano 2020, "Hash Functions for GPU Rendering". The three additions are sequential.
uvec3 hash_pcg3d(uvec3 v)
{
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

// Hash of a cell at most one lattice away from the tile.
uvec3 hash_cell(ivec3 cell, int cells, uint stream)
{
    uvec3 wrapped = uvec3((cell + cells) % cells);
    return hash_pcg3d(uvec3(wrapped.xy, wrapped.z + (stream << 16u)));
}

// The sixteen gradients of Perlin 2002, "Improving Noise", times the offset.
float gradient_dot(uint gradient, vec3 offset)
{
    if (gradient >= 12u) {
        gradient = gradient == 12u ? 0u : gradient == 13u ? 1u : gradient == 14u ? 9u : 11u;
    }
    float a = gradient < 8u ? offset.x : offset.y;
    float b = gradient < 4u ? offset.y : offset.z;
    return ((gradient & 1u) == 0u ? a : -a) + ((gradient & 2u) == 0u ? b : -b);
}

float perlin(vec3 p, int cells, uint stream)
{
    vec3 at = p * float(cells);
    vec3 low = floor(at);
    ivec3 cell = ivec3(low);
    vec3 t = at - low;
    float corner[8];
    for (int n = 0; n < 8; ++n) {
        ivec3 d = ivec3(n & 1, n >> 1 & 1, n >> 2);
        corner[n] = gradient_dot(hash_cell(cell + d, cells, stream).x >> 28u, t - vec3(d));
    }
    vec3 q = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    vec4 x = vec4(corner[0], corner[2], corner[4], corner[6]);
    x += q.x * (vec4(corner[1], corner[3], corner[5], corner[7]) - x);
    vec2 y = x.xz + q.y * (x.yw - x.xz);
    return y.x + q.z * (y.y - y.x);
}

// Octaves of half the amplitude and twice the cells, to [0,1].
float perlin_octaves(vec3 p, int cells, int octaves, uint stream)
{
    float sum = 0.0;
    float amplitudes = 0.0;
    float amplitude = 1.0;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += amplitude * perlin(p, cells << octave, stream + uint(octave));
        amplitudes += amplitude;
        amplitude *= 0.5;
    }
    return clamp(0.5 + 0.5 * sum / amplitudes, 0.0, 1.0);
}

// One minus the distance to the nearest feature point in cells, at least 0. 27 cells suffice: what lies beyond is at
// least one cell away. Offsets are relative to the cell, which is what makes floats exact to some 1e-7.
float worley(vec3 p, int cells, uint stream)
{
    vec3 at = p * float(cells);
    vec3 low = floor(at);
    ivec3 cell = ivec3(low);
    vec3 t = at - low;
    float nearest = 1.0;
    for (int z = -1; z <= 1; ++z) {
        for (int y = -1; y <= 1; ++y) {
            for (int x = -1; x <= 1; ++x) {
                ivec3 d = ivec3(x, y, z);
                vec3 feature = vec3(hash_cell(cell + d, cells, stream) >> 8u) * (1.0 / 16777216.0);
                vec3 apart = vec3(d) + feature - t;
                nearest = min(nearest, dot(apart, apart));
            }
        }
    }
    return 1.0 - sqrt(nearest);
}

float worley_octaves3(vec3 p, int cells, uint stream)
{
    return 0.625 * worley(p, cells, stream) + 0.25 * worley(p, 2 * cells, stream + 1u) +
           0.125 * worley(p, 4 * cells, stream + 2u);
}

float worley_octaves2(vec3 p, int cells, uint stream)
{
    return 0.75 * worley(p, cells, stream) + 0.25 * worley(p, 2 * cells, stream + 1u);
}

// Shape of clouds: Perlin noise lifted by Worley noise (Schneider 2015) in R, Worley noise at rising frequencies else.
vec4 shape_noise(vec3 p)
{
    float lower = worley_octaves3(p, 8, 16u);
    return vec4(lower + perlin_octaves(p, 8, 3, 0u) * (1.0 - lower), worley_octaves3(p, 8, 32u),
                worley_octaves3(p, 16, 48u), worley_octaves2(p, 32, 64u));
}

// Detail that erodes them.
vec3 detail_noise(vec3 p)
{
    return vec3(worley_octaves3(p, 2, 80u), worley_octaves3(p, 4, 96u), worley_octaves2(p, 8, 112u));
}

// One channel of each: the octaves of the detail are linear in it, the base of the shape is not.
float packed_detail(vec3 detail)
{
    return dot(detail, vec3(0.625, 0.25, 0.125));
}

float packed_shape(vec4 shape)
{
    float octaves = dot(shape.gba, vec3(0.625, 0.25, 0.125));
    return (shape.r - (octaves - 1.0)) / (2.0 - octaves);
}
