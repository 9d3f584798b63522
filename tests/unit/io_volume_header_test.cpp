#include "io/volume/volume_header.h"

#include <gtest/gtest.h>

#include "io/describe.h"
#include "io/open.h"
#include "io/volume/raw_layout.h"
#include "io/volume/raw_volume.h"
#include "io_temporary_folder.h"

namespace bruma::io {
namespace {

using scene::Endian;
using scene::VoxelType;

const std::string samples(48, 'x');  // 2 x 3 x 4 of 16 bits

std::string metaimage(const std::string& more, const std::string& data = "scan.raw") {
    return "ObjectType = Image\nNDims = 3\nDimSize = 2 3 4\nElementType = MET_SHORT\n" + more +
           "ElementDataFile = " + data + "\n";
}
std::string nrrd(const std::string& more) {
    return "NRRD0004\n# a comment\ntype: unsigned short\ndimension: 3\nsizes: 2 3 4\nencoding: raw\n" + more;
}

TEST(VolumeHeader, BesideARawFileTellsItsLayout) {
    const TemporaryFolder folder;
    const auto raw = folder.write("scan.raw", samples + "12345678");
    folder.write("scan.mhd", metaimage("ElementSpacing = 0.5 0.5 2\nBinaryDataByteOrderMSB = True\nHeaderSize = 8\n"));
    const RawLayout layout = find_raw_layout(raw, {});
    EXPECT_EQ(layout.size, glm::ivec3(2, 3, 4));
    EXPECT_EQ(layout.type, VoxelType::int16);
    EXPECT_EQ(layout.endian, Endian::big);
    EXPECT_EQ(layout.offset, 8);
    EXPECT_EQ(layout.spacing_m, glm::dvec3(5e-4, 5e-4, 2e-3));
    EXPECT_EQ(layout.size_from, "header scan.mhd");
    EXPECT_EQ(layout.file, raw);
}

TEST(VolumeHeader, IsUsedOnlyForTheFileThatItNames) {
    const TemporaryFolder folder;
    const auto raw = folder.write("scan.raw", samples);
    folder.write("scan.mhd", metaimage("", "other.raw"));
    EXPECT_FALSE(known_layout_parts(raw, {}).complete());
    // One of another name counts when it names the file, two only when they agree.
    folder.write("series.nhdr", nrrd("endian: little\nspacings: 1 1 3\ndata file: ./scan.raw\n"));
    EXPECT_EQ(find_raw_layout(raw, {}).size_from, "header series.nhdr");
    folder.write("third.nhdr", nrrd("endian: big\ndata file: scan.raw\n"));
    EXPECT_FALSE(known_layout_parts(raw, {}).complete());
    folder.write("scan.raw.mhd", metaimage(""));
    EXPECT_EQ(find_raw_layout(raw, {}).size_from, "header scan.raw.mhd");
}

TEST(VolumeHeader, IsOpenedInPlaceOfItsSamples) {
    const TemporaryFolder folder;
    folder.write("scan.raw", samples);
    for (const auto& header :
         {folder.write("a.mhd", metaimage("ElementSpacing = 1 1 2\n")),
          folder.write("b.NHDR", nrrd("endian: little\nspacings: 1 1 2\ndatafile: scan.raw\n")),
          folder.write("c.nhdr",
                       nrrd("endian: little\nspace directions: (1,0,0) (0,1,0) (0,0,2)\ndata file: scan.raw\n"))}) {
        const LoadedVolume loaded = load_raw_volume(header, {});
        EXPECT_EQ(loaded.grid->size, glm::ivec3(2, 3, 4)) << header;
        EXPECT_EQ(loaded.grid->spacing, glm::dvec3(1e-3, 1e-3, 2e-3)) << header;
        EXPECT_EQ(loaded.grid->value(0, 0, 0), double('x' * 257)) << header;
        const scene::Scene scene = open_files(std::vector{header.string()}, {}, {});
        EXPECT_EQ(scene.nodes.size(), 1U);
        EXPECT_TRUE(
            contains(describe_file(header.string(), {}), "size     2 x 3 x 4 (header " + header.filename().string()));
    }
    std::filesystem::remove(folder / "scan.raw");
    const std::string sentence = refusal([&] { load_raw_volume(folder / "a.mhd", {}); });
    EXPECT_TRUE(contains(sentence, "a.mhd: its samples should be in " + (folder / "scan.raw").string())) << sentence;
}

TEST(VolumeHeader, WithSamplesBehindItIsReadWhateverItsName) {
    const TemporaryFolder folder;
    for (const char* name : {"whole.nrrd", "renamed.raw", "renamed"}) {
        const auto file = folder.write(name, nrrd("endian: big\nspacings: 1 1 2\n\n") + samples);
        const LoadedVolume loaded = load_raw_volume(file, {});
        EXPECT_EQ(loaded.layout.endian, Endian::big) << name;
        EXPECT_EQ(loaded.grid->value(1, 2, 3), double('x' * 257)) << name;
    }
    const auto local = folder.write("whole.mha", metaimage("", "LOCAL") + samples);
    EXPECT_EQ(load_raw_volume(local, {}).grid->size, glm::ivec3(2, 3, 4));
}

TEST(VolumeHeader, CountsHeadersFromTheEnd) {
    const TemporaryFolder folder;
    folder.write("scan.raw", "12345" + samples);
    folder.write("a.mhd", metaimage("HeaderSize = -1\n"));
    EXPECT_EQ(find_raw_layout(folder / "a.mhd", {}).offset, 5);
    folder.write("b.nhdr", nrrd("endian: little\nbyte skip: -1\ndata file: scan.raw\n"));
    EXPECT_EQ(find_raw_layout(folder / "b.nhdr", {}).offset, 5);
}

TEST(VolumeHeader, TakesThreeDimensionsOutOfFewerAndMore) {
    const TemporaryFolder folder;
    const auto sizes = [&](const std::string& dimensions, const std::string& more) {
        return read_volume_header(
            folder.write("a.nrrd", "NRRD0005\ntype: uchar\nsizes: " + dimensions + "\nencoding: raw\n" + more + "\n"));
    };
    EXPECT_EQ(sizes("8 4", "").says.size, glm::ivec3(8, 4, 1));
    const VolumeHeader four = sizes("1 8 4 2", "spacings: NaN 1 2 3\n");
    EXPECT_EQ(four.says.size, glm::ivec3(8, 4, 2));
    EXPECT_EQ(four.says.spacing, glm::dvec3(1e-3, 2e-3, 3e-3));
    const VolumeHeader directions =
        sizes("8 4 2", "space directions: (-0.5,0,0) (0,3,4) (0,0,2)\nspace units: \"um\" \"um\" \"um\"\n");
    EXPECT_NEAR(directions.says.spacing->x, 0.5e-6, 1e-18);
    EXPECT_NEAR(directions.says.spacing->y, 5e-6, 1e-18);
    EXPECT_EQ(directions.unused, std::vector<std::string>{"space directions"});
    EXPECT_TRUE(contains(refusal([&] { sizes("3 8 4 2", ""); }), "has 4 dimensions"));
}

TEST(VolumeHeader, RefusesWhatItCannotRead) {
    const TemporaryFolder folder;
    folder.write("scan.raw", samples);
    const auto fault = [&](const std::string& text) {
        return refusal([&] { read_volume_header(folder.write("a.hdr", text)); });
    };
    EXPECT_TRUE(contains(fault(metaimage("CompressedData = True\n")), "a.hdr: its samples are compressed"));
    EXPECT_TRUE(contains(fault(metaimage("BinaryData = False\n")), "its samples are text"));
    EXPECT_TRUE(contains(fault(metaimage("ElementNumberOfChannels = 3\n")), "has 3 numbers a sample"));
    EXPECT_TRUE(contains(fault(metaimage("", "LIST")), "one file each"));
    EXPECT_TRUE(contains(fault(metaimage("", "s%03d.raw 1 4 1")), "one file each"));
    EXPECT_TRUE(contains(fault("NDims = 3\nDimSize = 2 3 4\nElementType = MET_DOUBLE\nElementDataFile = scan.raw\n"),
                         "samples of type MET_DOUBLE are not read"));
    EXPECT_TRUE(contains(fault("NDims = 3\nDimSize = 2 3\n"), "without ElementType"));
    EXPECT_TRUE(contains(fault(metaimage("DimSize = 2 3 x\n")), "'x' is no number"));
    EXPECT_TRUE(contains(fault(metaimage("DimSize = 2 3 0\n")), "each must be 1 to"));
    EXPECT_TRUE(contains(fault("NRRD0004\ntype: double\nsizes: 2 3 4\nencoding: raw\n\n"), "type 'double'"));
    EXPECT_TRUE(contains(fault("NRRD0004\ntype: short\nsizes: 2 3 4\nencoding: gzip\n\n"), "encoded as gzip"));
    EXPECT_TRUE(contains(fault("NRRD0004\ntype: short\n\n"), "without 'sizes'"));
    // Whoever says size and type needs no header.
    folder.write("scan.mhd", metaimage("CompressedData = True\n"));
    EXPECT_TRUE(contains(refusal([&] { find_raw_layout(folder / "scan.raw", {}); }), "compressed"));
    scene::VolumeSource hints;
    hints.size = glm::ivec3(2, 3, 4);
    hints.type = VoxelType::uint16;
    EXPECT_EQ(refusal([&] { find_raw_layout(folder / "scan.raw", hints); }), "");
}

TEST(VolumeHeader, OfAnotherLengthThanItsFileIsTold) {
    const TemporaryFolder folder;
    const auto raw = folder.write("scan.raw", samples + "1");
    folder.write("scan.mhd", metaimage(""));
    EXPECT_EQ(refusal([&] { find_raw_layout(raw, {}); }),
              raw.string() + ": 49 bytes, but 2 x 3 x 4 x int16 needs 48; is the header scan.mhd about another file?");
}

}  // namespace
}  // namespace bruma::io
