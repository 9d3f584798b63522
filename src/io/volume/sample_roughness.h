#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <unordered_map>
#include <vector>

#include "scene/volume/volume.h"

namespace bruma::io {

/// A file mapped for reading, so that scattered samples of a file of any length cost only the pages they touch.
class MappedFile {
  public:
    explicit MappedFile(const std::filesystem::path& path);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;
    std::span<const std::byte> bytes() const { return bytes_; }

  private:
    std::span<const std::byte> bytes_;
};

/// One way to read the bytes of a file as numbers.
struct Reading {
    scene::VoxelType type;
    scene::Endian endian;
    std::int64_t offset;  ///< bytes before the first sample
    std::int64_t count;   ///< samples
};

/// How much samples differ from others `lag` further on, measured at fixed places spread over the file.
class SampleRoughness {
  public:
    /// Some tens of samples are read at each of the `places`.
    SampleRoughness(std::span<const std::byte> bytes, const Reading& reading, int places);

    /// Mean |difference| of samples `lag` apart over that of samples far apart: near 0 for smooth data, near 1 for
    /// unrelated ones; 0 for constant data.
    double at_lag(std::int64_t lag);

    /// How far `lag` is a valley of the roughness: the natural logarithm of the roughness there over the smaller one at
    /// lag - step and lag + step. Negative for the length of a row or a slice, positive for lengths on the way to one;
    /// 0 where the file is too short to tell.
    double valley(std::int64_t lag, std::int64_t step);

    /// False when many samples are no numbers that a measurement or a simulation yields (float32 only).
    bool plausible() const { return plausible_; }
    /// True when signed numbers of these bytes are others than unsigned ones.
    bool has_top_bits() const { return has_top_bits_; }

  private:
    std::span<const std::byte> bytes_;
    Reading reading_;
    std::vector<std::int64_t> starts_;  ///< first samples of the runs
    std::vector<float> values_;         ///< of all runs, one after the other
    double spread_ = 0.0;
    bool plausible_ = true;
    bool has_top_bits_ = true;
    std::unordered_map<std::int64_t, double> known_;
};

}  // namespace bruma::io
