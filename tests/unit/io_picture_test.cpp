#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "io/atomic_file.h"
#include "io/picture/picture_file.h"
#include "io_temporary_folder.h"

namespace bruma::io {
namespace {

Image ramp(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            float* p = image.pixel(x, y);
            p[0] = float(x) / 7.0F;
            p[1] = float(y) * 1e3F;
            p[2] = 1e-6F;
            p[3] = 0.25F;
        }
    }
    return image;
}

TEST(PictureFile, PngKeepsEveryByteAndTheRowOrder) {
    const TemporaryFolder folder;
    Picture8 picture{3, 2, {}};
    for (int n = 0; n < 6; ++n) {
        picture.rgba.insert(picture.rgba.end(), {std::uint8_t(40 * n), std::uint8_t(255 - n), 7, 255});
    }
    const std::string path = (folder / "a.png").string();
    write_png(path, picture);
    const Image read = read_picture(path);
    ASSERT_EQ(read.width, 3);
    ASSERT_EQ(read.height, 2);
    for (std::size_t n = 0; n < 6; ++n) {
        EXPECT_FLOAT_EQ(read.rgba[4 * n], float(linear_of_srgb(40.0 * double(n) / 255.0)));
        EXPECT_EQ(read.rgba[4 * n + 3], 1.0F);
    }
    EXPECT_EQ(folder.file_count(), 1U);
}

TEST(PictureFile, PngOpacityBecomesPremultiplied) {
    const TemporaryFolder folder;
    const std::string path = (folder / "a.png").string();
    write_png(path, Picture8{1, 1, {255, 0, 0, 51}});
    const Image read = read_picture(path);
    EXPECT_FLOAT_EQ(read.rgba[0], 0.2F);
    EXPECT_FLOAT_EQ(read.rgba[3], 0.2F);
}

TEST(PictureFile, ExrKeepsEveryBit) {
    const TemporaryFolder folder;
    const Image image = ramp(33, 17);
    const std::string path = (folder / "a.exr").string();
    write_exr(path, image, {{"error", std::vector<float>(image.pixel_count(), 0.5F)}});
    EXPECT_EQ(read_picture(path).rgba, image.rgba);
}

TEST(PictureFile, HdrKeepsAPartIn256) {
    const TemporaryFolder folder;
    const Image image = ramp(33, 17);
    const std::string path = (folder / "a.hdr").string();
    write_hdr(path, image);
    const Image read = read_picture(path);
    ASSERT_EQ(read.rgba.size(), image.rgba.size());
    for (std::size_t n = 0; n < image.pixel_count(); ++n) {
        const float* p = &image.rgba[4 * n];
        // A mantissa of 8 bits is shared by the three colours and cut, so the step is 1/128 of the largest at worst.
        const float tolerance = std::max({p[0], p[1], p[2]}) / 128.0F;
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(read.rgba[4 * n + c], p[c], tolerance);
        }
    }
}

TEST(PictureFile, WritesByEndingAndRefusesOthers) {
    const TemporaryFolder folder;
    const Image image = ramp(2, 2);
    const Picture8 display{2, 2, std::vector<std::uint8_t>(16, 100)};
    for (const char* name : {"a.png", "a.hdr", "a.EXR"}) {
        write_picture((folder / name).string(), image, display);
        EXPECT_EQ(read_picture(folder / name).width, 2) << name;
    }
    EXPECT_TRUE(contains(refusal([&] { write_picture((folder / "a.gif").string(), image, display); }),
                         "'.gif' is no picture that can be written; end the name in .png, .hdr or .exr"));
    EXPECT_NE(refusal([&] { write_png((folder / "z.png").string(), Picture8{}); }), "");
    EXPECT_EQ(folder.file_count(), 3U);
}

TEST(PictureFile, RefusesBrokenFilesWithASentence) {
    const TemporaryFolder folder;
    EXPECT_TRUE(contains(refusal([&] { read_picture(folder / "none.png"); }), "no such file"));
    EXPECT_TRUE(contains(refusal([&] { read_picture(folder.write("t.png", "not a picture")); }), "broken or unknown"));
    for (const char* name : {"a.png", "a.hdr", "a.exr"}) {
        write_picture((folder / name).string(), ramp(64, 64),
                      Picture8{64, 64, std::vector<std::uint8_t>(64 * 64 * 4, 9)});
        std::ostringstream whole;
        whole << std::ifstream(folder / name, std::ios::binary).rdbuf();
        EXPECT_NE(refusal([&] { read_picture(folder.write(name, whole.str().substr(0, 30))); }), "") << name;
    }
}

TEST(AtomicFile, AnUnwritableFolderGivesOneSentenceAndNoFile) {
    const TemporaryFolder folder;
    const std::string sentence = refusal([&] { write_file_atomically(folder / "none/a.txt", std::string("x")); });
    EXPECT_TRUE(contains(sentence, (folder / "none/a.txt").string() + ": cannot be written")) << sentence;
    EXPECT_EQ(folder.file_count(), 0U);
    // The target is a folder: the rename fails at the very end, and what was written goes away.
    std::filesystem::create_directory(folder / "taken");
    EXPECT_NE(refusal([&] { write_file_atomically(folder / "taken", std::string("x")); }), "");
    EXPECT_EQ(folder.file_count(), 1U);
}

TEST(AtomicFile, APlaceIsJudgedBeforehandAndLeftAsItWas) {
    const TemporaryFolder folder;
    const auto file = folder.write("a.txt", "kept");
    require_writable(file);
    require_writable(folder / "new.txt");
    require_writable_folder(folder.path());
    require_writable_folder(folder / "made/later");
    EXPECT_EQ(folder.file_count(), 1U);
    EXPECT_EQ(std::filesystem::file_size(file), 4U);
    EXPECT_TRUE(contains(refusal([&] { require_writable(folder.path()); }), "is a folder"));
    EXPECT_TRUE(contains(refusal([&] { require_writable(folder / "none/a.txt"); }), "cannot be written"));
    EXPECT_TRUE(contains(refusal([&] { require_writable_folder(file); }), "is no folder"));
    EXPECT_TRUE(contains(refusal([&] { require_writable_folder(file / "results"); }), file.string() + " is no folder"));
    std::filesystem::permissions(folder.path(),
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    if (::geteuid() != 0) {  // the superuser may write anywhere
        EXPECT_TRUE(contains(refusal([&] { require_writable(folder / "b.txt"); }), "Permission denied"));
        EXPECT_TRUE(contains(refusal([&] { require_writable_folder(folder / "b"); }), "nothing can be written in"));
    }
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

}  // namespace
}  // namespace bruma::io
