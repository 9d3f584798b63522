#include "io/raw_layout.h"

#include <fmt/core.h>

#include <optional>
#include <vector>

#include "base/error.h"
#include "io/input_file.h"
#include "io/known_volumes.h"
#include "io/raw_name.h"
#include "io/raw_proposals.h"
#include "io/raw_sidecar.h"

namespace bruma::io {
namespace {

constexpr std::int64_t most_voxels = std::int64_t(1) << 40;
constexpr std::int64_t largest_offset = std::int64_t(1) << 60;
constexpr const char* nobody = "default";

struct Teller {
    const scene::VolumeSource* says;
    std::string name;
};

/// The first teller that says a part wins; `from` becomes its name.
template <class Part, class Value>
bool take(const std::vector<Teller>& tellers, Part part, Value& value, std::string& from) {
    for (const Teller& teller : tellers) {
        if (const auto& said = teller.says->*part) {
            value = *said;
            from = teller.name;
            return true;
        }
    }
    from = nobody;
    return false;
}

void check_rest(const RawLayout& layout, const std::filesystem::path& path) {
    if (layout.offset < 0 || layout.offset > largest_offset) {
        throw InputError(fmt::format("{}: offset {} ({}) is outside of any file; it must be 0 or a little more",
                                     path.string(), layout.offset, layout.offset_from));
    }
    for (int axis = 0; axis < 3; ++axis) {
        const double spacing = layout.spacing_m[axis];
        if (!(spacing > 0.0 && spacing < 1e12)) {
            throw InputError(fmt::format("{}: spacing {} m along {} ({}) is no length; it must be above 0",
                                         path.string(), spacing, "xyz"[axis], layout.spacing_from));
        }
    }
}

[[noreturn]] void throw_unknown(const std::filesystem::path& path, const RawLayoutParts& known) {
    const char* missing = known.has_size   ? "type of its samples"
                          : known.has_type ? "size"
                                           : "size and type of its samples";
    const char* options = known.has_size   ? "--type TYPE"
                          : known.has_type ? "--dims NXxNYxNZ"
                                           : "--dims NXxNYxNZ and --type TYPE";
    std::string likely;
    for (const RawProposal& proposal : propose_layouts(path, known.as_hints(), 3)) {
        likely += (likely.empty() ? "" : ", or ") + as_options(proposal);
    }
    throw InputError(fmt::format(
        "{}: nothing tells the {}; say {}{}", path.string(), missing, options,
        likely.empty() ? std::string(" (no usual layout fits its length)") : fmt::format("; likely are {}", likely)));
}

void check_length(const RawLayout& layout, const std::filesystem::path& path) {
    const std::int64_t found = InputFile(path).size();
    if (found == layout.bytes_needed()) {
        return;
    }
    const std::string header = layout.offset > 0 ? fmt::format("an offset of {} and ", layout.offset) : "";
    throw InputError(fmt::format("{}: {} bytes, but {}{} needs {}; are --dims{} --type{} wrong?", path.string(), found,
                                 header, layout_words(layout.size, layout.type), layout.bytes_needed(),
                                 layout.offset > 0 ? "," : " or", layout.offset > 0 ? " or --offset" : ""));
}

}  // namespace

std::int64_t RawLayout::bytes_needed() const {
    return offset + std::int64_t(size.x) * size.y * size.z * std::int64_t(scene::bytes_per_voxel(type));
}

std::string layout_words(glm::ivec3 size, scene::VoxelType type) {
    return fmt::format("{} x {} x {} x {}", size.x, size.y, size.z,
                       scene::enum_words<scene::VoxelType>()[std::size_t(type)]);
}

void check_size(glm::ivec3 size, const std::string& where) {
    for (int axis = 0; axis < 3; ++axis) {
        if (size[axis] < 1) {
            throw InputError(fmt::format("{}: size {} x {} x {} has no samples along {}; every part must be at least 1",
                                         where, size.x, size.y, size.z, "xyz"[axis]));
        }
    }
    // The first product fits in 62 bits, and the division cannot overflow.
    if (std::int64_t(size.x) * size.y > most_voxels / size.z) {
        throw InputError(fmt::format("{}: size {} x {} x {} has more than 2^40 samples; is it mistyped?", where, size.x,
                                     size.y, size.z));
    }
}

scene::VolumeSource RawLayoutParts::as_hints() const {
    scene::VolumeSource hints;
    hints.size = has_size ? std::optional(layout.size) : std::nullopt;
    hints.type = has_type ? std::optional(layout.type) : std::nullopt;
    hints.endian = layout.endian_from == nobody ? std::nullopt : std::optional(layout.endian);
    hints.offset = layout.offset_from == nobody ? std::nullopt : std::optional(layout.offset);
    return hints;
}

RawLayoutParts known_layout_parts(const std::filesystem::path& path, const scene::VolumeSource& hints) {
    const InputFile readable(path);  // missing, empty and unreadable files are told before anything about their layout
    using Source = scene::VolumeSource;
    RawLayoutParts known;
    RawLayout& layout = known.layout;
    const std::optional<Sidecar> sidecar = read_sidecar(path);
    std::vector<Teller> tellers{{&hints, "options"}};
    if (sidecar) {
        tellers.push_back({&sidecar->says, "sidecar " + sidecar->path.filename().string()});
    }
    Source name;
    try {
        name = layout_from_name(path);
        tellers.push_back({&name, "file name"});
    } catch (const InputError&) {
        // A name that contradicts itself does no harm once size and type are known from elsewhere.
        if (!take(tellers, &Source::size, layout.size, layout.size_from) ||
            !take(tellers, &Source::type, layout.type, layout.type_from)) {
            throw;
        }
    }
    known.has_size = take(tellers, &Source::size, layout.size, layout.size_from);
    known.has_type = take(tellers, &Source::type, layout.type, layout.type_from);
    take(tellers, &Source::endian, layout.endian, layout.endian_from);
    take(tellers, &Source::offset, layout.offset, layout.offset_from);
    const std::optional<KnownVolume> published = known.has_size ? known_volume(path, layout.size) : std::nullopt;
    Source says_published;
    if (published) {
        says_published.spacing = published->spacing_m;
        tellers.push_back({&says_published, "known volume " + published->name});
    }
    take(tellers, &Source::spacing, layout.spacing_m, layout.spacing_from);
    layout.rotation_from = nobody;
    if (sidecar && sidecar->rotation_deg) {
        layout.rotation_deg = *sidecar->rotation_deg;
        layout.rotation_from = tellers[1].name;
    } else if (published) {
        layout.rotation_deg = published->rotation_deg;
        layout.rotation_from = tellers.back().name;
    }
    if (known.has_size) {
        check_size(layout.size, path.string());
    }
    check_rest(layout, path);
    return known;
}

RawLayout find_raw_layout(const std::filesystem::path& path, const scene::VolumeSource& hints) {
    const RawLayoutParts known = known_layout_parts(path, hints);
    if (!known.complete()) {
        throw_unknown(path, known);
    }
    check_length(known.layout, path);
    return known.layout;
}

}  // namespace bruma::io
