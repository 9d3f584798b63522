#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <vector>

#include "scene/volume.h"

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

/// How much samples differ from their neighbours, measured at fixed places spread over the file.
class SampleRoughness {
  public:
    SampleRoughness(std::span<const std::byte> bytes, const Reading& reading);

    /// Mean |difference| of samples `lag` apart over that of samples far apart: near 0 for smooth data, near 1 for
    /// unrelated ones; 0 for constant data.
    double at_lag(std::int64_t lag);
    /// False when many samples are no numbers that a measurement or a simulation yields (float32 only).
    bool plausible() const { return plausible_; }

  private:
    double value(std::int64_t index) const;

    std::span<const std::byte> bytes_;
    Reading reading_;
    std::vector<std::int64_t> places_;
    std::vector<double> values_;
    double spread_ = 0.0;
    bool plausible_ = true;
    std::map<std::int64_t, double> known_;
};

}  // namespace bruma::io
