#pragma once
#include <array>
#include <cstdint>

namespace bruma::reference {

/// Philox4x32-10 (Salmon, Moraes, Dror, Shaw, Parallel Random Numbers: As Easy as 1, 2, 3, SC 2011): 128 bits that
/// depend on counter and key alone, so that no thread needs to know what another one drew.
constexpr std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter,
                                                  std::array<std::uint32_t, 2> key) {
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t a = std::uint64_t(0xD2511F53U) * counter[0];
        const std::uint64_t b = std::uint64_t(0xCD9E8D57U) * counter[2];
        counter = {std::uint32_t(b >> 32) ^ counter[1] ^ key[0], std::uint32_t(b),
                   std::uint32_t(a >> 32) ^ counter[3] ^ key[1], std::uint32_t(a)};
        key = {key[0] + 0x9E3779B9U, key[1] + 0xBB67AE85U};
    }
    return counter;
}

/// The random numbers of one sample of one pixel, in the order in which they are drawn.
class RandomStream {
  public:
    RandomStream(std::uint64_t seed, std::uint32_t pixel, std::uint64_t sample)
        : key_{std::uint32_t(seed), std::uint32_t(seed >> 32)},
          counter_{0, pixel, std::uint32_t(sample), std::uint32_t(sample >> 32)} {}

    /// Uniform in [0, 1), a multiple of 2^-53.
    double uniform() {
        if (left_ == 0) {
            words_ = philox4x32(counter_, key_);
            ++counter_[0];
            left_ = 2;
        }
        --left_;
        const std::uint64_t bits = std::uint64_t(words_[2 * left_]) << 32 | words_[2 * left_ + 1];
        return double(bits >> 11) * 0x1p-53;
    }

  private:
    std::array<std::uint32_t, 2> key_;
    std::array<std::uint32_t, 4> counter_;  ///< [0] counts what was drawn
    std::array<std::uint32_t, 4> words_{};
    std::size_t left_ = 0;  ///< numbers in `words_` that were not handed out
};

}  // namespace bruma::reference
