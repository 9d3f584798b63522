#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "base/installation.h"
#include "io/input_file.h"
#include "io/json/json_text.h"
#include "io/open.h"
#include "io/scene/scene_file.h"
#include "io/scene/transfer_function_file.h"
#include "io/volume/known_volumes.h"
#include "io_temporary_folder.h"

namespace bruma::io {
namespace {

const scene::TransferFunction& curve_of(const scene::Scene& scene) {
    return *std::get<scene::Volume>(scene.nodes.begin()->second.content).transfer_function;
}

/// Names of all files below assets/, relative to it.
std::vector<std::string> shipped_files() {
    std::vector<std::string> names;
    const std::filesystem::path assets = installed_folder("assets");
    for (const auto& entry : std::filesystem::recursive_directory_iterator(assets)) {
        if (entry.is_regular_file()) {
            names.push_back(entry.path().lexically_relative(assets).generic_string());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

// A file that is added to assets/ is added here too, with the reader that its users come through.
TEST(ShippedAssets, AreAllKnownByName) {
    const std::vector<std::string> expected{
        "known_volumes.json",     "presets/bone.json",   "presets/bonsai.json",
        "presets/ct-head.json",   "presets/engine.json", "presets/fire.json",
        "presets/grey-ramp.json", "presets/ice.json",    "presets/isosurface-sharp.json",
        "presets/mist.json"};
    EXPECT_EQ(shipped_files(), expected);
}

// As the menu lists them and loads one by its path, as --set names one, and as a scene file names one.
TEST(ShippedAssets, EveryPresetLoadsByMenuBySettingAndBySceneFile) {
    const TemporaryFolder folder;
    const std::vector<std::filesystem::path> folders{installed_folder("assets") / "presets"};
    const std::vector<Preset> presets = list_presets(folders.front());
    ASSERT_EQ(presets.size(), 9U);
    const scene::Scene scene = open_files(std::vector<std::string>{"builtin:bucky"}, {}, {});
    for (const Preset& preset : presets) {
        SCOPED_TRACE(preset.name);
        const scene::TransferFunction curve = load_transfer_function(preset.path);
        EXPECT_GE(curve.opacity.size(), 2U);
        EXPECT_GE(curve.color.size(), 2U);
        const std::vector<std::string> settings{"volume.transfer_function=" + preset.name};
        EXPECT_EQ(curve_of(with_settings(scene, settings, {}, folders)), curve);
        const auto file = folder.write(
            "scene.json", R"({"bruma_scene": 1, "nodes": {"a": {"kind": "volume", "source": {"file": "builtin:bucky"},
                              "transfer_function": ")" +
                              preset.name + "\"}}}");
        EXPECT_EQ(curve_of(read_scene_file(file, {}, folders)), curve);
    }
}

TEST(ShippedAssets, EveryKnownVolumeIsFoundByItsNames) {
    for (const KnownVolume& entry : known_volumes()) {
        std::vector<std::string> names = entry.also;
        names.push_back(entry.name);
        for (const std::string& name : names) {
            const auto known = known_volume(name + ".raw", entry.size, entry.type, 0);
            ASSERT_TRUE(known) << name;
            EXPECT_EQ(known->name, entry.name) << name;
        }
    }
}

}  // namespace
}  // namespace bruma::io
