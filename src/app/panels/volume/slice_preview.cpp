#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>

#include "app/panels/volume/layout_dialog.h"
#include "base/error.h"
#include "io/volume/raw_layout.h"

namespace bruma::app {
namespace {

constexpr int longest_edge = 320;  ///< samples that a preview shows along an edge

/// One sample in the machine's byte order; not finite ones become 0.
double sample_at(const char* bytes, scene::VoxelType type, bool swap) {
    char own[4];
    const std::size_t count = scene::bytes_per_voxel(type);
    std::copy_n(bytes, count, own);
    if (swap) {
        std::reverse(own, own + count);
    }
    const auto as = [&]<class T>(T value) {
        std::memcpy(&value, own, sizeof value);
        return double(value);
    };
    switch (type) {
        case scene::VoxelType::int8:
            return as(std::int8_t());
        case scene::VoxelType::uint16:
            return as(std::uint16_t());
        case scene::VoxelType::int16:
            return as(std::int16_t());
        case scene::VoxelType::float32: {
            const double value = as(0.0F);
            return std::isfinite(value) ? value : 0.0;
        }
        default:
            return as(std::uint8_t());
    }
}

}  // namespace

SlicePreview read_middle_slice(const std::string& file, const io::RawProposal& layout) {
    io::check_size(layout.size, file);
    const auto bytes = std::int64_t(scene::bytes_per_voxel(layout.type));
    const std::int64_t row_bytes = layout.size.x * bytes;
    const std::int64_t start = layout.offset + std::int64_t(layout.size.z / 2) * layout.size.y * row_bytes;
    const int skip = (std::max(layout.size.x, layout.size.y) + longest_edge - 1) / longest_edge;
    const bool swap = (layout.endian == scene::Endian::big) != (std::endian::native == std::endian::big);

    SlicePreview preview;
    preview.size = {(layout.size.x + skip - 1) / skip, (layout.size.y + skip - 1) / skip};
    std::ifstream stream(file, std::ios::binary);
    std::vector<char> row(static_cast<std::size_t>(row_bytes));
    std::vector<double> values;
    for (int y = 0; y < layout.size.y; y += skip) {
        stream.seekg(start + y * row_bytes);
        if (!stream.read(row.data(), row_bytes)) {
            throw InputError(
                fmt::format("{}: ends before row {} of the middle slice of {}; choose less or another type", file, y,
                            io::layout_words(layout.size, layout.type)));
        }
        for (int x = 0; x < layout.size.x; x += skip) {
            values.push_back(sample_at(&row[std::size_t(x * bytes)], layout.type, swap));
        }
    }
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double width = *high > *low ? *high - *low : 1.0;
    for (const double value : values) {
        preview.grey.push_back(std::uint8_t(std::lround(255.0 * (value - *low) / width)));
    }
    return preview;
}

}  // namespace bruma::app
