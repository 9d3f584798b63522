#include "io/scene/scene_json.h"

#include <gtest/gtest.h>

#include <random>

#include "io/json/json_text.h"
#include "io/scene/scene_settings.h"
#include "io/scene/transfer_function_file.h"
#include "io_temporary_folder.h"

namespace bruma::io {
namespace {

using nlohmann::json;

/// A scene in which nothing has its default, with numbers that have no short decimal form.
scene::Scene rich_scene() {
    scene::Scene scene;
    scene.camera.emplace(scene::Camera{.projection = scene::Projection::orthographic,
                                       .eye_world = {0.1, 1.0 / 3.0, 1e-300},
                                       .target_world = {0.0, 0.0, -7.0},
                                       .up_world = {0.0, 0.6, 0.8},
                                       .vertical_angle_deg = 33.3,
                                       .view_height = 0.2,
                                       .near_distance = 1e-5});
    scene.background = scene::Background{{0.1, 0.2, 0.3}, {1.0, 2.0, 3.0}};
    scene.rendering =
        scene::RenderSettings{scene::Classification::post, false, 0.7, false, false, 0.01, scene::Jitter::blue_noise};
    scene.environment = scene::Environment{{0.2, 0.3, 0.4}};
    scene.outdoors = scene::Outdoors{scene::Sky{scene::SkyModel::preetham, false, false, 3.3, 0.5, 0.01, 0.7},
                                     scene::Sun{.placement = scene::SunPlacement::place_and_time,
                                                .elevation_deg = -1.0 / 3.0,
                                                .azimuth_deg = 200.1,
                                                .latitude_deg = -33.0,
                                                .longitude_deg = 151.2,
                                                .date = {1999, 2, 28},
                                                .hour_utc = 3.25,
                                                .irradiance = {2.0, 1.9, 1.8},
                                                .angular_radius_deg = 0.3,
                                                .limb_darkening = false},
                                     scene::Atmosphere{.planet_radius_m = 3390e3, .ground_albedo = {0.1, 0.2, 0.3}}};
    scene.display = scene::Display{-1.5, scene::ToneMap::filmic, false};
    scene.lights.emplace(
        "sun", scene::Light{scene::LightKind::spot, {0, 1, 0}, {4, 5, 6}, 33.0, 0.7, {1, 0.5, 0.1}, 3.0, false});
    scene::Node group;
    group.visible = false;
    group.transform = scene::Transform{{1, 2, 3}, {10, 20, 30}, {1, -2, 0.5}};
    scene.nodes.emplace("all", group);
    scene::Volume volume;
    volume.source = {"d/bonsai.raw",     glm::ivec3(2, 3, 4),  scene::VoxelType::int16, glm::dvec3(0.1, 0.2, 0.3),
                     scene::Endian::big, std::int64_t(1) << 40};
    volume.transfer_function = scene::TransferFunction{{0.0, 255.0},
                                                       std::array{10.0, 200.5},
                                                       {{0.0, 0.0}, {0.1, 0.25}},
                                                       {{0.0, {1, 0, 0}}, {0.5, {0, 0.1, 1}}},
                                                       {{0.25, 2.0}},
                                                       2e-3};
    volume.optics = scene::VolumeOptics{.lighting = scene::VolumeLighting::light_volume,
                                        .albedo = {0.9, 0.8, 0.7},
                                        .g = -0.6,
                                        .emission = 0.25,
                                        .surfaces = true,
                                        .highlight = scene::Highlight::phong,
                                        .density_scale = 2.0,
                                        .ambient = 0.1,
                                        .diffuse = 0.2,
                                        .specular = 0.3,
                                        .shininess = 20.0,
                                        .two_sided = false,
                                        .gradient_soft_from = 0.003,
                                        .gradient_soft_to = 0.03};
    volume.light_volume = scene::LightVolumeSettings{.mode = scene::SweepMode::paper,
                                                     .resolution = scene::LightResolution::quarter,
                                                     .precision = scene::LightPrecision::single,
                                                     .diffuse = false,
                                                     .spread = 0.2,
                                                     .near_steps = 4,
                                                     .cone_angle_deg = 20.0,
                                                     .soft_shadows = true,
                                                     .slices_per_dispatch = 2};
    volume.clip = scene::ClipBox{{0.1, 0.2, 0.3}, {0.9, 0.8, 0.7}};
    scene::Node node;
    node.parent = "all";
    node.content = volume;
    scene.nodes.emplace("bonsai", node);
    return scene;
}

std::string refusal_of(json document) {
    return refusal([&] { from_json(document, "a.json"); });
}

TEST(SceneJson, RoundTripChangesNothing) {
    const scene::Scene scene = rich_scene();
    const json document = to_json(scene);
    const scene::Scene again = from_json(parse_json(json_text(document), "text"), "");
    EXPECT_EQ(to_json(again), document);
    EXPECT_EQ(**again.camera, **scene.camera);
    EXPECT_EQ(*again.lights.at("sun"), *scene.lights.at("sun"));
    const auto& a = std::get<scene::Volume>(again.nodes.at("bonsai").content);
    const auto& b = std::get<scene::Volume>(scene.nodes.at("bonsai").content);
    EXPECT_EQ(a.source, b.source);
    EXPECT_EQ(*a.transfer_function, *b.transfer_function);
    EXPECT_EQ(*a.optics, *b.optics);
    EXPECT_EQ(*a.clip, *b.clip);
    EXPECT_EQ(*again.nodes.at("all").transform, *scene.nodes.at("all").transform);
    EXPECT_EQ(*again.rendering, *scene.rendering);
    EXPECT_EQ(*again.display, *scene.display);
    EXPECT_EQ(*again.background, *scene.background);
    ASSERT_TRUE(again.outdoors);
    EXPECT_EQ(*again.outdoors->sky, *scene.outdoors->sky);
    EXPECT_EQ(*again.outdoors->sun, *scene.outdoors->sun);
    EXPECT_EQ(*again.outdoors->atmosphere, *scene.outdoors->atmosphere);
    EXPECT_EQ(again.nodes.at("bonsai").parent, "all");
    EXPECT_FALSE(again.nodes.at("all").visible);
}

TEST(SceneJson, AnEmptySceneNeedsOnlyItsVersion) {
    const scene::Scene scene = from_json(json{{"bruma_scene", 1}}, "");
    EXPECT_FALSE(scene.camera);
    EXPECT_TRUE(scene.nodes.empty());
    EXPECT_FALSE(scene.outdoors);
}

TEST(SceneJson, RefusesOtherVersionsWithBothNumbers) {
    EXPECT_TRUE(
        contains(refusal_of(json{{"bruma_scene", 7}}), "a.json: bruma_scene is 7, but this program reads up to 1"));
    EXPECT_TRUE(contains(refusal_of(json::object()), "the key 'bruma_scene' is missing"));
    EXPECT_NE(refusal_of(json{{"bruma_scene", "1"}}), "");
    EXPECT_NE(refusal_of(json::array()), "");
}

TEST(SceneJson, NamesThePathOfEveryFault) {
    const json good = to_json(rich_scene());
    const auto with = [&](const char* pointer, const json& value) {
        json document = good;
        document[json::json_pointer(pointer)] = value;
        return refusal_of(document);
    };
    EXPECT_EQ(with("/nodes/bonsai/ambient", 20), "a.json: nodes.bonsai.ambient: 20 is above 10, the largest accepted");
    EXPECT_EQ(with("/nodes/bonsai/shininess", 0.5),
              "a.json: nodes.bonsai.shininess: 0.5 is below 1, the smallest accepted");
    EXPECT_EQ(with("/nodes/bonsai/lightning", "none"),
              "a.json: nodes.bonsai.lightning: unknown key; did you mean 'lighting'?");
    EXPECT_EQ(with("/nodes/bonsai/lighting", "gradiant"),
              "a.json: nodes.bonsai.lighting: unknown word 'gradiant'; did you mean 'gradient'?");
    EXPECT_EQ(with("/camera/eye", "here"),
              "a.json: camera.eye: found \"here\", expected an array of 3 numbers, along x, y, z");
    EXPECT_EQ(with("/camera/eye/1", "y"), "a.json: camera.eye.1: found \"y\", expected a number in m");
    EXPECT_EQ(with("/nodes/bonsai/source/size", {1, 2, 2.5}),
              "a.json: nodes.bonsai.source.size.2: found 2.5, expected a whole number");
    EXPECT_NE(with("/nodes/bonsai/source/size", {1, 2, 4294967297}), "");
    EXPECT_NE(with("/nodes/bonsai/source/offset", 18446744073709551615ULL), "");
    EXPECT_EQ(with("/nodes/bonsai/transfer_function/opacity/1/1", 1.5),
              "a.json: nodes.bonsai.transfer_function.opacity.1.1: 1.5 is above 1, the largest accepted");
    EXPECT_EQ(with("/nodes/bonsai/visible", 1), "a.json: nodes.bonsai.visible: found 1, expected true or false");
    EXPECT_EQ(with("/nodes/bonsai/parent", "al"),
              "a.json: nodes.bonsai: its parent 'al' does not exist; did you mean 'all'?");
    EXPECT_TRUE(contains(with("/nodes/all/parent", "bonsai"), "form a circle"));
    EXPECT_TRUE(contains(with("/nodes/all/kind", "cloud"), "nodes.all.kind: unknown word 'cloud'"));
    EXPECT_TRUE(contains(with("/lights/sun/on", nullptr), "lights.sun.on: found null, expected true or false"));
    EXPECT_TRUE(contains(with("/lightz", json::object()), "lightz: unknown key; did you mean 'lights'?"));
    EXPECT_TRUE(contains(with("/nodes/bonsai/source/file", ""), "a volume needs a file"));
}

TEST(SceneJson, BrokenTextIsToldByLineAndColumn) {
    const std::string sentence = refusal([] { parse_json("{\n  \"a\": [1, 2\n}\n", "s.json"); });
    EXPECT_TRUE(sentence.starts_with("s.json:3:1: broken JSON, ")) << sentence;
    EXPECT_TRUE(contains(sentence, "expected ']'")) << sentence;
    EXPECT_TRUE(contains(refusal([] { parse_json(R"({"a": {"b": 1, "b": 2}})", "s.json"); }), "'b' is given twice"));
    EXPECT_EQ(refusal([] { parse_json(R"({"a": {"b": 1}, "b": [{"b": 1}, {"b": 2}]})", "s.json"); }), "");
    EXPECT_NE(refusal([] { parse_json(R"({"a": 1e999})", "s.json"); }), "");
    EXPECT_NE(refusal([] { parse_json("", "s.json"); }), "");
    EXPECT_NE(refusal([] { parse_json(std::string(100000, '['), "s.json"); }), "");
}

TEST(SceneSettings, ReachEveryFieldByItsPath) {
    json document = to_json(rich_scene());
    apply_setting(document, "nodes.bonsai.lighting=none");
    apply_setting(document, "volume.transfer_function.reference_length=0.25");
    apply_setting(document, "nodes.bonsai.transfer_function.opacity.1.0=0.75");
    apply_setting(document, "light.intensity=9");
    apply_setting(document, "camera.eye=[1, 2, 3]");
    apply_setting(document, "volume.source.file=1234");
    apply_setting(document, "nodes.bonsai.transfer_function.window=null");
    const scene::Scene scene = from_json(document, "--set");
    const auto& volume = std::get<scene::Volume>(scene.nodes.at("bonsai").content);
    EXPECT_EQ(volume.optics->lighting, scene::VolumeLighting::none);
    EXPECT_EQ(volume.transfer_function->reference_length, 0.25);
    EXPECT_EQ(volume.transfer_function->opacity[1].position, 0.75);
    EXPECT_EQ(volume.transfer_function->window, std::nullopt);
    EXPECT_EQ(volume.source.file, "1234");
    EXPECT_EQ(scene.lights.at("sun")->intensity, 9.0);
    EXPECT_EQ((*scene.camera)->eye_world, glm::dvec3(1, 2, 3));
}

TEST(SceneSettings, VectorsMayComeWithoutBrackets) {
    json document = to_json(rich_scene());
    apply_setting(document, "nodes.bonsai.transform.scale=1, -2.5,3e2");
    apply_setting(document, "volume.source.file=1,2");
    const scene::Scene scene = from_json(document, "--set");
    EXPECT_EQ(scene.nodes.at("bonsai").transform->scale, glm::dvec3(1, -2.5, 300));
    EXPECT_EQ(std::get<scene::Volume>(scene.nodes.at("bonsai").content).source.file, "1,2") << "text stays text";
    apply_setting(document, "nodes.bonsai.transform.scale=1,2");
    EXPECT_TRUE(contains(refusal([&] { from_json(document, ""); }), "expected an array of 3 numbers"));
}

TEST(SceneSettings, ADecimalCommaIsAPointWhereOneNumberStands) {
    json document = to_json(rich_scene());
    apply_setting(document, "nodes.bonsai.density_scale=0,5");
    EXPECT_EQ(document["nodes"]["bonsai"]["density_scale"], 0.5);
    apply_setting(document, "display.exposure=-1,25");
    EXPECT_EQ(document["display"]["exposure"], -1.25);
    apply_setting(document, "display.exposure=1,5e-1");
    EXPECT_EQ(document["display"]["exposure"], 0.15);
    apply_setting(document, "camera.eye.0=2,5");
    EXPECT_EQ(document["camera"]["eye"][0], 2.5);
    // Three numbers are a vector as before, and two a pair.
    apply_setting(document, "camera.eye=1,2,3");
    EXPECT_EQ(document["camera"]["eye"], json({1, 2, 3}));
    apply_setting(document, "nodes.bonsai.transfer_function.window=0,5");
    EXPECT_EQ(document["nodes"]["bonsai"]["transfer_function"]["window"], json({0, 5}));
}

TEST(SceneSettings, ACommaThatMayPartThousandsIsAskedAbout) {
    json document = to_json(rich_scene());
    for (const char* value : {"1,000", "12,500", "-1,250"}) {
        try {
            apply_setting(document, std::string("nodes.bonsai.density_scale=") + value);
            ADD_FAILURE() << value;
        } catch (const InputError& fault) {
            EXPECT_NE(std::string(fault.what()).find("thousands or decimals"), std::string::npos) << fault.what();
        }
    }
    // Nobody parts these.
    for (const char* value : {"0,125", "1234,567", "0,000"}) {
        EXPECT_NO_THROW(apply_setting(document, std::string("nodes.bonsai.density_scale=") + value)) << value;
    }
}

TEST(SceneSettings, TakeHyphensForUnderscoresInWords) {
    const scene::Scene scene;
    json document = to_json(scene);
    apply_setting(document, "rendering.jitter=blue-noise");
    EXPECT_EQ(from_json(document, "").rendering->jitter, scene::Jitter::blue_noise);
    EXPECT_EQ(to_json(from_json(document, ""))["rendering"]["jitter"], "blue_noise") << "saved in one spelling";
    document["rendering"]["jitter"] = "blue_noise";
    EXPECT_EQ(from_json(document, "").rendering->jitter, scene::Jitter::blue_noise);
    document["rendering"]["jitter"] = "blue noise";
    EXPECT_TRUE(contains(refusal([&] { from_json(document, ""); }), "did you mean 'blue_noise'?"));
}

TEST(SceneSettings, ChangeACameraThatNobodyHasChosen) {
    json document = to_json(scene::Scene{});
    apply_setting(document, "camera.vertical_angle=50");
    EXPECT_EQ((*from_json(document, "").camera)->vertical_angle_deg, 50.0);
}

TEST(SceneSettings, OneOfSkySunAndAirLeadsOutdoors) {
    for (const char* const setting : {"sky.model=preetham", "sun.elevation=10", "atmosphere.mie_g=0.5"}) {
        json document = to_json(scene::Scene{});
        apply_setting(document, setting);
        EXPECT_TRUE(from_json(document, "").outdoors) << setting;
    }
    json document = to_json(scene::Scene{});
    apply_setting(document, "sun.elevation=10");
    const scene::Scene scene = from_json(document, "");
    EXPECT_EQ(*scene.outdoors->sun, scene::Sun{.elevation_deg = 10.0});
    EXPECT_EQ(*scene.outdoors->sky, scene::Sky{});
    apply_setting(document, "sun.date=[2023, 2, 29]");
    EXPECT_TRUE(contains(refusal([&] { from_json(document, ""); }), "2023-2-29 is no date"));
}

TEST(SceneSettings, KnowNodesWithDotsInTheirNames) {
    json document = to_json(rich_scene());
    document["nodes"]["a.b"] = document["nodes"]["bonsai"];
    apply_setting(document, "nodes.a.b.ambient=0.5");
    EXPECT_EQ(document["nodes"]["a.b"]["ambient"], 0.5);
}

TEST(SceneSettings, AnswerUnknownPathsWithTheNearest) {
    json document = to_json(rich_scene());
    const json before = document;
    const auto fault = [&](const char* setting) { return refusal([&] { apply_setting(document, setting); }); };
    EXPECT_EQ(fault("volume.lightning=none"),
              "--set volume.lightning=none: there is no 'lightning' here; did you mean 'lighting'?");
    EXPECT_TRUE(contains(fault("node.bonsai.ambient=1"), "did you mean 'nodes'?"));
    EXPECT_TRUE(contains(fault("nodes.bonsay.ambient=1"), "did you mean 'bonsai'?"));
    EXPECT_TRUE(contains(fault("volume.ambient.x=1"), "goes too far"));
    EXPECT_TRUE(contains(fault("camera.eye.3=1"), "no index of an array of 3 parts"));
    EXPECT_TRUE(contains(fault("volume"), "expected PATH=VALUE"));
    EXPECT_TRUE(contains(fault("ambient=1"), "expected PATH=VALUE"));
    EXPECT_TRUE(contains(fault("=1"), "expected PATH=VALUE"));
    EXPECT_EQ(document, before);
    json empty = to_json(scene::Scene{});
    EXPECT_TRUE(
        contains(refusal([&] { apply_setting(empty, "volume.ambient=1"); }), "there is no volume in the scene"));
}

TEST(TransferFunctionFile, RoundTripChangesNothing) {
    const TemporaryFolder folder;
    const auto scene = rich_scene();
    const auto& tf = *std::get<scene::Volume>(scene.nodes.at("bonsai").content).transfer_function;
    save_transfer_function(tf, folder / "bone.json");
    EXPECT_EQ(load_transfer_function(folder / "bone.json"), tf);
    folder.write("notes.txt", "x");
    const auto presets = list_presets(folder.path());
    ASSERT_EQ(presets.size(), 1U);
    EXPECT_EQ(presets[0].name, "bone");
    EXPECT_TRUE(list_presets(folder / "none").empty());

    json document = to_json(scene);
    document["nodes"]["bonsai"]["transfer_function"] = "bone";
    EXPECT_EQ(to_json(from_json(document, "", {folder.path()})), to_json(scene));
    document["nodes"]["bonsai"]["transfer_function"] = "bonr";
    EXPECT_TRUE(contains(refusal([&] { from_json(document, "", {folder.path()}); }),
                         "there is no preset 'bonr'; did you mean 'bone'?"));
}

/// The text with a few bytes removed, inserted, changed or copied.
std::string with_broken_text(std::string text, std::mt19937& random) {
    static const std::vector<std::string> pieces{"{",
                                                 "}",
                                                 "[",
                                                 "]",
                                                 ",",
                                                 ":",
                                                 "\"",
                                                 "null",
                                                 "-1",
                                                 "1e999",
                                                 "NaN",
                                                 "\\u0000",
                                                 "\xff",
                                                 "\"a\"",
                                                 "{}",
                                                 "[]",
                                                 "99999999999999999999",
                                                 "\n"};
    const auto below = [&](std::size_t n) { return std::size_t(random() % std::max<std::size_t>(n, 1)); };
    for (std::size_t n = 1 + below(3); n > 0; --n) {
        const std::size_t at = below(text.size());
        switch (random() % 4) {
            case 0:
                text.erase(at, 1 + below(8));
                break;
            case 1:
                text.insert(at, pieces[below(pieces.size())]);
                break;
            case 2:
                text[at] = char(random() % 256);
                break;
            default:
                text.insert(at, text.substr(below(text.size()), below(40)));
                break;
        }
    }
    return text;
}

/// The document with up to two of its values replaced by others: JSON without a flaw, but hardly a scene.
std::string with_other_values(const json& document, std::mt19937& random) {
    static const std::vector<json> values{0,
                                          1,
                                          0.5,
                                          -1,
                                          1e308,
                                          -1e308,
                                          5e-324,
                                          1e18,
                                          "",
                                          "a",
                                          "none",
                                          "all",
                                          "big",
                                          true,
                                          false,
                                          nullptr,
                                          "sun",
                                          2147483648LL,
                                          9223372036854775807LL,
                                          "builtin:",
                                          "int8",
                                          "volume",
                                          0.1,
                                          2};
    json flat = document.flatten();
    for (std::size_t n = 1 + random() % 2; n > 0; --n) {
        auto place = flat.begin();
        std::advance(place, std::ptrdiff_t(random() % flat.size()));
        *place = values[random() % values.size()];
    }
    return flat.unflatten().dump();
}

TEST(TransferFunctionFile, PointsComeBackInOrder) {
    const json unsorted{{"opacity", {{0.5, 0.1}, {0.0, 0.2}}}};
    const scene::TransferFunction tf = read_transfer_function(unsorted, "tf");
    EXPECT_EQ(tf.opacity, (std::vector<scene::OpacityPoint>{{0.0, 0.2}, {0.5, 0.1}}));
    EXPECT_TRUE(contains(refusal([] {
                             read_transfer_function(json{{"domain", {1, 1}}}, "tf");
                         }),
                         "tf.domain: both ends are 1"));
}

TEST(SceneJson, MutatedTextsAreReadOrRefusedAndNothingElse) {
    const json document = to_json(rich_scene());
    const std::string good = json_text(document);
    std::mt19937 random(20240607);  // fixed, so that a failure can be looked at again
    int read = 0;
    int refused = 0;
    for (int turn = 0; turn < 2000; ++turn) {
        const std::string text = turn % 2 == 0 ? with_broken_text(good, random) : with_other_values(document, random);
        try {
            const scene::Scene scene = from_json(parse_json(text, "text"), "text");
            json_text(to_json(scene));
            ++read;
        } catch (const InputError& error) {
            EXPECT_GT(std::string(error.what()).size(), 10U);
            ++refused;
        }
    }
    EXPECT_EQ(read + refused, 2000);
    // Both ways must have been taken often, or the mutations are too weak or too strong to mean anything.
    EXPECT_GT(read, 100);
    EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace bruma::io
