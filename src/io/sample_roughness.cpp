#include "io/sample_roughness.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "io/input_file.h"

namespace bruma::io {
namespace {

constexpr std::int64_t run_count = 512;
constexpr std::int64_t run_length = 48;

/// Integer hash by Chris Wellons ("lowbias32", 2018), for places without a pattern that data could share.
std::uint32_t hash(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352dU;
    x ^= x >> 15;
    x *= 0x846ca68bU;
    return x ^ (x >> 16);
}

double mean_far_difference(const std::vector<double>& values) {
    double sum = 0.0;
    for (std::size_t n = 0; n < values.size(); ++n) {
        // Places are in order, so some thousands further on is another part of the file.
        sum += std::abs(values[n] - values[(n + 7919 * (1 + n % 13)) % values.size()]);
    }
    return values.empty() ? 0.0 : sum / double(values.size());
}

/// The same bytes read as signed instead of unsigned numbers, or the other way round; floats stay.
std::vector<double> with_other_sign(std::vector<double> values, scene::VoxelType type) {
    if (type == scene::VoxelType::float32) {
        return values;
    }
    const double full = scene::bytes_per_voxel(type) == 1 ? 256.0 : 65536.0;
    const bool is_signed = type == scene::VoxelType::int8 || type == scene::VoxelType::int16;
    for (double& v : values) {
        v += is_signed ? (v < 0.0 ? full : 0.0) : (v >= 0.5 * full ? -full : 0.0);
    }
    return values;
}

template <class Raw, class Number>
Number decode(const std::byte* at, bool swap) {
    Raw raw{};
    std::memcpy(&raw, at, sizeof raw);
    if (swap) {
        if constexpr (sizeof(Raw) == 2) {
            raw = __builtin_bswap16(raw);
        } else {
            raw = __builtin_bswap32(raw);
        }
    }
    return std::bit_cast<Number>(raw);
}

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& path) {
    const InputFile checked(path);
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    void* start = descriptor < 0 ? MAP_FAILED
                                 : ::mmap(nullptr, std::size_t(checked.size()), PROT_READ, MAP_PRIVATE, descriptor, 0);
    const int cause = errno;
    if (descriptor >= 0) {
        ::close(descriptor);
    }
    if (start == MAP_FAILED) {
        throw InputError(fmt::format("{}: cannot be mapped for reading ({})", path.string(), std::strerror(cause)));
    }
    bytes_ = {static_cast<const std::byte*>(start), std::size_t(checked.size())};
}

MappedFile::~MappedFile() {
    ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

SampleRoughness::SampleRoughness(std::span<const std::byte> bytes, const Reading& reading)
    : bytes_(bytes), reading_(reading) {
    if (reading.count < 2) {
        return;
    }
    for (std::int64_t run = 0; run < run_count; ++run) {
        const double random = hash(std::uint32_t(run) + 1U) * 0x1p-32;
        const auto start = std::int64_t((double(run) + random) / double(run_count) * double(reading.count));
        for (std::int64_t i = start; i < std::min(start + run_length, reading.count); ++i) {
            places_.push_back(i);
        }
    }
    std::int64_t strange = 0;
    for (const std::int64_t place : places_) {
        const double v = value(place);
        // Widest range of magnitudes that physical fields in any common unit have.
        const bool fine = v == 0.0 || (std::abs(v) > 1e-15 && std::abs(v) < 1e15);
        strange += fine ? 0 : 1;
        values_.push_back(fine ? v : 0.0);
    }
    plausible_ = strange * 200 <= std::int64_t(values_.size());
    // Numbers read with the wrong sign wrap round, which adds to the steps and to the spread alike: both readings are
    // measured against the smaller spread, so that the steps tell.
    spread_ = std::min(mean_far_difference(values_), mean_far_difference(with_other_sign(values_, reading.type)));
}

double SampleRoughness::value(std::int64_t index) const {
    const bool little = reading_.endian == scene::Endian::little;
    const bool swap = little != (std::endian::native == std::endian::little);
    const std::byte* at = bytes_.data() + reading_.offset + index * std::int64_t(scene::bytes_per_voxel(reading_.type));
    switch (reading_.type) {
        case scene::VoxelType::int8:
            return std::bit_cast<std::int8_t>(*at);
        case scene::VoxelType::uint16:
            return decode<std::uint16_t, std::uint16_t>(at, swap);
        case scene::VoxelType::int16:
            return decode<std::uint16_t, std::int16_t>(at, swap);
        case scene::VoxelType::float32:
            return decode<std::uint32_t, float>(at, swap);
        default:
            return std::to_integer<int>(*at);
    }
}

double SampleRoughness::at_lag(std::int64_t lag) {
    if (spread_ == 0.0 || lag >= reading_.count) {
        return 0.0;
    }
    if (const auto known = known_.find(lag); known != known_.end()) {
        return known->second;
    }
    double sum = 0.0;
    std::size_t used = 0;
    for (std::size_t n = 0; n < places_.size(); ++n) {
        // Towards the end the neighbour on the other side, so that all lags are compared at the same places.
        const std::int64_t other = places_[n] + lag < reading_.count ? places_[n] + lag : places_[n] - lag;
        if (other < 0) {
            continue;
        }
        const double v = value(other);
        sum += std::isfinite(v) && std::abs(v) < 1e15 ? std::abs(v - values_[n]) : spread_;
        ++used;
    }
    const double ratio = used == 0 ? 1.0 : sum / double(used) / spread_;
    known_.emplace(lag, ratio);
    return ratio;
}

}  // namespace bruma::io
