#pragma once
#include <cstdint>

namespace bruma::reference {

/// Random numbers as a hash of (seed, path, count): any path can be walked alone, in any order, on any thread, and
/// gives the same numbers. The hash is the finaliser of SplitMix64 (Steele, Lea and Flood 2014), which walks a Weyl
/// sequence.
class CounterRandom {
  public:
    CounterRandom(std::uint64_t seed, std::uint64_t path)
        : key_(mixed(mixed(seed + weyl) ^ (path * 0xD1342543DE82EF95U))) {}

    /// Uniform in [0, 1), with 53 bits.
    double next() { return double(mixed(key_ + weyl * ++count_) >> 11) * 0x1p-53; }

  private:
    static constexpr std::uint64_t weyl = 0x9E3779B97F4A7C15U;
    static constexpr std::uint64_t mixed(std::uint64_t z) {
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
        return z ^ (z >> 31);
    }
    std::uint64_t key_;
    std::uint64_t count_ = 0;
};

}  // namespace bruma::reference
