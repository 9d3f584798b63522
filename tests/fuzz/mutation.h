#pragma once
#include <cstdint>
#include <span>
#include <string>

namespace bruma::fuzz {

/// Random numbers from a seed, the same on every machine (SplitMix64: Steele, Lea, Flood 2014).
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next() {
        std::uint64_t z = state_ += 0x9E3779B97F4A7C15U;
        z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9U;
        z = (z ^ z >> 27) * 0x94D049BB133111EBU;
        return z ^ z >> 31;
    }
    /// 0 to `count` - 1; 0 when there is none.
    std::size_t below(std::size_t count) { return count == 0 ? 0 : std::size_t(next() % count); }

  private:
    std::uint64_t state_;
};

/// Longest input: what readers do with large files is their own tests' matter, and these shall be fast.
constexpr std::size_t most_input_bytes = 64 << 10;

/// A sound input with one to six changes: bits, bytes, numbers (binary and decimal) at their extremes, pieces cut off,
/// left out, doubled, swapped or taken from `other`, and words of `dictionary`.
std::string mutated(std::string input, const std::string& other, std::span<const std::string> dictionary,
                    Random& random);

}  // namespace bruma::fuzz
