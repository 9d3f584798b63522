#include "io/foreign_format.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "io/describe.h"
#include "io/open.h"
#include "io/volume/raw_layout.h"
#include "io_temporary_folder.h"

namespace bruma::io {
namespace {

using namespace std::string_literals;

/// What a file of this beginning is called, whatever its own name says.
std::string name_of(const std::string& bytes, const std::string& file = "renamed.raw") {
    const TemporaryFolder folder;
    const bool is_text = bytes.ends_with('\n');
    const auto found = foreign_format(folder.write(file, bytes + std::string(600, is_text ? ' ' : '\x01')));
    return found ? found->name : "nothing";
}

TEST(ForeignFormat, IsKnownByItsFirstBytes) {
    EXPECT_EQ(name_of(std::string(128, '\0') + "DICM"), "a DICOM file");
    EXPECT_EQ(name_of("# vtk DataFile Version 3.0\nx\nBINARY\n"), "a VTK legacy file");
    EXPECT_EQ(name_of("<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\">\n"), "a VTK XML file");
    EXPECT_EQ(name_of(" BDV\0\0\0\0"s), "an OpenVDB grid");
    EXPECT_TRUE(contains(name_of("\x89HDF\r\n\x1a\n"), "an HDF5 file"));
    EXPECT_EQ(name_of("CDF\x01"), "a netCDF file");
    EXPECT_EQ(name_of("II*\0"s), "a TIFF picture or stack");
    EXPECT_EQ(name_of("MM\0+"s), "a BigTIFF picture or stack");
    EXPECT_EQ(name_of("PVM3\n64 64 64\n"), "a PVM volume");
    EXPECT_EQ(name_of("DDS v3d\n"), "a compressed PVM volume");
    EXPECT_EQ(name_of("ply\nformat ascii 1.0\n"), "a PLY mesh");
    EXPECT_EQ(name_of("solid cube\nfacet normal 0 0 1\n"), "an STL mesh");
    EXPECT_EQ(name_of("glTF\x02"), "a binary glTF scene");
    EXPECT_EQ(name_of("{\"asset\": {\"version\": \"2.0\"}}\n"), "a glTF scene");
    EXPECT_EQ(name_of("Kaydara FBX Binary  "), "an FBX scene");
    EXPECT_EQ(name_of("PXR-USDC"), "a USD scene");
    EXPECT_EQ(name_of("\x89PNG\r\n\x1a\n"), "a PNG picture");
    EXPECT_TRUE(contains(name_of("PK\x03\x04"), "a zip archive"));
    EXPECT_EQ(name_of("\x28\xb5\x2f\xfd"), "data packed by Zstandard");
    EXPECT_EQ(name_of("BZh91AY&SY"), "data packed by bzip2");
    EXPECT_EQ(name_of("version https://git-lfs.github.com/spec/v1\n"), "a pointer of Git LFS, not the data");
    EXPECT_EQ(name_of("<!DOCTYPE html>\n<html>\n"), "a web page, not the data");
    EXPECT_EQ(name_of("# made by hand\nv 0 0 0\nv 1 0 0\n"), "an OBJ mesh");
    EXPECT_EQ(name_of("\x1f\x8b\x08\0"s), "data packed by gzip");
    EXPECT_EQ(name_of("\x1f\x8b\x08\0"s, "scan.nii.gz"), "a gzipped NIfTI volume");
    EXPECT_EQ(name_of("\x1f\x8b\x08\x08\0\0\0\0\0\x03scan.nii\0"s), "a gzipped NIfTI volume");
    EXPECT_EQ(name_of("\x1f\x8b\x08\0"s, "data.tar.gz"), "a gzipped tar archive");
    std::string stl(84, '\0');
    stl[80] = 12;
    EXPECT_EQ(name_of(stl), "an STL mesh") << "84 + 12 * 50 bytes";
}

TEST(ForeignFormat, LeavesSamplesAlone) {
    const TemporaryFolder folder;
    const auto found = [&](const std::string& bytes) {
        return foreign_format(folder.write("a.raw", bytes)).has_value();
    };
    EXPECT_FALSE(found(std::string(4096, '\0')));
    EXPECT_FALSE(found(std::string(4096, 'x')));
    EXPECT_FALSE(found(std::string("BM") + std::string(4096, '\x10'))) << "two bytes are too few to tell";
    std::string ramp;
    for (int n = 0; n < 4096; ++n) {
        ramp += char(n / 16);
    }
    EXPECT_FALSE(found(ramp));
    EXPECT_FALSE(found("v " + std::string(4096, '\x10'))) << "no text";
    EXPECT_FALSE(found("\x1f\x8b" + std::string(4096, '\x10')));
    EXPECT_TRUE(found("Many greetings from K\xc3\xb6ln\n")) << "text of another alphabet";
    EXPECT_TRUE(found(R"({"EchoTime": 0.003})")) << "text of one line that begins as none but JSON does";
    EXPECT_TRUE(found("1 2 3\n4 5 6\n")) << "text";
    EXPECT_FALSE(foreign_format(folder / "none.raw").has_value());
}

std::string nifti(std::int16_t type, float offset) {
    std::string head(352, '\0');
    const auto put = [&](std::size_t at, auto value) { std::memcpy(head.data() + at, &value, sizeof value); };
    put(0, std::int32_t(348));
    const std::array<std::int16_t, 4> dimensions{3, 8, 4, 2};
    std::memcpy(head.data() + 40, dimensions.data(), sizeof dimensions);
    put(70, type);
    for (std::size_t n = 0; n < 3; ++n) {
        put(80 + 4 * n, n == 2 ? 2.5F : 1.0F);
    }
    put(108, offset);
    std::memcpy(head.data() + 344, "n+1", 4);
    return head;
}

TEST(ForeignFormat, NamesTheOptionsWithWhichPlainSamplesAreRead) {
    const TemporaryFolder folder;
    const auto way_out = [&](const std::string& bytes) {
        return foreign_format(folder.write("a.raw", bytes))->way_out;
    };
    EXPECT_EQ(way_out(nifti(4, 352.0F) + std::string(128, 'x')),
              "its samples are plain, so say: --dims 8x4x2 --type int16 --spacing 1,1,2.5 --offset 352");
    EXPECT_TRUE(contains(way_out(nifti(64, 352.0F) + std::string(512, 'x')), "convert it")) << "float64";
    EXPECT_TRUE(contains(way_out(nifti(4, 352.0F) + std::string(127, 'x')), "convert it")) << "a byte too few";
    const std::string shape = "{'descr': '>f4', 'fortran_order': False, 'shape': (2, 4, 8), }";
    const std::string npy = "\x93NUMPY\x01\0"s + char(shape.size()) + '\0' + shape;
    EXPECT_EQ(way_out(npy + std::string(256, 'x')),
              "its samples are plain, so say: --dims 8x4x2 --type float32 --endian big --offset " +
                  std::to_string(npy.size()));
    std::string mrc(1024, '\0');
    mrc[0] = 8;
    mrc[4] = 4;
    mrc[8] = 2;
    mrc[12] = 2;
    std::memcpy(mrc.data() + 208, "MAP DD", 6);
    EXPECT_EQ(way_out(mrc + std::string(256, 'x')),
              "its samples are plain, so say: --dims 8x4x2 --type float32 --offset 1024");
}

TEST(ForeignFormat, IsToldInPlaceOfInventedLayouts) {
    const TemporaryFolder folder;
    const std::string file = folder.write("data.raw", "\x89HDF\r\n\x1a\n" + std::string(4088, '\x02')).string();
    const std::string sentence =
        file +
        ": this is an HDF5 file (so are netCDF-4, MINC 2, Imaris and MATLAB 7.3) by its first bytes, which is not "
        "read as it is; write one dataset of it plainly, as in: h5dump -d /NAME -b LE -o OUT.raw data.raw";
    EXPECT_EQ(refusal([&] { find_raw_layout(file, {}); }), sentence);
    EXPECT_EQ(refusal([&] { describe_file(file, {}); }), sentence);
    EXPECT_EQ(refusal([&] { open_files(std::vector{file}, {}, {}); }), sentence);
    // A wrong length is no reason to speak of lengths only, but a right one is believed.
    scene::VolumeSource hints;
    hints.size = glm::ivec3(16, 16, 8);
    hints.type = scene::VoxelType::uint8;
    EXPECT_EQ(refusal([&] { find_raw_layout(file, hints); }), sentence);
    hints.size = glm::ivec3(16, 16, 16);
    EXPECT_EQ(refusal([&] { find_raw_layout(file, hints); }), "");
    const std::string mesh = folder.write("a.ply", "ply\nformat ascii 1.0\n").string();
    EXPECT_TRUE(contains(refusal([&] { open_files(std::vector{mesh}, {}, {}); }),
                         "a.ply: this is a PLY mesh by its first bytes, which is not read as it is; open it in "
                         "Blender or MeshLab and save it as .obj"));
}

}  // namespace
}  // namespace bruma::io
