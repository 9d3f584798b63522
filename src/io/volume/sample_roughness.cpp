#include "io/volume/sample_roughness.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "io/input_file.h"

namespace bruma::io {
namespace {

constexpr std::int64_t run_length = 32;

/// Integer hash by Chris Wellons ("lowbias32", 2018), for places without a pattern that data could share.
std::uint32_t hash(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352dU;
    x ^= x >> 15;
    x *= 0x846ca68bU;
    return x ^ (x >> 16);
}

double mean_far_difference(const std::vector<float>& values) {
    double sum = 0.0;
    for (std::size_t n = 0; n < values.size(); ++n) {
        // Places are in order, so some thousands further on is another part of the file.
        sum += std::abs(values[n] - values[(n + 7919 * (1 + n % 13)) % values.size()]);
    }
    return values.empty() ? 0.0 : sum / double(values.size());
}

/// The same bytes read as signed instead of unsigned numbers, or the other way round; floats stay.
std::vector<float> with_other_sign(std::vector<float> values, scene::VoxelType type) {
    if (type == scene::VoxelType::float32) {
        return values;
    }
    const float full = scene::bytes_per_voxel(type) == 1 ? 256.0F : 65536.0F;
    const bool is_signed = type == scene::VoxelType::int8 || type == scene::VoxelType::int16;
    for (float& v : values) {
        v += is_signed ? (v < 0.0F ? full : 0.0F) : (v >= 0.5F * full ? -full : 0.0F);
    }
    return values;
}

/// Decodes a run of samples; the loops know type and byte order, as they are most of the work.
template <class Raw, class Number, bool swap>
void decode_run(const std::byte* at, std::span<float> into) {
    for (float& value : into) {
        Raw raw{};
        std::memcpy(&raw, at, sizeof raw);
        if constexpr (swap && sizeof(Raw) == 2) {
            raw = __builtin_bswap16(raw);
        } else if constexpr (swap && sizeof(Raw) == 4) {
            raw = __builtin_bswap32(raw);
        }
        value = float(std::bit_cast<Number>(raw));
        at += sizeof raw;
    }
}

template <class Raw, class Number>
void decode_run(const std::byte* at, bool swap, std::span<float> into) {
    swap ? decode_run<Raw, Number, true>(at, into) : decode_run<Raw, Number, false>(at, into);
}

void decode(std::span<const std::byte> bytes, const Reading& reading, std::int64_t first, std::span<float> into) {
    const bool swap = (reading.endian == scene::Endian::little) != (std::endian::native == std::endian::little);
    const std::byte* at = bytes.data() + reading.offset + first * std::int64_t(scene::bytes_per_voxel(reading.type));
    switch (reading.type) {
        case scene::VoxelType::int8:
            return decode_run<std::uint8_t, std::int8_t>(at, false, into);
        case scene::VoxelType::uint16:
            return decode_run<std::uint16_t, std::uint16_t>(at, swap, into);
        case scene::VoxelType::int16:
            return decode_run<std::uint16_t, std::int16_t>(at, swap, into);
        case scene::VoxelType::float32:
            return decode_run<std::uint32_t, float>(at, swap, into);
        default:
            return decode_run<std::uint8_t, std::uint8_t>(at, false, into);
    }
}

/// Widest range of magnitudes that physical fields in any common unit have.
bool is_physical(float v) {
    return v == 0.0F || (std::abs(v) > 1e-15F && std::abs(v) < 1e15F);
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

SampleRoughness::SampleRoughness(std::span<const std::byte> bytes, const Reading& reading, int places)
    : bytes_(bytes), reading_(reading) {
    if (reading.count < 2) {
        return;
    }
    const std::int64_t length = std::min(run_length, reading.count);
    for (std::int64_t run = 0; run < places; ++run) {
        const double random = hash(std::uint32_t(run) + 1U) * 0x1p-32;
        starts_.push_back(std::int64_t((double(run) + random) / double(places) * double(reading.count - length + 1)));
    }
    values_.resize(starts_.size() * std::size_t(length));
    std::int64_t strange = 0;
    for (std::size_t run = 0; run < starts_.size(); ++run) {
        decode(bytes_, reading_, starts_[run],
               std::span(values_).subspan(run * std::size_t(length), std::size_t(length)));
    }
    for (float& v : values_) {
        strange += is_physical(v) ? 0 : 1;
        v = is_physical(v) ? v : 0.0F;
    }
    plausible_ = strange * 200 <= std::int64_t(values_.size());
    const float half = reading.type == scene::VoxelType::uint8 ? 128.0F : 32768.0F;
    has_top_bits_ = std::any_of(values_.begin(), values_.end(), [&](float v) { return v >= half || v < 0.0F; });
    // Numbers read with the wrong sign wrap round, which adds to the steps and to the spread alike: both readings are
    // measured against the smaller spread, so that the steps tell.
    spread_ = std::min(mean_far_difference(values_), mean_far_difference(with_other_sign(values_, reading.type)));
}

double SampleRoughness::at_lag(std::int64_t lag) {
    if (spread_ == 0.0 || lag >= reading_.count) {
        return 0.0;
    }
    if (const auto known = known_.find(lag); known != known_.end()) {
        return known->second;
    }
    const std::size_t length = values_.size() / starts_.size();
    std::array<float, run_length> others{};
    double sum = 0.0;
    std::size_t used = 0;
    for (std::size_t run = 0; run < starts_.size(); ++run) {
        // Towards the end the neighbours on the other side, so that all lags are compared at the same places.
        std::int64_t first = starts_[run] + lag;
        first = first + std::int64_t(length) <= reading_.count ? first : starts_[run] - lag;
        if (first < 0) {
            continue;
        }
        decode(bytes_, reading_, first, std::span(others).first(length));
        for (std::size_t n = 0; n < length; ++n) {
            const float v = others[n];
            sum += is_physical(v) ? std::abs(double(v) - values_[run * length + n]) : spread_;
        }
        used += length;
    }
    const double ratio = used == 0 ? 1.0 : sum / double(used) / spread_;
    known_.emplace(lag, ratio);
    return ratio;
}

double SampleRoughness::valley(std::int64_t lag, std::int64_t step) {
    constexpr double floor = 1e-3;  // keeps constant data from a logarithm of zero
    if (step < 1 || step >= lag || lag + step >= reading_.count - reading_.count / 4) {
        return 0.0;
    }
    return std::log((at_lag(lag) + floor) / (std::min(at_lag(lag - step), at_lag(lag + step)) + floor));
}

}  // namespace bruma::io
