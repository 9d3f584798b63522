#include "io/open.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/describe.h"
#include "io/scene/scene_file.h"
#include "io/scene/scene_json.h"
#include "io_temporary_folder.h"
#include "scene/builtin/builtin.h"

namespace bruma::io {
namespace {

std::string ramp_bytes() {
    std::string bytes;
    for (int n = 0; n < 8 * 8 * 8; ++n) {
        bytes += char(n % 200);
    }
    return bytes;
}

/// A bell curve in the middle of 16^3 samples: smooth along all axes, so that its layout can be found out.
std::string bell_bytes() {
    std::string bytes;
    for (int n = 0; n < 16 * 16 * 16; ++n) {
        const glm::vec3 p = glm::vec3(n % 16, n / 16 % 16, n / 256) - 7.5F;
        bytes += char(std::lround(255.0F * std::exp(-0.08F * glm::dot(p, p))));
    }
    return bytes;
}

const scene::Volume& volume_of(const scene::Scene& scene, const std::string& name) {
    return std::get<scene::Volume>(scene.nodes.at(name).content);
}

TEST(Open, NamesNodesAfterFilesAndSetsThemSideBySide) {
    const TemporaryFolder folder;
    const std::string file = folder.write("ramp_8x8x8_uint8.raw", ramp_bytes()).string();
    const std::vector<std::string> arguments{file, file, "builtin:" + scene::builtin_volume_names().front()};
    const scene::Scene scene = open_files(arguments, {}, {});
    EXPECT_EQ(scene.nodes.size(), 3U);
    ASSERT_TRUE(scene.nodes.contains("ramp"));
    ASSERT_TRUE(scene.nodes.contains("ramp_2"));
    EXPECT_EQ(scene.nodes.at("ramp").transform->translation, glm::dvec3(0.0));
    // 8 mm wide, half of it to each side, and a tenth as gap.
    EXPECT_NEAR(scene.nodes.at("ramp_2").transform->translation.x, 8.8e-3, 1e-12);
    ASSERT_EQ(scene.lights.size(), 1U);
    EXPECT_EQ(scene.lights.at("headlight")->kind, scene::LightKind::headlight);
}

TEST(Open, TurnsAVolumeAsItsSidecarSays) {
    const TemporaryFolder folder;
    const std::string file = folder.write("slab_4x8x16_uint8.raw", std::string(512, 'x')).string();
    folder.write("slab_4x8x16_uint8.json", R"({"rotation": [-90, 0, 180]})");
    const scene::Scene scene = open_files(std::vector{file, file}, {}, {});
    EXPECT_EQ(scene.nodes.at("slab").transform->rotation_deg, glm::dvec3(-90.0, 0.0, 180.0));
    // The axis -z is up now, so the box is 16 samples of 1 mm high.
    const scene::Bounds bounds = scene::world_bounds(scene);
    EXPECT_NEAR(bounds.high.y - bounds.low.y, 16e-3, 1e-12);
    const glm::dvec4 up = scene::world_from_model(scene, "slab") * glm::dvec4(0.0, 0.0, -1.0, 0.0);
    EXPECT_NEAR(up.y, 1.0, 1e-12);
    EXPECT_NEAR(scene.nodes.at("slab_2").transform->translation.x, 4.4e-3, 1e-12) << "4 mm and a tenth";
}

TEST(Open, AppliesSettingsAndSharesTheGrids) {
    const TemporaryFolder folder;
    const std::string file = folder.write("ramp_8x8x8_uint8.raw", ramp_bytes()).string();
    const std::vector<std::string> settings{"volume.lighting=gradient", "camera.vertical_angle=20"};
    const scene::Scene scene = open_files(std::vector{file}, {}, settings);
    EXPECT_EQ(volume_of(scene, "ramp").optics->lighting, scene::VolumeLighting::gradient);
    EXPECT_EQ((*scene.camera)->vertical_angle_deg, 20.0);
    const scene::Scene changed = with_settings(scene, std::vector<std::string>{"volume.ambient=0.5"});
    EXPECT_EQ(*volume_of(changed, "ramp").grid, *volume_of(scene, "ramp").grid);
    EXPECT_TRUE(contains(refusal([&] { with_settings(scene, std::vector<std::string>{"volume.ambient=50"}); }),
                         "--set: nodes.ramp.ambient: 50 is above 10"));
}

TEST(Open, RefusesAMissingFileWithAShortName) {
    // Shorter than the word 'builtin:', which was once cut off without looking.
    EXPECT_TRUE(contains(refusal([] { open_files(std::vector<std::string>{"x.raw"}, {}, {}); }), "no such file"));
}

TEST(Open, RefusesUnknownEndingsAndNames) {
    const auto fault = [](const std::string& argument) {
        return refusal([&] { open_files(std::vector{argument}, {}, {}); });
    };
    EXPECT_TRUE(contains(fault("a.stl"),
                         "a.stl: '.stl' is not read; known are .json scenes, .raw volumes, .obj, .off and .raw "
                         "meshes and builtin:NAME"));
    EXPECT_TRUE(contains(fault("abc"), "a name without ending"));
    EXPECT_TRUE(contains(fault("builtin:" + scene::builtin_volume_names().front() + "x"), "did you mean"));
}

TEST(Open, ReadsAnyEndingWithALayoutAndAnyCase) {
    const TemporaryFolder folder;
    const auto size_of = [](const std::string& file, const scene::VolumeSource& hints) {
        const scene::Scene scene = open_files(std::vector{file}, hints, {});
        return (*std::get<scene::Volume>(scene.nodes.begin()->second.content).grid)->size;
    };
    scene::VolumeSource hints;
    hints.size = glm::ivec3(8);
    hints.type = scene::VoxelType::uint8;
    for (const char* name : {"vol.dat", "vol", "vol.bin", "vol.v1"}) {
        EXPECT_EQ(size_of(folder.write(name, ramp_bytes()).string(), hints), glm::ivec3(8)) << name;
    }
    EXPECT_EQ(size_of(folder.write("ramp_8x8x8_u8.img", ramp_bytes()).string(), {}), glm::ivec3(8));
    EXPECT_EQ(size_of(folder.write("RAMP_8x8x8_U8.RAW", ramp_bytes()).string(), {}), glm::ivec3(8));
    folder.write("SIDE.JSON", R"({"size": [8, 8, 8], "type": "uint8"})");
    EXPECT_EQ(size_of(folder.write("SIDE.RAW", ramp_bytes()).string(), {}), glm::ivec3(8));
    const std::string riddle = folder.write("bell.dat", bell_bytes()).string();
    const std::string sentence = refusal([&] { open_files(std::vector{riddle}, {}, {}); });
    EXPECT_TRUE(contains(sentence, "likely are --dims 16x16x16 --type uint8")) << sentence;
    EXPECT_TRUE(contains(describe_file(riddle, {}), "--dims 16x16x16 --type uint8"));
    EXPECT_TRUE(contains(describe_file(folder.write("BELL.RAW", bell_bytes()).string(), {}), "unknown layout"));
    EXPECT_TRUE(
        contains(refusal([&] { open_files(std::vector{folder.write("a.dcm", bell_bytes()).string()}, {}, {}); }),
                 "'.dcm' is not read, and its first bytes are of no format that is known"));
    const scene::Scene mesh =
        open_files(std::vector{folder.write("T.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string()}, {}, {});
    EXPECT_EQ(mesh.nodes.size(), 1U);
    EXPECT_TRUE(
        open_files(std::vector{folder.write("S.JSON", R"({"bruma_scene": 1})").string()}, {}, {}).nodes.empty());
    EXPECT_TRUE(contains(refusal([&] { open_files(std::vector{folder.path().string()}, {}, {}); }), "is a folder"));
}

TEST(Open, HintsTellWhatSeveralFilesLeaveOpen) {
    const TemporaryFolder folder;
    const std::string named = folder.write("ramp_8x8x8_uint8.raw", ramp_bytes()).string();
    const std::string nameless = folder.write("bell.raw", bell_bytes()).string();
    scene::VolumeSource hints;
    hints.size = glm::ivec3(16);
    hints.type = scene::VoxelType::uint8;
    const scene::Scene both = open_files(std::vector{named, nameless}, hints, {});
    EXPECT_EQ((*volume_of(both, "ramp").grid)->size, glm::ivec3(8));
    EXPECT_EQ((*volume_of(both, "bell").grid)->size, glm::ivec3(16));
    // An option that no file takes is a mistake; of a single file it is the last word.
    hints.size = glm::ivec3(4, 8, 16);
    const std::string other = folder.write("other_8x8x8_uint8.raw", ramp_bytes()).string();
    EXPECT_TRUE(contains(refusal([&] {
                             open_files(std::vector{named, other}, hints, {});
                         }),
                         "--dims holds for none of the 2 files"));
    EXPECT_EQ((*volume_of(open_files(std::vector{named}, hints, {}), "ramp").grid)->size, glm::ivec3(4, 8, 16));
}

TEST(Open, AFailedAdditionLeavesTheSceneAlone) {
    const TemporaryFolder folder;
    const std::string file = folder.write("ramp_8x8x8_uint8.raw", ramp_bytes()).string();
    scene::Scene scene = open_files(std::vector{file}, {}, {});
    const auto before = to_json(scene);
    EXPECT_NE(refusal([&] { add_file(scene, (folder / "none.raw").string(), {}); }), "");
    EXPECT_NE(refusal([&] { add_file(scene, folder.write("s.json", R"({"bruma_scene": 1})").string(), {}); }), "");
    EXPECT_EQ(to_json(scene), before);
    add_file(scene, file, {});
    EXPECT_EQ(scene.nodes.size(), 2U);
}

TEST(SceneFile, PathsFollowTheFile) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "data");
    std::filesystem::create_directories(folder / "scenes");
    const std::string file = folder.write("data/ramp_8x8x8_uint8.raw", ramp_bytes()).string();
    const scene::Scene scene = open_files(std::vector{file}, {}, {});
    const auto path = folder / "scenes/one.json";
    save_scene_file(scene, path);
    std::ifstream text(path);
    EXPECT_EQ(nlohmann::json::parse(text)["nodes"]["ramp"]["source"]["file"], "../data/ramp_8x8x8_uint8.raw");
    const scene::Scene again = read_scene_file(path);
    EXPECT_EQ(to_json(again), to_json(scene));
    EXPECT_EQ((*volume_of(again, "ramp").grid)->voxels, (*volume_of(scene, "ramp").grid)->voxels);

    std::filesystem::remove(file);
    const std::string sentence = refusal([&] { read_scene_file(path); });
    EXPECT_TRUE(contains(sentence, path.string() + ": nodes.ramp.source: ")) << sentence;
    EXPECT_TRUE(contains(sentence, "no such file"));
}

TEST(SceneFile, ASettingReplacesAMissingFile) {
    const TemporaryFolder folder;
    const std::string file = folder.write("ramp_8x8x8_uint8.raw", ramp_bytes()).string();
    const std::string path = folder
                                 .write("one.json", R"({"bruma_scene": 1, "nodes": {"ramp": {"kind": "volume",
        "ambient": 0.25, "source": {"file": "gone.raw", "size": [4, 4, 4], "type": "uint16"}}}})")
                                 .string();
    const auto open = [&](const std::vector<std::string>& files, const std::vector<std::string>& settings) {
        return open_files(files, {}, settings);
    };
    EXPECT_TRUE(contains(refusal([&] { open({path}, {}); }), "gone.raw: no such file"));
    const std::vector<std::string> settings{"nodes.ramp.source.file=" + file, "volume.source.size=[8, 8, 8]",
                                            "nodes.ramp.source.type=uint8"};
    const scene::Scene scene = open({path}, settings);
    EXPECT_EQ((*volume_of(scene, "ramp").grid)->size, glm::ivec3(8));
    EXPECT_EQ(volume_of(scene, "ramp").optics->ambient, 0.25);
    EXPECT_EQ((*volume_of(open({path}, {"nodes.ramp.source={\"file\": \"" + file + "\"}"}), "ramp").grid)->size,
              glm::ivec3(8));

