#include "io/volume/known_volumes.h"

#include <gtest/gtest.h>

#include <cctype>
#include <set>

#include "io/volume/raw_layout.h"
#include "io/volume/raw_name.h"
#include "io_temporary_folder.h"
#include "scene/scene.h"

namespace bruma::io {
namespace {

std::string letters_of(const std::string& name) {
    std::string letters;
    for (const char c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
            letters += char(std::tolower(static_cast<unsigned char>(c)));
        }
    }
    return letters;
}

TEST(KnownVolumes, TheListIsInOrder) {
    const std::vector<KnownVolume> all = known_volumes();
    EXPECT_GE(all.size(), 40U);
    std::set<std::pair<std::string, std::vector<int>>> seen;
    for (const KnownVolume& known : all) {
        std::vector<std::string> names = known.also;
        names.push_back(known.name);
        for (const std::string& name : names) {
            EXPECT_FALSE(letters_of(name).empty());
            EXPECT_TRUE(seen.insert({letters_of(name), {known.size.x, known.size.y, known.size.z}}).second)
                << name << " is there twice";
        }
        EXPECT_FALSE(known.from.empty()) << known.name;
        EXPECT_EQ(refusal([&] { check_size(known.size, known.name); }), "");
        for (int axis = 0; axis < 3; ++axis) {
            // From cells under a microscope to bodies in a scanner.
            EXPECT_GT(known.spacing_m[axis], 1e-8) << known.name;
            EXPECT_LT(known.spacing_m[axis], 1e-1) << known.name;
        }
        if (known.rotation_deg) {
            const glm::dmat3 turn(scene::parent_from_model(scene::Transform{.rotation_deg = *known.rotation_deg}));
            EXPECT_NEAR(glm::determinant(turn), 1.0, 1e-12) << known.name;
            for (int axis = 0; axis < 3; ++axis) {
                // Upright along the axes of its samples, as scanners lie.
                EXPECT_NEAR(std::max({std::abs(turn[axis].x), std::abs(turn[axis].y), std::abs(turn[axis].z)}), 1.0,
                            1e-12)
                    << known.name;
            }
        }
    }
}

TEST(KnownVolumes, AreKnownByNameAndSizeInAnySpelling) {
    const auto name_of = [](const char* file, glm::ivec3 size) {
        const auto found = known_volume(file, size, {}, 1);
        return found ? found->name : std::string("none");
    };
    EXPECT_EQ(name_of("d/BostonTeapot.raw", {256, 256, 178}), "boston_teapot");
    EXPECT_EQ(name_of("boston-teapot (copy)_256x256x178.raw", {256, 256, 178}), "boston_teapot");
    EXPECT_EQ(name_of("AneurYsm_256x256x256_uint8.raw", {256, 256, 256}), "aneurism");
    EXPECT_EQ(name_of("3d_neurons_15_sept_2016_2048x2048x1718_uint16.raw", {2048, 2048, 1718}),
              "3d_neurons_15_sept_2016");
    // A name that only begins alike, and another size, are other volumes.
    EXPECT_EQ(name_of("football_256x256x256_uint8.raw", {256, 256, 256}), "none");
    EXPECT_EQ(name_of("foot2_256x256x256_uint8.raw", {256, 256, 256}), "none");
    EXPECT_EQ(name_of("foot_128x128x128_uint8.raw", {128, 128, 128}), "none");
    EXPECT_EQ(name_of("my_foot_256x256x256_uint8.raw", {256, 256, 256}), "none");
}

TEST(KnownVolumes, TellSizeAndTypeOfAFileOfTheRightLength) {
    const TemporaryFolder folder;
    const RawLayoutParts nucleon = known_layout_parts(folder.write("nucleon.raw", std::string(68921, 'x')), {});
    ASSERT_TRUE(nucleon.complete());
    EXPECT_EQ(nucleon.layout.size, glm::ivec3(41));
    EXPECT_EQ(nucleon.layout.size_from, "known volume nucleon");
    EXPECT_EQ(nucleon.layout.type_from, "known volume nucleon");
    // One byte more is no file of that volume.
    EXPECT_FALSE(known_layout_parts(folder.write("nucleon2.raw", std::string(68922, 'x')), {}).complete());
    EXPECT_FALSE(known_layout_parts(folder.write("silicium.raw", std::string(68921, 'x')), {}).complete());
    // A header that somebody told is not counted.
    scene::VolumeSource hints;
    hints.offset = 6;
    EXPECT_TRUE(known_layout_parts(folder.write("Nucleon.raw", std::string(68927, 'x')), hints).complete());
    // Two names could match; the longer one does.
    hints = {};
    const auto axons = folder.write("fuel.raw", std::string(64 * 64 * 64, 'x'));
    EXPECT_EQ(known_layout_parts(axons, hints).layout.size, glm::ivec3(64));
}

TEST(KnownVolumes, SpacingIsThatOfTheDescription) {
    const auto spacing_of = [](const char* name, glm::ivec3 size) {
        return 1e3 * known_volume(name, size, {}, 1).value().spacing_m;
    };
    const auto near = [](glm::dvec3 a, glm::dvec3 b) { return glm::length(a - b) < 1e-9 * glm::length(b); };
    EXPECT_TRUE(near(spacing_of("bunny.raw", {512, 512, 361}), {0.337891, 0.337891, 0.5}));
    EXPECT_TRUE(near(spacing_of("vis_male.raw", {128, 256, 256}), {1.57774, 0.995861, 1.00797}));
    EXPECT_TRUE(near(spacing_of("statue_leg.raw", {341, 341, 93}), {1, 1, 4}));
    EXPECT_TRUE(near(spacing_of("beechnut.raw", {1024, 1024, 1546}), glm::dvec3(0.02))) << "given in metres";
    EXPECT_TRUE(near(spacing_of("marmoset_neurons.raw", {1024, 1024, 314}), {0.497e-3, 0.497e-3, 1.5e-3}))
        << "given in micrometres";
}

TEST(KnownVolumes, RecogniseTheRealOnesAtHand) {
    if (!data_folder()) {
        GTEST_SKIP() << "BRUMA_DATA does not name a folder with real volumes";
    }
    for (const auto& entry : std::filesystem::directory_iterator(*data_folder() / "volumes")) {
        if (entry.path().extension() == ".raw") {
            EXPECT_TRUE(known_layout_parts(entry.path(), {}).layout.spacing_from.starts_with("known volume"))
                << entry.path();
        }
    }
}

}  // namespace
}  // namespace bruma::io
