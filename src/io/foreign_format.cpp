#include "io/foreign_format.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "base/error.h"
#include "io/input_file.h"
#include "io/volume/foreign_volume.h"

namespace bruma::io {
namespace {

using namespace std::string_view_literals;

/// What a format begins with, and what to do with it; '{}' in a way out stands for the file's name.
struct Magic {
    std::size_t at;
    std::string_view bytes;
    const char* name;
    const char* way_out;
};

constexpr const char* by_slicer =
    "open it in 3D Slicer and save it as .nrrd, without the tick at Compress; that is read";
constexpr const char* by_paraview = "open it in ParaView and save it as a Meta Image (.mhd), which is read";
constexpr const char* by_fiji = "open it in Fiji and save it as Raw Data (File > Save As), then say --dims and --type";
constexpr const char* by_blender = "open it in Blender or MeshLab and save it as .obj, which is read";
constexpr const char* picture = "a picture is no volume or mesh; slices must be joined into one raw file, as in Fiji";
constexpr const char* unpack = "unpack it first and open what is inside";

constexpr Magic magics[] = {
    // Volumes.
    {128, "DICM"sv, "a DICOM file", by_slicer},
    {0, "# vtk DataFile"sv, "a VTK legacy file", by_paraview},
    {0, " BDV\0\0\0\0"sv, "an OpenVDB grid",
     "write its values densely, as pyopenvdb's copyToArray does, to a raw file"},
    {0, "\x89HDF\r\n\x1a\n"sv, "an HDF5 file (so are netCDF-4, MINC 2, Imaris and MATLAB 7.3)",
     "write one dataset of it plainly, as in: h5dump -d /NAME -b LE -o OUT.raw {}"},
    {0, "CDF\x01"sv, "a netCDF file", by_paraview},
    {0, "CDF\x02"sv, "a netCDF file", by_paraview},
    {0, "CDF\x05"sv, "a netCDF file", by_paraview},
    {0, "II*\0"sv, "a TIFF picture or stack", by_fiji},
    {0, "MM\0*"sv, "a TIFF picture or stack", by_fiji},
    {0, "II+\0"sv, "a BigTIFF picture or stack", by_fiji},
    {0, "MM\0+"sv, "a BigTIFF picture or stack", by_fiji},
    {0, "PVM\n"sv, "a PVM volume", "convert it with pvm2raw of the V^3 volume renderer"},
    {0, "PVM2\n"sv, "a PVM volume", "convert it with pvm2raw of the V^3 volume renderer"},
    {0, "PVM3\n"sv, "a PVM volume", "convert it with pvm2raw of the V^3 volume renderer"},
    {0, "DDS v3"sv, "a compressed PVM volume", "convert it with pvm2raw of the V^3 volume renderer"},
    {0, "SIMPLE  ="sv, "a FITS file", by_fiji},
    {0, "MATLAB 5.0"sv, "a MATLAB file", "in MATLAB, write the array with fwrite(fopen('OUT.raw', 'w'), X, class(X))"},
    {0, "# AmiraMesh"sv, "an Amira volume or mesh", "in Amira, export it as Raw Data"},
    {0, "# Avizo"sv, "an Avizo volume or mesh", "in Avizo, export it as Raw Data"},
    {0, "ZISRAWFILE"sv, "a Zeiss CZI file", by_fiji},
    {0, "mdvol"sv, "a volume of Mark Dow's .vol format", "its samples begin at byte 10000: say --offset 10000"},
    // Meshes.
    {0, "ply\n"sv, "a PLY mesh", by_blender},
    {0, "ply\r"sv, "a PLY mesh", by_blender},
    {0, "solid "sv, "an STL mesh", by_blender},
    {0, "glTF"sv, "a binary glTF scene", by_blender},
    {0, "Kaydara FBX"sv, "an FBX scene", by_blender},
    {0, "; FBX"sv, "an FBX scene", by_blender},
    {0, "#usda"sv, "a USD scene", by_blender},
    {0, "PXR-USDC"sv, "a USD scene", by_blender},
    {0, "Ogawa"sv, "an Alembic scene", by_blender},
    {0, "BLENDER"sv, "a Blender file", "open it in Blender and export it as .obj, which is read"},
    {0, "#VRML"sv, "a VRML scene", by_blender},
    {0, "ISO-10303-21"sv, "a STEP model", "open it in FreeCAD and export it as a mesh (.obj), which is read"},
    {0, "LASF"sv, "a LAS point cloud", "make a mesh of it in CloudCompare and save it as .obj"},
    // Pictures.
    {0, "\x89PNG\r\n\x1a\n"sv, "a PNG picture", picture},
    {0, "\xff\xd8\xff"sv, "a JPEG picture", picture},
    {0, "GIF8"sv, "a GIF picture", picture},
    {0, "\x76\x2f\x31\x01"sv, "an OpenEXR picture", picture},
    {0, "#?RADIANCE"sv, "a Radiance HDR picture", picture},
    {0, "#?RGBE"sv, "a Radiance HDR picture", picture},
    {0, "DDS |\0\0\0"sv, "a DDS texture", picture},
    {8, "WEBP"sv, "a WebP picture", picture},
    {0, "\0\0\0\x0cjP  "sv, "a JPEG 2000 picture", picture},
    // Archives.
    {0, "PK\x03\x04"sv, "a zip archive (so are .npz, .3mf, .usdz and many others)", unpack},
    {0, "7z\xbc\xaf\x27\x1c"sv, "a 7-Zip archive", unpack},
    {0, "Rar!\x1a\x07"sv, "a RAR archive", unpack},
    {257, "ustar"sv, "a tar archive", "unpack it first, as in: tar -xf {}"},
    {4, "1AY&SY"sv, "data packed by bzip2", "unpack it first, as in: bunzip2 -k {}"},
    {0,
     "\xfd"
     "7zXZ\0"sv,
     "data packed by xz", "unpack it first, as in: unxz -k {}"},
    {0, "\x28\xb5\x2f\xfd"sv, "data packed by Zstandard", "unpack it first, as in: unzstd {}"},
    {0, "\x04\x22\x4d\x18"sv, "data packed by LZ4", "unpack it first, as in: unlz4 {}"},
    {0, "\x1f\x9d\x90"sv, "data packed by compress", "unpack it first, as in: uncompress {}"},
    // Downloads that went wrong, and papers.
    {0, "version https://git-lfs"sv, "a pointer of Git LFS, not the data", "fetch them, as in: git lfs pull"},
    {0, "/annex/objects/"sv, "a pointer of git-annex, not the data", "fetch them, as in: git annex get {}"},
    {0, "%PDF"sv, "a PDF document", "name the data that it is about"},
};

bool has(std::string_view bytes, std::size_t at, std::string_view what) {
    return bytes.size() >= at + what.size() && bytes.substr(at, what.size()) == what;
}

bool same_letters(char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

bool holds_in_any_case(std::string_view text, std::string_view part) {
    return std::search(text.begin(), text.end(), part.begin(), part.end(), same_letters) != text.end();
}

/// Printable characters, some of other alphabets.
bool is_printable(std::string_view bytes) {
    std::size_t foreign = 0;
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80 && std::isprint(byte) == 0 && c != '\n' && c != '\r' && c != '\t') {
            return false;
        }
        foreign += byte >= 0x80 ? 1 : 0;
    }
    return foreign * 3 < bytes.size();
}

/// The name that gzip keeps of what it packed; empty when it kept none.
std::string packed_name(std::string_view bytes) {
    constexpr unsigned char has_extra = 4;
    constexpr unsigned char has_name = 8;
    const auto flags = static_cast<unsigned char>(bytes.size() > 10 ? bytes[3] : '\0');
    return (flags & has_name) != 0 && (flags & has_extra) == 0 ? std::string(bytes.substr(10).data()) : std::string();
}

ForeignFormat gzipped(const std::filesystem::path& path, std::string_view bytes) {
    const std::string file = path.filename().string();
    const std::string names = file + " " + packed_name(bytes);
    if (holds_in_any_case(names, ".nii")) {
        return {"a gzipped NIfTI volume",
                fmt::format("convert it, as in: c3d {} -o OUT.mhd, which is read, or unpack it with gunzip and open "
                            "the .nii",
                            file)};
    }
    if (holds_in_any_case(names, ".tar") || holds_in_any_case(names, ".tgz")) {
        return {"a gzipped tar archive", fmt::format("unpack it first, as in: tar -xzf {}", file)};
    }
    return {"data packed by gzip", fmt::format("unpack it first, as in: gzip -dc {} > OUT.raw", file)};
}

std::optional<ForeignFormat> text_format(std::string_view text) {
    const auto begins = [&](std::string_view what) {
        const std::size_t at = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
        return at != std::string_view::npos && holds_in_any_case(text.substr(at, what.size()), what);
    };
    // Such a file may hold samples behind its first lines.
    if (begins("<") && holds_in_any_case(text, "<VTKFile")) {
        return ForeignFormat{"a VTK XML file", by_paraview};
    }
    if (!is_printable(text)) {
        return std::nullopt;
    }
    if (begins("<!doctype html") || begins("<html")) {
        return ForeignFormat{"a web page, not the data", "download the file itself"};
    }
    if (begins("<") && holds_in_any_case(text, "<COLLADA")) {
        return ForeignFormat{"a Collada scene", by_blender};
    }
    if (begins("{") && holds_in_any_case(text, "\"asset\"")) {
        return ForeignFormat{"a glTF scene", by_blender};
    }
    if (begins("{")) {
        return ForeignFormat{"JSON", "a scene of Bruma needs a name that ends in .json"};
    }
    if (begins("OFF") || begins("COFF") || begins("NOFF")) {
        return ForeignFormat{"an OFF mesh", "give it a name that ends in .off"};
    }
    if (begins("v ") || text.find("\nv ") != std::string_view::npos) {
        return ForeignFormat{"an OBJ mesh", "give it a name that ends in .obj"};
    }
    // One long line may as well be samples.
    return text.find('\n') != std::string_view::npos
               ? std::optional(ForeignFormat{"text", "samples must be binary numbers"})
               : std::nullopt;
}

/// Binary STL has no magic number: its length follows from the count of triangles behind 80 bytes.
bool is_binary_stl(std::string_view bytes, std::int64_t length) {
    if (bytes.size() < 84) {
        return false;
    }
    std::int64_t triangles = 0;
    for (std::size_t n = 84; n-- > 80;) {
        triangles = triangles * 256 + static_cast<unsigned char>(bytes[n]);
    }
    return triangles > 0 && length == 84 + 50 * triangles;
}

}  // namespace