    // A setting for a volume that a later file adds waits for it; one for a volume that nobody adds is refused.
    const std::vector<std::string> both{path, "builtin:bucky"};
    std::vector<std::string> more = settings;
    more.emplace_back("nodes.bucky.source.spacing=[1, 1, 1]");
    more[1] = "nodes.ramp.source.size=[8, 8, 8]";
    EXPECT_EQ(open(both, more).nodes.size(), 2U);
    more.emplace_back("nodes.nobody.source.file=x.raw");
    EXPECT_TRUE(contains(refusal([&] { open(both, more); }), "there is no 'nobody' here"));
}

TEST(SceneFile, EveryBuiltinSceneCanBeSavedAndReadBack) {
    const TemporaryFolder folder;
    for (const std::string& name : scene::builtin_scene_names()) {
        const scene::Scene scene = open_files(std::vector<std::string>{"builtin:" + name}, {}, {});
        save_scene_file(scene, folder / (name + ".json"));
        EXPECT_EQ(to_json(read_scene_file(folder / (name + ".json"))), to_json(scene)) << name;
    }
}

TEST(Describe, TellsAVolumeFromTrianglesAndRiddles) {
    const TemporaryFolder folder;
    const std::string volume = describe_file(folder.write("ramp_8x8x8_u8.raw", ramp_bytes()).string(), {});
    EXPECT_TRUE(contains(volume, "size     8 x 8 x 8 (file name)")) << volume;
    EXPECT_TRUE(contains(volume, "spacing  1 x 1 x 1 mm (default)")) << volume;
    EXPECT_TRUE(contains(volume, "range    0 to 199")) << volume;
    EXPECT_TRUE(contains(describe_file(folder.write("m.raw", "0 0 0 1 0 0 0 1 0\n").string(), {}), "1 triangles"));
    const std::string riddle = describe_file(folder.write("data.raw", bell_bytes()).string(), {});
    EXPECT_TRUE(contains(riddle, "unknown layout")) << riddle;
    EXPECT_TRUE(contains(riddle, "--dims 16x16x16 --type uint8")) << riddle;
    EXPECT_TRUE(contains(describe_file("builtin:" + scene::builtin_volume_names().front(), {}), "volume"));
}

}  // namespace
}  // namespace bruma::io
