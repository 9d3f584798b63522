#include "io/volume/raw_volume.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "io/describe.h"
#include "io/volume/raw_name.h"
#include "io_temporary_folder.h"
#include "scene/builtin/builtin.h"

namespace bruma::io {
namespace {

using scene::Endian;
using scene::VolumeSource;
using scene::VoxelType;

std::string bytes_of(const auto& samples) {
    std::string bytes(samples.size() * sizeof samples[0], '\0');
    std::memcpy(bytes.data(), samples.data(), bytes.size());
    return bytes;
}
std::string swapped(std::string bytes, std::size_t width) {
    for (std::size_t n = 0; n < bytes.size(); n += width) {
        std::reverse(bytes.begin() + std::ptrdiff_t(n), bytes.begin() + std::ptrdiff_t(n + width));
    }
    return bytes;
}

TEST(RawVolume, ReadsEveryTypeInBothByteOrdersBehindAnOffset) {
    const TemporaryFolder folder;
    const auto check = [&]<class T>(VoxelType type, T low, T high) {
        const std::vector<T> samples{low, high, T(1), T(2), T(3), T(4)};
        for (const Endian endian : {Endian::little, Endian::big}) {
            const std::string bytes = bytes_of(samples);
            const auto file =
                folder.write("a.raw", "header!" + (endian == Endian::big ? swapped(bytes, sizeof(T)) : bytes));
            const VolumeSource hints{.file = "",
                                     .size = glm::ivec3(3, 2, 1),
                                     .type = type,
                                     .spacing = glm::dvec3(1, 2, 3),
                                     .endian = endian,
                                     .offset = 7};
            const LoadedVolume loaded = load_raw_volume(file, hints);
            EXPECT_EQ(loaded.grid->value(0, 0, 0), double(low));
            EXPECT_EQ(loaded.grid->value(1, 0, 0), double(high));
            EXPECT_EQ(loaded.grid->value(2, 1, 0), 4.0);
            EXPECT_EQ(loaded.grid->smallest, double(low));
            EXPECT_EQ(loaded.grid->spacing, glm::dvec3(1, 2, 3));
            EXPECT_TRUE(loaded.remarks.empty());
        }
    };
    check(VoxelType::uint8, std::uint8_t(0), std::uint8_t(255));
    check(VoxelType::int8, std::int8_t(-128), std::int8_t(127));
    check(VoxelType::uint16, std::uint16_t(0), std::uint16_t(65535));
    check(VoxelType::int16, std::int16_t(-32768), std::int16_t(32767));
    check(VoxelType::float32, -1.5e-20F, 3.25e18F);
}

TEST(RawVolume, TakesEachPartFromOptionsThenSidecarThenFileName) {
    const TemporaryFolder folder;
    const auto file = folder.write("head_2x2x2_uint16_be_1x1x2mm.raw", std::string(16, '\0'));
    RawLayout layout = find_raw_layout(file, {});
    EXPECT_EQ(layout.size, glm::ivec3(2));
    EXPECT_EQ(layout.type, VoxelType::uint16);
    EXPECT_EQ(layout.endian, Endian::big);
    EXPECT_EQ(layout.spacing_m, glm::dvec3(1e-3, 1e-3, 2e-3));
    EXPECT_EQ(layout.size_from, "file name");
    EXPECT_EQ(layout.offset_from, "default");

    folder.write("head_2x2x2_uint16_be_1x1x2mm.json", R"({"size": [4, 2, 1], "spacing_mm": [0.5, 0.5, 0.5]})");
    layout = find_raw_layout(file, {});
    EXPECT_EQ(layout.size, glm::ivec3(4, 2, 1));
    EXPECT_EQ(layout.spacing_m, glm::dvec3(5e-4));
    EXPECT_EQ(layout.type_from, "file name");
    EXPECT_EQ(layout.size_from, "sidecar head_2x2x2_uint16_be_1x1x2mm.json");

    VolumeSource hints;
    hints.size = glm::ivec3(8, 1, 1);
    layout = find_raw_layout(file, hints);
    EXPECT_EQ(layout.size, glm::ivec3(8, 1, 1));
    EXPECT_EQ(layout.size_from, "options");
}

TEST(RawVolume, KnowsPublishedVolumesByNameAndSize) {
    const TemporaryFolder folder;
    const auto layout_of = [](const std::filesystem::path& file) { return known_layout_parts(file, {}).layout; };
    const RawLayout head = layout_of(folder.write("cthead_256x256x113_uint8.raw", "x"));
    EXPECT_EQ(head.spacing_m, glm::dvec3(1e-3, 1e-3, 2e-3));
    EXPECT_EQ(head.rotation_deg, glm::dvec3(-90.0, 0.0, 180.0));
    EXPECT_EQ(head.spacing_from, "known volume CThead");
    // Another size is another volume, and what the file's own name or a sidecar say goes first.
    EXPECT_EQ(layout_of(folder.write("CThead_128x128x113_uint8.raw", "x")).rotation_deg, glm::dvec3(0.0));
    const auto own = folder.write("CThead_256x256x113_uint8_3x3x3mm.raw", "x");
    EXPECT_EQ(layout_of(own).spacing_m, glm::dvec3(3e-3));
    folder.write("CThead_256x256x113_uint8_3x3x3mm.json", R"({"rotation": [0, 90, 0]})");
    EXPECT_EQ(layout_of(own).rotation_deg, glm::dvec3(0.0, 90.0, 0.0));
}

TEST(RawVolume, RefusesASidecarItDoesNotUnderstand) {
    const TemporaryFolder folder;
    const auto file = folder.write("a.raw", std::string(8, '\0'));
    folder.write("a.raw.json", R"({"size": [2, 2, 2], "tpye": "uint8"})");
    EXPECT_TRUE(
        contains(refusal([&] { find_raw_layout(file, {}); }), "a.raw.json: tpye: unknown key; did you mean 'type'?"));
    folder.write("a.raw.json", "{\n \"size\": [2, 2,, 2]}");
    EXPECT_TRUE(contains(refusal([&] { find_raw_layout(file, {}); }), "a.raw.json:2:16: broken JSON"));
    folder.write("a.raw.json", R"({"size": [2, 2, 2], "type": "u8", "spacing": [1, 1, 0]})");
    EXPECT_TRUE(contains(refusal([&] { find_raw_layout(file, {}); }), "spacing 0 m along z"));
    folder.write("a.raw.json", R"({"size": [2, 2, 2], "type": "u8"})");
    EXPECT_EQ(refusal([&] { find_raw_layout(file, {}); }), "");
}

TEST(RawVolume, TellsBothLengthsWhenTheyDiffer) {
    const TemporaryFolder folder;
    const auto file = folder.write("b_4x4x4_uint8.raw", std::string(60, 'x'));
    EXPECT_EQ(refusal([&] { load_raw_volume(file, {}); }),
              file.string() + ": 60 bytes, but 4 x 4 x 4 x uint8 needs 64; are --dims or --type wrong?");
    const auto longer = folder.write("c_4x4x4_uint8.raw", std::string(65, 'x'));
    EXPECT_TRUE(contains(refusal([&] { load_raw_volume(longer, {}); }), "65 bytes, but 4 x 4 x 4 x uint8 needs 64"));
    EXPECT_TRUE(
        contains(refusal([&] { load_raw_volume(longer, {}); }), "If 1 bytes stand before the samples, say --offset 1"));
    VolumeSource hints;
    hints.offset = 2;
    EXPECT_TRUE(
        contains(refusal([&] { load_raw_volume(longer, hints); }),
                 "65 bytes, but an offset of 2 and 4 x 4 x 4 x uint8 needs 66; are --dims, --type or --offset wrong?"));
}

TEST(RawVolume, RefusesImpossibleSizesBeforeItMultipliesThem) {
    const TemporaryFolder folder;
    const auto file = folder.write("a.raw", "12345678");
    VolumeSource hints;
    hints.type = VoxelType::float32;
    for (const glm::ivec3 size :
         {glm::ivec3(0, 1, 1), glm::ivec3(-2, -2, 2), glm::ivec3(2147483647), glm::ivec3(1 << 21, 1 << 20, 1)}) {
        hints.size = size;
        EXPECT_NE(refusal([&] { load_raw_volume(file, hints); }), "") << size.x;
    }
    const auto named = folder.write("a_99999999999999999999x1x1_uint8.raw", "1");
    EXPECT_NE(refusal([&] { load_raw_volume(named, {}); }), "");
    hints.size = glm::ivec3(2, 1, 1);
    hints.offset = std::numeric_limits<std::int64_t>::max();
    EXPECT_NE(refusal([&] { load_raw_volume(file, hints); }), "");
    hints.offset = -1;
    EXPECT_NE(refusal([&] { load_raw_volume(file, hints); }), "");
    // 2^39 samples are allowed by number, but the file is not that long: nothing may be allocated.
    hints.offset.reset();
    hints.size = glm::ivec3(1 << 19, 1 << 20, 1);
    EXPECT_TRUE(contains(refusal([&] { load_raw_volume(file, hints); }), "8 bytes, but"));
}

TEST(RawVolume, ProposesLayoutsWhenNothingTellsThem) {
    const TemporaryFolder folder;
    std::string bytes;
    for (int n = 0; n < 32 * 32 * 32; ++n) {
        const glm::vec3 p = glm::vec3(n % 32, n / 32 % 32, n / 1024) - 15.5F;
        bytes += char(std::lround(255.0F * std::exp(-0.02F * glm::dot(p, p))));
    }
    const auto file = folder.write("data.raw", bytes);
    const std::string sentence = refusal([&] { load_raw_volume(file, {}); });
    EXPECT_TRUE(contains(sentence,
                         "nothing tells the size and type of its samples; say --dims NXxNYxNZ and --type TYPE; "
                         "likely are --dims 32x32x32 --type uint8"))
        << sentence;
}

TEST(RawVolume, TellsMissingFoldersAndEmptyFilesApart) {
    const TemporaryFolder folder;
    EXPECT_TRUE(contains(refusal([&] { load_raw_volume(folder / "none.raw", {}); }), "no such file"));
    EXPECT_TRUE(contains(refusal([&] { load_raw_volume(folder.path(), {}); }), "is a folder"));
    EXPECT_TRUE(contains(refusal([&] { load_raw_volume(folder.write("e.raw", ""), {}); }), "is empty"));
    EXPECT_TRUE(contains(refusal([&] { load_raw_volume("/dev/zero", {}); }), "is a device or a pipe"));
    const auto locked = folder.write("locked.raw", "x");
    std::filesystem::permissions(locked, std::filesystem::perms::none);
    if (::geteuid() != 0) {  // the superuser may read anything
        EXPECT_TRUE(contains(refusal([&] { load_raw_volume(locked, {}); }), "is it yours to read?"));
    }
}

TEST(RawVolume, LeavesOutAndReportsWhatIsNotFinite) {
    const TemporaryFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    const auto file = folder.write("n_2x2x1_float32.raw", bytes_of(std::vector<float>{nan, 2.0F, -infinite, 5.0F}));
    const LoadedVolume loaded = load_raw_volume(file, {});
    EXPECT_EQ(loaded.grid->nonfinite, 2U);
    EXPECT_EQ(loaded.grid->value(0, 0, 0), 2.0);
    EXPECT_EQ(loaded.grid->absent, (std::vector<std::uint8_t>{1, 0, 1, 0}));
    ASSERT_EQ(loaded.remarks.size(), 1U);
    EXPECT_TRUE(contains(loaded.remarks[0], "of 4 samples 2 are not finite"));
    EXPECT_TRUE(contains(loaded.remarks[0], "drawn as nothing"));
}

TEST(RawVolume, NamesFillValuesAndSuggestsAWindowWithoutThem) {
    const TemporaryFolder folder;
    std::vector<std::int16_t> samples(4000, -32768);
    for (int i = 0; i < 6000; ++i) {
        samples.push_back(std::int16_t(-1024 + 4095 * i / 5999));
    }
    const auto file = folder.write("ct_100x10x10_int16.raw", bytes_of(samples));
    const LoadedVolume loaded = load_raw_volume(file, {});
    EXPECT_EQ(loaded.grid->smallest, -1024.0);
    ASSERT_FALSE(loaded.remarks.empty());
    EXPECT_TRUE(contains(loaded.remarks[0], "of 10000 samples 4000 hold the fill value -32768"));
    const std::string text = describe_file(file.string(), {});
    EXPECT_TRUE(contains(text, "range    -1024 to 3071")) << text;
    EXPECT_TRUE(contains(text, "fill     -32768: 4000 samples (40 %)")) << text;
    EXPECT_TRUE(contains(text, "window   -1021 to 3066 suggested")) << text;
    const auto tf = scene::suggested_transfer_function(*loaded.grid);
    ASSERT_TRUE(tf.window);
    EXPECT_EQ(tf.window, (std::array<double, 2>{-1021.0, 3066.0}));
}

TEST(RawVolume, AConstantIsAFaintHaze) {
    const TemporaryFolder folder;
    for (const char* name : {"c_8x8x8_uint8.raw", "c_8x8x4_int16.raw"}) {
        const LoadedVolume loaded = load_raw_volume(folder.write(name, std::string(512, '\7')), {});
        const auto tf = scene::suggested_transfer_function(*loaded.grid);
        const glm::dvec3 extent = loaded.grid->extent();
        const double depth = scene::extinction_of_opacity(scene::opacity_at(tf, 0.5), tf.reference_length) * extent.x;
        EXPECT_LT(depth, 0.5) << "most of the light passes";
        ASSERT_EQ(loaded.remarks.size(), 1U);
        EXPECT_TRUE(contains(loaded.remarks[0], "drawn as a faint haze"));
    }
}

TEST(RawVolume, LoadsOneSampleAndSaysThatItIsConstant) {
    const TemporaryFolder folder;
    const LoadedVolume loaded = load_raw_volume(folder.write("o_1x1x1_u8.raw", "*"), {});
    EXPECT_EQ(loaded.grid->value(0, 0, 0), 42.0);
    ASSERT_EQ(loaded.remarks.size(), 1U);
    EXPECT_TRUE(contains(loaded.remarks[0], "every sample is 42"));
}

TEST(RawVolume, SaysWhenTheByteOrderLooksWrong) {
    const TemporaryFolder folder;
    std::vector<std::uint16_t> samples;
    for (int n = 0; n < 16 * 16 * 16; ++n) {
        const glm::vec3 p = glm::vec3(n % 16, n / 16 % 16, n / 256) - 7.5F;
        samples.push_back(std::uint16_t(3000.0F * std::exp(-0.05F * glm::dot(p, p))));
    }
    const auto right = load_raw_volume(folder.write("a_16x16x16_u16.raw", bytes_of(samples)), {});
    EXPECT_TRUE(right.remarks.empty());
    const auto wrong = folder.write("b_16x16x16_u16.raw", swapped(bytes_of(samples), 2));
    const auto read = load_raw_volume(wrong, {});
    ASSERT_EQ(read.remarks.size(), 1U);
    EXPECT_TRUE(contains(read.remarks[0], "try --endian big"));
    VolumeSource hints;
    hints.endian = Endian::little;
    EXPECT_TRUE(load_raw_volume(wrong, hints).remarks.empty());
}

TEST(RawVolume, StopsWhenProgressThrows) {
    const TemporaryFolder folder;
    const auto file = folder.write("p_256x256x256_u8.raw", std::string(std::size_t(1) << 24, 'x'));
    double last = 0.0;
    struct Stop {};
    EXPECT_THROW(load_raw_volume(file, {},
                                 [&](double share, std::string_view) {
                                     last = share;
                                     throw Stop{};
                                 }),
                 Stop);
    EXPECT_GT(last, 0.0);
    EXPECT_LT(last, 1.0);
    load_raw_volume(file, {}, [&](double share, std::string_view) { last = share; });
    EXPECT_EQ(last, 1.0);
}

TEST(RawVolume, RefusesATextOfTriangles) {
    const TemporaryFolder folder;
    const auto file = folder.write("mesh.raw", "# two\r\n0 0 0 1 0 0 0 1 0\r\n\r\n0 0 0  1 0 0  0 0 1e0\r\n");
    const std::string sentence = refusal([&] { load_raw_volume(file, {}); });
    EXPECT_TRUE(contains(sentence, "triangle mesh of 2 triangles")) << sentence;
    EXPECT_TRUE(contains(sentence, "kind 'mesh'"));
}

TEST(RawVolume, ReadsTheRangeOfARealScan) {
    if (!data_folder()) {
        GTEST_SKIP() << "BRUMA_DATA does not name a folder with real volumes";
    }
    const LoadedVolume head = load_raw_volume(*data_folder() / "volumes/CThead_256x256x113_uint16.raw", {});
    EXPECT_EQ(head.grid->smallest, 0.0);
    EXPECT_EQ(head.grid->largest, 3272.0);  // known maximum of this data set
    EXPECT_EQ(head.grid->name, "CThead");
}

TEST(RawName, ReadsSizesTypesByteOrderAndSpacing) {
    EXPECT_EQ(layout_from_name("engine-zfp8_256x256x128_uint8.raw").size, glm::ivec3(256, 256, 128));
    EXPECT_EQ(layout_from_name("a_2x3x4_F32.raw").type, VoxelType::float32);
    EXPECT_EQ(layout_from_name("a_2x3x4_i16_be.raw").endian, Endian::big);
    EXPECT_EQ(layout_from_name("a_2x3x4_i16_0.5x0.25x2mm.raw").spacing, glm::dvec3(5e-4, 2.5e-4, 2e-3));
    EXPECT_EQ(layout_from_name("le_chat.raw").endian, std::nullopt);
    EXPECT_EQ(layout_from_name("a_2x2x2_short.raw").type, VoxelType::int16);
    EXPECT_EQ(layout_from_name("short_2x2x2_uint8.raw").type, VoxelType::uint8);
    EXPECT_EQ(layout_from_name("a_1x2.raw").size, std::nullopt);
    EXPECT_EQ(layout_from_name("box1x2x3y.raw").size, std::nullopt);
    EXPECT_TRUE(contains(refusal([] { layout_from_name("a_2x2x2_3x3x3_u8.raw"); }), "two sizes"));
    EXPECT_TRUE(contains(refusal([] { layout_from_name("a_2x2x2_float64.raw"); }), "type float64 are not read"));
}

TEST(RawName, MakesNodeNamesFromFileNames) {
    EXPECT_EQ(make_grid_name("d/bonsai-zfp8_256x256x256_uint8.raw"), "bonsai-zfp8");
    EXPECT_EQ(make_grid_name("wdas_cloud_sixteenth_126x86x154_uint8.raw"), "wdas_cloud_sixteenth");
    EXPECT_EQ(make_grid_name("v1.2_2x2x2_u8.raw"), "v1_2");
    EXPECT_EQ(make_grid_name("2x2x2_u8.raw"), "volume");
    EXPECT_EQ(make_grid_name("short_2x2x2_u8.raw"), "short");
}

}  // namespace
}  // namespace bruma::io
