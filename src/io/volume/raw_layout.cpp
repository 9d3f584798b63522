#include "io/volume/raw_layout.h"

#include <fmt/core.h>

#include <optional>
#include <vector>

#include "base/error.h"
#include "io/foreign_format.h"
#include "io/input_file.h"
#include "io/volume/known_volumes.h"
#include "io/volume/raw_name.h"
#include "io/volume/raw_proposals.h"
#include "io/volume/raw_sidecar.h"
#include "io/volume/volume_header.h"

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
    constexpr std::int64_t longest_left = 65536;
    const std::int64_t found = InputFile(layout.file).size();
    const std::int64_t missing = layout.bytes_needed() - found;
    if (missing == 0) {
        return;
    }
    if (layout.file == path) {
        refuse_foreign_format(path);
    }
    const std::string header = layout.offset > 0 ? fmt::format("an offset of {} and ", layout.offset) : "";
    std::string next = layout.offset > 0 ? "are --dims, --type or --offset wrong?" : "are --dims or --type wrong?";
    if (layout.size_from != "options" && layout.size_from != "file name") {
        next = fmt::format("is the {} about another file?", layout.size_from);
    } else if (missing < 0 && -missing <= longest_left && layout.offset_from == nobody) {
        next += fmt::format(" If {} bytes stand before the samples, say --offset {}", -missing, -missing);
    }
    throw InputError(fmt::format("{}: {} bytes, but {}{} needs {}; {}", layout.file.string(), found, header,
                                 layout_words(layout.size, layout.type), layout.bytes_needed(), next));
}

/// The header that a file is, or that names it. Throws InputError when a header names a file that is not there.
std::optional<VolumeHeader> header_of(const std::filesystem::path& path) {
    if (!is_volume_header(path)) {
        return header_beside(path);
    }
    VolumeHeader header = read_volume_header(path);
    std::error_code ignored;
    if (!std::filesystem::exists(header.data_file, ignored)) {
        throw InputError(fmt::format("{}: its samples should be in {}, which is not there; was it moved or renamed?",
                                     path.string(), header.data_file.string()));
    }
    return header;
}

/// Everybody who says something of a file's layout, the first with the last word.
struct Tellers {
    std::vector<Teller> list;
    std::optional<Sidecar> sidecar;
    std::optional<VolumeHeader> header;
    scene::VolumeSource name;
};

/// Asks header and name, whose faults do no harm once size and type are known from elsewhere.
void ask(Tellers& tellers, const std::filesystem::path& path, RawLayout& layout) {
    using Source = scene::VolumeSource;
    std::optional<InputError> fault;
    try {
        tellers.header = header_of(path);
    } catch (const InputError& error) {
        fault = error;
    }
    if (tellers.header) {
        tellers.list.push_back({&tellers.header->says, "header " + tellers.header->path.filename().string()});
    }
    try {
        tellers.name = layout_from_name(path);
        tellers.list.push_back({&tellers.name, "file name"});
    } catch (const InputError& error) {
        fault = fault ? fault : error;
    }
    if (fault && !(take(tellers.list, &Source::size, layout.size, layout.size_from) &&
                   take(tellers.list, &Source::type, layout.type, layout.type_from))) {
        throw InputError(*fault);
    }
}

/// What a published volume of this name and size says; empty for others.
std::optional<KnownVolume> published_volume(const RawLayoutParts& known) {
    const auto size = known.has_size ? std::optional(known.layout.size) : std::nullopt;
    const auto type = known.has_type ? std::optional(known.layout.type) : std::nullopt;
    return known_volume(known.layout.file, size, type, InputFile(known.layout.file).size() - known.layout.offset);
}

RawLayoutParts gather(const std::filesystem::path& path, const scene::VolumeSource& hints) {
    using Source = scene::VolumeSource;
    RawLayoutParts known;
    RawLayout& layout = known.layout;
    Tellers tellers;
    tellers.list.push_back({&hints, "options"});
    tellers.sidecar = read_sidecar(path);
    const std::string sidecar_name =
        tellers.sidecar ? "sidecar " + tellers.sidecar->path.filename().string() : std::string();
    if (tellers.sidecar) {
        tellers.list.push_back({&tellers.sidecar->says, sidecar_name});
    }
    ask(tellers, path, layout);
    layout.file = tellers.header && tellers.header->path == path ? tellers.header->data_file : path;
    known.has_size = take(tellers.list, &Source::size, layout.size, layout.size_from);
    known.has_type = take(tellers.list, &Source::type, layout.type, layout.type_from);
    take(tellers.list, &Source::endian, layout.endian, layout.endian_from);
    take(tellers.list, &Source::offset, layout.offset, layout.offset_from);
    if (known.has_size) {
        check_size(layout.size, path.string());
    }
    const std::optional<KnownVolume> published = published_volume(known);
    Source says_published;
    if (published) {
        says_published.spacing = published->spacing_m;
        says_published.size = published->size;
        const std::int64_t samples = std::int64_t(published->size.x) * published->size.y * published->size.z;
        const std::int64_t width = scene::bytes_per_voxel(published->type);
        if (samples * width == InputFile(layout.file).size() - layout.offset) {
            says_published.type = published->type;
        }
        tellers.list.push_back({&says_published, "known volume " + published->name});
        known.has_size = take(tellers.list, &Source::size, layout.size, layout.size_from);
        known.has_type = take(tellers.list, &Source::type, layout.type, layout.type_from);
    }
    take(tellers.list, &Source::spacing, layout.spacing_m, layout.spacing_from);
    layout.rotation_from = nobody;
    if (tellers.sidecar && tellers.sidecar->rotation_deg) {
        layout.rotation_deg = *tellers.sidecar->rotation_deg;
        layout.rotation_from = sidecar_name;
    } else if (published && published->rotation_deg) {
        layout.rotation_deg = *published->rotation_deg;
        layout.rotation_from = tellers.list.back().name;
    }
    if (tellers.header) {
        layout.unused = tellers.header->unused;
    }
    check_rest(layout, path);
    return known;
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
    RawLayoutParts known = gather(path, hints);
    if (!known.complete()) {
        refuse_foreign_format(path);
    }
    return known;
}

scene::VolumeSource hints_among_others(const std::filesystem::path& path, const scene::VolumeSource& hints,
                                       std::vector<std::string>& overruled) {
    scene::VolumeSource left = hints;
    RawLayout own;
    try {
        own = gather(path, {}).layout;
    } catch (const InputError&) {
        return left;  // what its name or header contradicts is told when the file is opened
    }
    const auto keep_own = [&](auto part, const auto& value, const std::string& from, const char* option) {
        const bool said = from != nobody && !from.starts_with("known volume");
        if (said && left.*part) {
            if (*(left.*part) != value) {
                overruled.emplace_back(option);
            }
            (left.*part).reset();
        }
    };
    using Source = scene::VolumeSource;
    keep_own(&Source::size, own.size, own.size_from, "--dims");
    keep_own(&Source::type, own.type, own.type_from, "--type");
    keep_own(&Source::spacing, own.spacing_m, own.spacing_from, "--spacing");
    keep_own(&Source::endian, own.endian, own.endian_from, "--endian");
    keep_own(&Source::offset, own.offset, own.offset_from, "--offset");
    return left;
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
