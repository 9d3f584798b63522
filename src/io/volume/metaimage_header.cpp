#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/error.h"
#include "io/input_file.h"
#include "io/volume/raw_layout.h"
#include "io/volume/volume_header_text.h"

/// MetaImage headers, after the format's description in the ITK wiki (MetaIO/Documentation): lines of 'Key = Value', of
/// which ElementDataFile is the last.
namespace bruma::io {
namespace {

using scene::VoxelType;

struct MetaType {
    std::string_view word;
    VoxelType type;
};
constexpr std::array<MetaType, 5> meta_types{{{"MET_UCHAR", VoxelType::uint8},
                                              {"MET_CHAR", VoxelType::int8},
                                              {"MET_USHORT", VoxelType::uint16},
                                              {"MET_SHORT", VoxelType::int16},
                                              {"MET_FLOAT", VoxelType::float32}}};

/// MetaFields of a header, and where its samples begin if they stand behind it.
struct MetaFields {
    const std::filesystem::path& path;
    std::map<std::string, std::string> values;
    std::int64_t end = 0;

    bool has(const std::string& key) const { return values.contains(key); }
    std::string get(const std::string& key) const { return has(key) ? values.at(key) : std::string(); }
    bool is_true(const std::string& key) const {
        const std::string value = lower_case(get(key));
        return value == "true" || value == "1";
    }
};

MetaFields read_meta_fields(const std::filesystem::path& path, std::string_view text) {
    MetaFields fields{path, {}, 0};
    std::string_view left = text;
    while (!left.empty() && !fields.has("ElementDataFile")) {
        const std::string_view line = cut_line(left);
        if (const std::size_t mark = line.find('='); mark != std::string_view::npos) {
            fields.values[std::string(trimmed(line.substr(0, mark)))] = trimmed(line.substr(mark + 1));
        }
    }
    fields.end = std::int64_t(text.size() - left.size());
    for (const char* needed : {"DimSize", "ElementType", "ElementDataFile"}) {
        if (fields.get(needed).empty()) {
            throw InputError(fmt::format("{}: a MetaImage header without {}; is it whole?", path.string(), needed));
        }
    }
    return fields;
}

VoxelType meta_type(const MetaFields& fields) {
    const std::string word = fields.get("ElementType");
    for (const MetaType& entry : meta_types) {
        if (entry.word == word) {
            return entry.type;
        }
    }
    throw InputError(
        fmt::format("{}: samples of type {} are not read; convert them to MET_UCHAR, MET_CHAR, MET_USHORT, "
                    "MET_SHORT or MET_FLOAT, as in: c3d {} -type float -o OUT.mhd",
                    fields.path.string(), word, fields.path.filename().string()));
}

void refuse_unreadable_meta(const MetaFields& fields) {
    const std::string where = fields.path.string();
    const std::string file = fields.get("ElementDataFile");
    if (fields.is_true("CompressedData")) {
        throw InputError(
            fmt::format("{}: its samples are compressed, which is not read; write them plainly, as in: c3d "
                        "{} -o OUT.mhd, or in 3D Slicer without the tick at Compress",
                        where, fields.path.filename().string()));
    }
    if (fields.has("BinaryData") && !fields.is_true("BinaryData")) {
        throw InputError(fmt::format("{}: its samples are text, which is not read; write them as BinaryData", where));
    }
    if (fields.has("ElementNumberOfChannels") && fields.get("ElementNumberOfChannels") != "1") {
        throw InputError(
            fmt::format("{}: has {} numbers a sample, but one is read; write one channel to a file of "
                        "its own",
                        where, fields.get("ElementNumberOfChannels")));
    }
    if (file.starts_with("LIST") || file.find('%') != std::string::npos) {
        throw InputError(
            fmt::format("{}: its slices lie in one file each ({}), which is not read; join them, as in: "
                        "cat SLICES > OUT.raw, and name OUT.raw in ElementDataFile",
                        where, file));
    }
}

}  // namespace

VolumeHeader parse_metaimage(const std::filesystem::path& path, std::string_view text) {
    const MetaFields fields = read_meta_fields(path, text);
    refuse_unreadable_meta(fields);
    VolumeHeader header{path, path, {}, {}};
    std::vector<std::size_t> kept;
    header.says.size = three_edges(sizes_of(fields.get("DimSize"), path, "DimSize"), path, kept);
    check_size(*header.says.size, path.string());
    header.says.type = meta_type(fields);
    const bool most_first = fields.is_true("BinaryDataByteOrderMSB") || fields.is_true("ElementByteOrderMSB");
    header.says.endian = most_first ? scene::Endian::big : scene::Endian::little;

    const char* key = fields.has("ElementSpacing") ? "ElementSpacing" : "ElementSize";
    const std::vector<double> spacing_mm = numbers_of(fields.get(key), path, key);
    if (!spacing_mm.empty()) {
        header.says.spacing = glm::dvec3(1e-3);
        for (std::size_t n = 0; n < kept.size() && kept[n] < spacing_mm.size(); ++n) {
            (*header.says.spacing)[int(n)] = 1e-3 * std::abs(spacing_mm[kept[n]]);
        }
    }
    const std::string file = fields.get("ElementDataFile");
    const bool behind = file == "LOCAL" || file == "Local";
    header.data_file = behind ? path : data_path(path, file);
    std::int64_t skip = 0;
    if (fields.has("HeaderSize")) {
        const std::vector<double> given = numbers_of(fields.get("HeaderSize"), path, "HeaderSize");
        skip = given.size() == 1 && std::abs(given[0]) < 1e15 ? std::int64_t(given[0]) : 0;
    }
    header.says.offset = behind ? fields.end : skip;
    if (skip == -1) {
        // The samples are the file's last bytes.
        const glm::ivec3 size = *header.says.size;
        const std::int64_t needed =
            std::int64_t(size.x) * size.y * size.z * std::int64_t(scene::bytes_per_voxel(*header.says.type));
        header.says.offset = InputFile(header.data_file).size() - needed;
    }
    for (const char* place : {"TransformMatrix", "Rotation", "Orientation"}) {
        const std::string turn = fields.get(place);
        if (!turn.empty() && turn != "1 0 0 0 1 0 0 0 1") {
            header.unused.emplace_back(place);
        }
    }
    return header;
}

}  // namespace bruma::io