std::optional<ForeignFormat> foreign_format(const std::filesystem::path& path) {
    constexpr std::int64_t looked_at = 1024;
    std::string text;
    std::int64_t length = 0;
    try {
        const InputFile file(path);
        length = file.size();
        text.resize(std::size_t(std::min(looked_at, length)));
        file.read(0, std::as_writable_bytes(std::span(text.data(), text.size())));
    } catch (const InputError&) {
        return std::nullopt;
    }
    if (has(text, 0, "\x1f\x8b\x08"sv)) {
        return gzipped(path, text);
    }
    if (auto volume = described_volume(text, length)) {
        return volume;
    }
    for (const Magic& magic : magics) {
        if (has(text, magic.at, magic.bytes)) {
            return ForeignFormat{magic.name, fmt::format(fmt::runtime(magic.way_out), path.filename().string())};
        }
    }
    if (is_binary_stl(text, length)) {
        return ForeignFormat{"an STL mesh", by_blender};
    }
    return text_format(text);
}

void refuse_foreign_format(const std::filesystem::path& path) {
    if (const auto format = foreign_format(path)) {
        throw InputError(fmt::format("{}: this is {} by its first bytes, which is not read as it is; {}", path.string(),
                                     format->name, format->way_out));
    }
}

}  // namespace bruma::io
