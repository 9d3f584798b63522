#pragma once
#include <array>
#include <cstdint>

/// Random numbers from integers alone: the same bits in C++ and in GLSL, on every machine. Jarzynski and Olano, "Hash
/// Functions for GPU Rendering", Journal of Computer Graphics Techniques 9(3), 2020.
namespace bruma {

/// PCG as a hash of one word.
constexpr std::uint32_t pcg(std::uint32_t v) {
    const std::uint32_t state = v * 747796405U + 2891336453U;
    const std::uint32_t word = ((state >> ((state >> 28U) + 4U)) ^ state) * 277803737U;
    return (word >> 22U) ^ word;
}

/// Three words from three. The order of the three additions matters: each reads what the one before wrote.
constexpr std::array<std::uint32_t, 3> pcg3d(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    x = x * 1664525U + 1013904223U;
    y = y * 1664525U + 1013904223U;
    z = z * 1664525U + 1013904223U;
    x += y * z;
    y += z * x;
    z += x * y;
    x ^= x >> 16U;
    y ^= y >> 16U;
    z ^= z >> 16U;
    x += y * z;
    y += z * x;
    z += x * y;
    return {x, y, z};
}

/// A word as a number in [0, 1), from its upper 24 bits: exact in float and double alike.
constexpr double unit_interval(std::uint32_t word) {
    return double(word >> 8U) * 0x1p-24;
}

/// Index of a cell on a lattice that repeats after `period` cells; negative indices too.
constexpr std::uint32_t wrapped_cell(int index, int period) {
    const int rest = index % period;
    return std::uint32_t(rest < 0 ? rest + period : rest);
}

/// Hash of a cell of a lattice that repeats with `period` cells (at most 65535) along each axis; each stream (below
/// 65536) is a lattice of its own.
constexpr std::array<std::uint32_t, 3> cell_hash(int i, int j, int k, int period, std::uint32_t stream) {
    return pcg3d(wrapped_cell(i, period), wrapped_cell(j, period), wrapped_cell(k, period) + (stream << 16U));
}

}  // namespace bruma
