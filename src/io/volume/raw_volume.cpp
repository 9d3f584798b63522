#include "io/volume/raw_volume.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <new>
#include <optional>

#include "base/error.h"
#include "base/memory.h"
#include "io/input_file.h"
#include "io/mesh/ascii_triangles.h"
#include "io/volume/raw_name.h"
#include "io/volume/raw_proposals.h"

namespace bruma::io {
namespace {

void refuse_triangles(const std::filesystem::path& path) {
    const auto triangles = read_ascii_triangles(path);
    if (!triangles) {
        return;
    }
    throw InputError(fmt::format(
        "{}: this is a triangle mesh of {} triangles in text form, not a volume; open it by its name, or give "
        "its node the kind 'mesh'",
        path.string(), triangles->count));
}

void swap_bytes(std::span<std::byte> bytes, std::size_t width) {
    for (std::size_t n = 0; n + width <= bytes.size(); n += width) {
        std::reverse(bytes.begin() + std::ptrdiff_t(n), bytes.begin() + std::ptrdiff_t(n + width));
    }
}

std::vector<std::byte> allocate(std::uint64_t bytes, const std::filesystem::path& path) {
    constexpr std::uint64_t left_for_others = 64 << 20;
    const std::uint64_t available = available_memory();
    const auto refuse = [&]() {
        return MachineError(
            fmt::format("{}: needs {} MiB of memory, but {} MiB are free; close other programs or show a "
                        "smaller volume",
                        path.string(), bytes >> 20, available >> 20));
    };
    if (available < left_for_others || bytes > available - left_for_others) {
        throw refuse();
    }
    try {
        return std::vector<std::byte>(bytes);
    } catch (const std::bad_alloc&) {
        throw refuse();
    }
}

void read_samples(const std::filesystem::path& path, const RawLayout& layout, std::span<std::byte> into,
                  const Progress& progress) {
    constexpr std::size_t chunk_bytes = 8 << 20;  // a multiple of every sample's width
    const InputFile file(path);
    const std::size_t width = scene::bytes_per_voxel(layout.type);
    const bool file_is_little = layout.endian == scene::Endian::little;
    const bool swap = width > 1 && file_is_little != (std::endian::native == std::endian::little);
    for (std::size_t done = 0; done < into.size();) {
        const auto chunk = into.subspan(done, std::min(chunk_bytes, into.size() - done));
        file.read(layout.offset + std::int64_t(done), chunk);
        if (swap) {
            swap_bytes(chunk, width);
        }
        done += chunk.size();
        if (progress) {
            progress(double(done) / double(into.size()), "reading " + path.filename().string());
        }
    }
}

/// A sentence when nobody said the byte order and the other one makes the data much smoother; else nothing.
std::optional<std::string> byte_order_remark(const std::filesystem::path& path, const RawLayout& layout) {
    constexpr double clearly_better =
        0.5;  // a factor of 1.65 in roughness: the two orders differ by far more if at all
    if (scene::bytes_per_voxel(layout.type) == 1 || layout.endian_from != "default") {
        return std::nullopt;
    }
    scene::VolumeSource known;
    known.size = layout.size;
    known.type = layout.type;
    known.offset = layout.offset;
    const std::vector<RawProposal> orders = propose_layouts(path, known, 2);
    const bool other_first = !orders.empty() && orders[0].endian != layout.endian;
    if (!other_first || (orders.size() == 2 && orders[1].score - orders[0].score < clearly_better)) {
        return std::nullopt;
    }
    return fmt::format(
        "{}: read as little endian because nothing tells the byte order, but big endian makes it much "
        "smoother; try --endian big",
        path.string());
}

/// A sentence on what the file does not hold; nothing when it holds everything.
std::optional<std::string> absence_remark(const std::filesystem::path& path, const scene::VolumeGrid& grid) {
    if (grid.absent.empty()) {
        return std::nullopt;
    }
    std::string what;
    for (const scene::FillValue& fill : grid.fills) {
        what += fmt::format("{}{} hold the fill value {:.9g}", what.empty() ? "" : " and ", fill.count, fill.value);
    }
    if (grid.nonfinite > 0) {
        what += fmt::format("{}{} are not finite", what.empty() ? "" : " and ", grid.nonfinite);
    }
    return fmt::format("{}: of {} samples {}; they are left out of range and histogram and drawn as nothing{}",
                       path.string(), grid.voxel_count(), what,
                       grid.present_count() == 0 ? ", so that nothing of this volume is left" : "");
}

}  // namespace

LoadedVolume load_raw_volume(const std::filesystem::path& path, const scene::VolumeSource& hints,
                             const Progress& progress) {
    refuse_triangles(path);
    LoadedVolume loaded;
    loaded.layout = find_raw_layout(path, hints);
    const RawLayout& layout = loaded.layout;

    auto grid = std::make_shared<scene::VolumeGrid>();
    grid->name = make_grid_name(path);
    grid->size = layout.size;
    grid->type = layout.type;
    grid->spacing = layout.spacing_m;
    grid->voxels = allocate(std::uint64_t(layout.bytes_needed() - layout.offset), path);
    read_samples(layout.file, layout, grid->voxels, progress);

    scene::finish_grid(*grid, scene::Fills::left_out);
    if (auto remark = byte_order_remark(layout.file, layout)) {
        loaded.remarks.push_back(std::move(*remark));
    }
    for (const std::string& field : layout.unused) {
        loaded.remarks.push_back(fmt::format("{}: its {} is not used; rotate the node instead", path.string(), field));
    }
    if (auto remark = absence_remark(path, *grid)) {
        loaded.remarks.push_back(std::move(*remark));
    }
    if (grid->smallest == grid->largest && grid->present_count() > 0) {
        loaded.remarks.push_back(
            fmt::format("{}: every {}sample is {}; a constant volume shows no structure and is drawn as a faint haze",
                        path.string(), grid->absent.empty() ? "" : "other ", grid->smallest));
    }
    loaded.grid = std::move(grid);
    return loaded;
}

}  // namespace bruma::io
