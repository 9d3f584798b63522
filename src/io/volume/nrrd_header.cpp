#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/error.h"
#include "io/input_file.h"
#include "io/volume/raw_layout.h"
#include "io/volume/volume_header_text.h"

/// NRRD headers, after the format's definition (teem.sourceforge.net/nrrd/format.html): lines of 'field: value' up to
/// an empty one, behind which the samples stand unless 'data file' names another file.
namespace bruma::io {
namespace {

using scene::VoxelType;

struct NrrdType {
    VoxelType type;
    std::array<std::string_view, 6> words;
};
constexpr std::array<NrrdType, 5> nrrd_types{
    {{VoxelType::int8, {"signed char", "int8", "int8_t"}},
     {VoxelType::uint8, {"uchar", "unsigned char", "uint8", "uint8_t"}},
     {VoxelType::int16, {"short", "short int", "signed short", "signed short int", "int16", "int16_t"}},
     {VoxelType::uint16, {"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}},
     {VoxelType::float32, {"float"}}}};

using NrrdFields = std::map<std::string, std::string>;

std::string value_of(const NrrdFields& fields, const std::string& key) {
    const auto found = fields.find(key);
    return found == fields.end() ? std::string() : found->second;
}

/// The fields by their names in lower case; `text` is left with what stands behind the header.
NrrdFields read_nrrd_fields(const std::filesystem::path& path, std::string_view& text) {
    NrrdFields fields;
    cut_line(text);
    while (!text.empty()) {
        const std::string_view line = cut_line(text);
        if (line.empty()) {
            break;
        }
        const std::size_t mark = line.find(": ");
        if (line.starts_with('#') || mark == std::string_view::npos) {
            continue;  // a comment, or 'key:=value', which says nothing of the layout
        }
        fields[lower_case(trimmed(line.substr(0, mark)))] = trimmed(line.substr(mark + 2));
    }
    for (const char* needed : {"type", "sizes", "encoding"}) {
        if (value_of(fields, needed).empty()) {
            throw InputError(fmt::format("{}: an NRRD header without '{}'; is it whole?", path.string(), needed));
        }
    }
    return fields;
}

VoxelType nrrd_type(const NrrdFields& fields, const std::filesystem::path& path) {
    const std::string word = lower_case(value_of(fields, "type"));
    for (const NrrdType& entry : nrrd_types) {
        for (const std::string_view known : entry.words) {
            if (!known.empty() && known == word) {
                return entry.type;
            }
        }
    }
    throw InputError(
        fmt::format("{}: samples of type '{}' are not read; convert them, as in: unu convert -t float -i {} -o "
                    "OUT.nrrd",
                    path.string(), word, path.filename().string()));
}

void refuse_unreadable_nrrd(const NrrdFields& fields, const std::filesystem::path& path) {
    if (const std::string encoding = lower_case(value_of(fields, "encoding")); encoding != "raw") {
        throw InputError(
            fmt::format("{}: its samples are encoded as {}, and only raw is read; write them plainly, as in: unu "
                        "save -f nrrd -e raw -i {} -o OUT.nrrd, or in 3D Slicer without the tick at Compress",
                        path.string(), encoding, path.filename().string()));
    }
    for (const char* key : {"line skip", "lineskip"}) {
        if (const std::string skip = value_of(fields, key); !skip.empty() && skip != "0") {
            throw InputError(fmt::format("{}: '{}' is not read; say the bytes in 'byte skip'", path.string(), key));
        }
    }
}

/// Millimetres of a unit as NRRD files write it; 1 for what is not known, since files without a unit are in mm.
double unit_mm(std::string unit) {
    std::erase(unit, '"');
    unit = lower_case(unit);
    return unit == "m"                                                                ? 1e3
           : unit == "cm"                                                             ? 10.0
           : unit == "um" || unit == "microns" || unit == "micron" || unit == "\xb5m" ? 1e-3
           : unit == "nm"                                                             ? 1e-6
                                                                                      : 1.0;
}

/// Length of the step between samples along each dimension that has one; 0 where nothing tells.
std::vector<double> spacing_mm(const NrrdFields& fields, const std::filesystem::path& path, bool& slanted) {
    std::vector<double> steps;
    const std::string space = value_of(fields, "space directions");
    for (std::string_view left = space; !(left = trimmed(left)).empty();) {
        const std::size_t end = left.starts_with('(') ? left.find(')') : left.find_first_of(" \t");
        std::string part(left.substr(0, end));
        left.remove_prefix(std::min(left.size(), end == std::string_view::npos ? end : end + 1));
        if (!part.starts_with('(')) {
            steps.push_back(0.0);  // 'none': a dimension that is not of space
            continue;
        }
        std::replace(part.begin(), part.end(), ',', ' ');
        double squares = 0.0;
        int parts = 0;
        for (const double component : numbers_of(std::string_view(part).substr(1), path, "space directions")) {
            squares += component * component;
            parts += component != 0.0 ? 1 : 0;
            slanted = slanted || component < 0.0;
        }
        slanted = slanted || parts > 1;
        steps.push_back(std::sqrt(squares));
    }
    const std::vector<std::string> units = split_words(value_of(fields, space.empty() ? "units" : "space units"));
    if (space.empty()) {
        std::string words = value_of(fields, "spacings");
        for (const std::string& word : split_words(words)) {
            const bool told = lower_case(word) != "nan";
            steps.push_back(told ? std::abs(numbers_of(word, path, "spacings").at(0)) : 0.0);
        }
    }
    for (std::size_t n = 0; n < steps.size() && !units.empty(); ++n) {
        steps[n] *= unit_mm(units[std::min(n, units.size() - 1)]);
    }
    return steps;
}

}  // namespace

VolumeHeader parse_nrrd(const std::filesystem::path& path, std::string_view text) {
    std::string_view behind = text;
    const NrrdFields fields = read_nrrd_fields(path, behind);
    refuse_unreadable_nrrd(fields, path);
    VolumeHeader header{path, path, {}, {}};
    std::vector<std::size_t> kept;
    header.says.size = three_edges(sizes_of(value_of(fields, "sizes"), path, "sizes"), path, kept);
    check_size(*header.says.size, path.string());
    header.says.type = nrrd_type(fields, path);
    if (const std::string endian = lower_case(value_of(fields, "endian")); endian == "big" || endian == "little") {
        header.says.endian = endian == "big" ? scene::Endian::big : scene::Endian::little;
    }
    bool slanted = false;
    const std::vector<double> steps = spacing_mm(fields, path, slanted);
    for (std::size_t n = 0; n < kept.size(); ++n) {
        if (kept[n] < steps.size() && steps[kept[n]] > 0.0) {
            header.says.spacing = header.says.spacing.value_or(glm::dvec3(1e-3));
            (*header.says.spacing)[int(n)] = 1e-3 * steps[kept[n]];
        }
    }
    if (slanted) {
        header.unused.emplace_back("space directions");
    }

    const std::string file =
        fields.contains("data file") ? value_of(fields, "data file") : value_of(fields, "datafile");
    if (file.starts_with("LIST") || file.find('%') != std::string::npos) {
        throw InputError(fmt::format(
            "{}: its slices lie in one file each ({}), which is not read; join them, as in: cat SLICES > OUT.raw, and "
            "name OUT.raw in 'data file'",
            path.string(), file));
    }
    header.data_file = file.empty() ? path : data_path(path, file);
    const std::string skip =
        fields.contains("byte skip") ? value_of(fields, "byte skip") : value_of(fields, "byteskip");
    const std::vector<double> skipped = numbers_of(skip, path, "byte skip");
    const double bytes = skipped.empty() || !(std::abs(skipped[0]) < 1e15) ? 0.0 : skipped[0];
    header.says.offset = (file.empty() ? std::int64_t(text.size() - behind.size()) : 0) + std::int64_t(bytes);
    if (bytes < 0.0) {
        // The samples are the file's last bytes.
        const glm::ivec3 size = *header.says.size;
        header.says.offset =
            InputFile(header.data_file).size() -
            std::int64_t(size.x) * size.y * size.z * std::int64_t(scene::bytes_per_voxel(*header.says.type));
    }
    return header;
}

}  // namespace bruma::io
