#include "io/volume/foreign_volume.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace bruma::io {
namespace {

/// Reads numbers of a header in one byte order.
struct Head {
    std::string_view bytes;
    bool swap = false;

    template <class T>
    T at(std::size_t offset) const {
        std::array<char, sizeof(T)> raw{};
        if (offset + sizeof(T) <= bytes.size()) {
            std::memcpy(raw.data(), bytes.data() + offset, sizeof(T));
        }
        if (swap) {
            std::reverse(raw.begin(), raw.end());
        }
        return std::bit_cast<T>(raw);
    }
    bool is_big() const { return swap == (std::endian::native == std::endian::little); }
};

struct Described {
    std::string name;
    std::array<std::int64_t, 3> size{};
    std::array<double, 3> spacing_mm{};
    const char* type = nullptr;  ///< null for one that is not read
    bool big = false;
    std::int64_t offset = 0;
    const char* conversion = "";  ///< the way out for what options cannot say
};

std::int64_t width_of(std::string_view type) {
    return type == "float32" ? 4 : type.ends_with("16") ? 2 : 1;
}

ForeignFormat with_options(const Described& volume, std::int64_t length) {
    const auto [x, y, z] = volume.size;
    const bool sane = x > 0 && y > 0 && z > 0 && x < (1 << 30) && y < (1 << 30) && z < (1 << 30);
    if (volume.type == nullptr || !sane || double(x) * double(y) * double(z) > 1e12 ||
        volume.offset + x * y * z * width_of(volume.type) != length) {
        return {volume.name, volume.conversion};
    }
    std::string options = fmt::format("--dims {}x{}x{} --type {}", x, y, z, volume.type);
    options += volume.big && width_of(volume.type) > 1 ? " --endian big" : "";
    const auto& mm = volume.spacing_mm;
    if (mm[0] > 0.0 && mm[1] > 0.0 && mm[2] > 0.0) {
        options += fmt::format(" --spacing {:.7g},{:.7g},{:.7g}", mm[0], mm[1], mm[2]);
    }
    return {volume.name, fmt::format("its samples are plain, so say: {} --offset {}", options, volume.offset)};
}

/// NIfTI-1 and Analyze 7.5 (nifti.nimh.nih.gov/pub/dist/src/niftilib/nifti1.h).
std::optional<Described> nifti(std::string_view bytes) {
    constexpr std::int32_t header_size = 348;
    Head head{bytes};
    head.swap = head.at<std::int32_t>(0) != header_size;
    if (bytes.size() < std::size_t(header_size) || head.at<std::int32_t>(0) != header_size) {
        const std::string_view magic = bytes.substr(std::min<std::size_t>(4, bytes.size()), 3);
        constexpr const char* convert = "convert it, as in: c3d IN.nii -o OUT.mhd, which is read";
        return magic == "n+2" || magic == "ni2"
                   ? std::optional(Described{.name = "a NIfTI-2 volume", .conversion = convert})
                   : std::nullopt;
    }
    Described volume;
    const std::string_view magic = bytes.substr(344, 3);
    volume.name = magic == "n+1"   ? "a NIfTI-1 volume"
                  : magic == "ni1" ? "the header of a NIfTI-1 pair, whose samples are in the .img beside it"
                                   : "the header of an Analyze 7.5 pair, whose samples are in the .img beside it";
    volume.conversion = "convert it, as in: c3d IN.nii -o OUT.mhd, which is read";
    for (std::size_t n = 0; n < 3; ++n) {
        const auto edge = head.at<std::int16_t>(42 + 2 * n);
        volume.size[n] = std::int16_t(n) < head.at<std::int16_t>(40) ? edge : 1;
        volume.spacing_mm[n] = std::abs(double(head.at<float>(80 + 4 * n)));
    }
    switch (head.at<std::int16_t>(70)) {
        case 2:
            volume.type = "uint8";
            break;
        case 4:
            volume.type = "int16";
            break;
        case 16:
            volume.type = "float32";
            break;
        case 256:
            volume.type = "int8";
            break;
        case 512:
            volume.type = "uint16";
            break;
        default:
            break;
    }
    volume.big = head.is_big();
    const float offset = head.at<float>(108);
    volume.offset = offset >= 0.0F && offset < 1e9F ? std::int64_t(offset) : 0;
    return volume;
}

/// NumPy's .npy: a Python dictionary with 'descr', 'fortran_order' and 'shape' behind ten or twelve bytes.
std::optional<Described> numpy(std::string_view bytes) {
    if (!bytes.starts_with("\x93NUMPY") || bytes.size() < 12) {
        return std::nullopt;
    }
    const Head head{bytes, std::endian::native == std::endian::big};
    const bool short_length = bytes[6] == 1;
    Described volume{.name = "a NumPy array"};
    volume.conversion = "in Python, write it with array.astype('float32').tofile('OUT.raw')";
    volume.offset =
        short_length ? 10 + std::int64_t(head.at<std::uint16_t>(8)) : 12 + std::int64_t(head.at<std::uint32_t>(8));
    const auto after = [&](std::string_view key) {
        const std::size_t at = bytes.find(key);
        return at == std::string_view::npos ? std::string_view() : bytes.substr(at + key.size());
    };
    const std::string_view type = after("'descr': '").substr(0, 3);
    volume.big = type.starts_with('>');
    const std::string_view kind = type.size() == 3 ? type.substr(1) : type;
    volume.type = kind == "u1"   ? "uint8"
                  : kind == "i1" ? "int8"
                  : kind == "u2" ? "uint16"
                  : kind == "i2" ? "int16"
                  : kind == "f4" ? "float32"
                                 : nullptr;
    std::vector<std::int64_t> shape(1, 0);
    for (const char c : after("'shape': (")) {
        if (c == ')') {
            break;
        }
        if (c == ',') {
            shape.push_back(0);
        } else if (c >= '0' && c <= '9' && shape.back() < (1 << 30)) {
            shape.back() = shape.back() * 10 + (c - '0');
        }
    }
    // 'shape' names the slowest dimension first, unless the order is Fortran's.
    const bool first_runs_fastest = after("'fortran_order': ").starts_with("True");
    if (shape.size() == 3) {
        volume.size =
            first_runs_fastest ? std::array{shape[0], shape[1], shape[2]} : std::array{shape[2], shape[1], shape[0]};
    }
    return volume;
}

/// MRC 2014 (ccpem.ac.uk/mrc_format): 1024 bytes and an extension, then samples.
std::optional<Described> mrc(std::string_view bytes) {
    constexpr std::int64_t header_size = 1024;
    if (bytes.size() < std::size_t(header_size) || bytes.substr(208, 4) != "MAP ") {
        return std::nullopt;
    }
    Head head{bytes};
    const bool file_is_big = bytes[212] == '\x11';
    head.swap = file_is_big == (std::endian::native == std::endian::little);
    Described volume{.name = "an MRC map", .big = file_is_big};
    volume.conversion = "convert it, as in: mrc2tif or Fiji, to a raw file";
    for (std::size_t n = 0; n < 3; ++n) {
        volume.size[n] = head.at<std::int32_t>(4 * n);
    }
    const auto mode = head.at<std::int32_t>(12);
    volume.type = mode == 0 ? "int8" : mode == 1 ? "int16" : mode == 2 ? "float32" : mode == 6 ? "uint16" : nullptr;
    volume.offset = header_size + head.at<std::int32_t>(92);
    return volume;
}

}  // namespace

std::optional<ForeignFormat> described_volume(std::string_view head, std::int64_t length) {
    for (const auto& find : {nifti, numpy, mrc}) {
        if (const auto volume = find(head)) {
            return with_options(*volume, length);
        }
    }
    return std::nullopt;
}

}  // namespace bruma::io
