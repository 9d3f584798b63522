// Clouds as part of a scene: files, settings, presets by name, weather maps from pictures.
#include "scene/clouds/clouds.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "base/error.h"
#include "io/open.h"
#include "io/picture/weather_file.h"
#include "io/scene/scene_file.h"
#include "io/scene/scene_json.h"
#include "io/scene/scene_settings.h"
#include "io_temporary_folder.h"
#include "reference/clouds/cloud_field.h"
#include "render/clouds/cloud_cells.h"
#include "scene/builtin/builtin.h"

namespace bruma::io {
namespace {

const scene::Clouds& clouds_of(const scene::Scene& scene) {
    return std::get<scene::Clouds>(scene.nodes.at("sky").content);
}

scene::Scene with(const std::string& setting) {
    const std::vector<std::string> settings{setting};
    return with_settings(scene::builtin_scene("clouds-cumulus"), settings, {}, {});
}

std::string fault_of(const std::function<void()>& act) {
    try {
        act();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no fault";
}

TEST(CloudsInScenes, SurviveFiles) {
    scene::Scene scene = scene::builtin_scene("cirrus");
    auto& clouds = std::get<scene::Clouds>(scene.nodes.at("sky").content);
    clouds.march.edit([](scene::CloudMarch& march) { march.step_m = 33.25; });
    clouds.optics.edit([](scene::CloudOptics& optics) { optics.octaves = 5; });
    scene.time.edit([](scene::Timeline& timeline) { timeline.now_s = 1234.5; });
    const TemporaryFolder folder;
    save_scene_file(scene, folder / "sky.json");
    const scene::Scene read = read_scene_file(folder / "sky.json", {}, {}, {});
    EXPECT_EQ(to_json(read), to_json(scene));
    EXPECT_EQ(read.time->now_s, 1234.5);
    EXPECT_EQ(*clouds_of(read).layer, *clouds.layer);
    EXPECT_EQ((*clouds_of(read).map)->rgba, (*clouds.map)->rgba) << "made again, the same";
}

TEST(CloudsInScenes, SettingsReachEveryPart) {
    EXPECT_EQ(clouds_of(with("clouds.coverage=0.25")).layer->coverage, 0.25);
    EXPECT_EQ(clouds_of(with("nodes.sky.coverage=0.25")).layer->coverage, 0.25);
    EXPECT_EQ(clouds_of(with("clouds.march.sun_path=cone")).march->sun_path, scene::CloudSunPath::cone);
    EXPECT_EQ(with("time.now=60").time->now_s, 60.0);
    const scene::Scene other = with("clouds.weather.variation=3");
    EXPECT_NE((*clouds_of(other).map)->rgba, (*clouds_of(scene::builtin_scene("clouds-cumulus")).map)->rgba);
    EXPECT_NE(fault_of([] { with("clouds.coverag=0.4"); }).find("did you mean 'coverage'"), std::string::npos);
    EXPECT_NE(fault_of([] { with("clouds.top=100"); }).find("top above bottom"), std::string::npos);
}

TEST(CloudsInScenes, PresetsByName) {
    EXPECT_EQ(*clouds_of(with("clouds.preset=stratus")).layer, *scene::preset_clouds(scene::CloudType::stratus).layer);
    EXPECT_EQ(*clouds_of(with("nodes.sky.preset=cirrus")).optics,
              *scene::preset_clouds(scene::CloudType::cirrus).optics);
    const std::vector<std::string> both{"clouds.preset=cirrus", "clouds.coverage=0.125"};
    const scene::Scene scene = with_settings(scene::builtin_scene("clouds-cumulus"), both, {}, {});
    EXPECT_EQ(clouds_of(scene).layer->coverage, 0.125) << "what comes later wins";
    EXPECT_EQ(clouds_of(scene).layer->bottom_m, 8500.0);
    EXPECT_NE(fault_of([] { with("clouds.preset=stratos"); }).find("did you mean 'stratus'"), std::string::npos);
    const scene::Scene from_file = from_json(
        nlohmann::json::parse(
            R"({"bruma_scene": 1, "nodes": {"sky": {"kind": "clouds", "preset": "stratus", "coverage": 0.5}}})"),
        "");
    EXPECT_EQ(clouds_of(from_file).layer->coverage, 0.5);
    EXPECT_EQ(clouds_of(from_file).layer->density, 0.2);
}

/// An uncompressed TGA picture: palette (1), colour (2) or grey (3).
void write_tga(const std::filesystem::path& path, int kind, int width, int height, int channels) {
    std::ofstream file(path, std::ios::binary);
    const auto byte = [&](int value) { file.put(char(value)); };
    const auto word = [&](int value) {
        byte(value % 256);
        byte(value / 256);
    };
    byte(0);
    byte(kind == 1 ? 1 : 0);
    byte(kind);
    word(0);
    word(kind == 1 ? 2 : 0);
    byte(kind == 1 ? 24 : 0);
    word(0);
    word(0);
    word(width);
    word(height);
    byte(8 * channels);
    byte(0x20 | (channels == 4 ? 8 : 0));  // rows from the top
    if (kind == 1) {
        for (const int value : {10, 20, 30, 40, 50, 60}) {
            byte(value);  // two colours: blue, green, red
        }
    }
    for (int n = 0; n < width * height * channels; ++n) {
        byte(kind == 1 ? n % 2 : 37 * n % 251);
    }
}

TEST(WeatherFiles, EverySortOfPicture) {
    const TemporaryFolder folder;
    write_tga(folder / "color.tga", 2, 8, 24, 4);
    const auto color = load_weather_map(folder / "color.tga");
    EXPECT_EQ(std::pair(color->width, color->height), std::pair(8, 24)) << "not square";
    EXPECT_EQ(color->rgba[0], 74) << "red stands third in the file";
    EXPECT_EQ(color->rgba[3], 111) << "alpha as it stands";
    write_tga(folder / "grey.tga", 3, 8, 8, 1);
    const auto grey = load_weather_map(folder / "grey.tga");
    EXPECT_EQ(grey->rgba[4], 37);
    EXPECT_EQ(grey->rgba[5], 37);
    EXPECT_EQ(grey->rgba[6], 255) << "tops at full height";
    EXPECT_EQ(grey->rgba[7], 128) << "neutral density";
    write_tga(folder / "palette.tga", 1, 16, 8, 1);
    const auto palette = load_weather_map(folder / "palette.tga");
    EXPECT_EQ(palette->rgba[0], 30);
    EXPECT_EQ(palette->rgba[4], 60);
    EXPECT_EQ(palette->rgba[7], 128);
}

TEST(WeatherFiles, FaultsAreOneSentence) {
    const TemporaryFolder folder;
    write_tga(folder / "small.tga", 3, 7, 9, 1);
    EXPECT_NE(
        fault_of([&] { load_weather_map(folder / "small.tga"); }).find("7 x 9 texels, but a weather map has 8 to"),
        std::string::npos);
    write_tga(folder / "wide.tga", 3, 8193, 8, 1);
    EXPECT_NE(fault_of([&] { load_weather_map(folder / "wide.tga"); }).find("8193 x 8"), std::string::npos);
    std::ofstream(folder / "broken.png") << "this is no picture";
    EXPECT_NE(fault_of([&] { load_weather_map(folder / "broken.png"); }).find("broken or unknown picture"),
              std::string::npos);
    EXPECT_NE(fault_of([&] { with("clouds.weather.file=" + (folder / "none.png").string()); }).find("none.png"),
              std::string::npos);
}

TEST(CloudCells, WhatTheyCallEmptyIsEmpty) {
    const auto noise = reference::make_cloud_noise(scene::NoisePacking::channels, 32, 16);
    std::mt19937 random(3);
    const auto unit = [&] { return double(random() >> 8U) * 0x1p-24; };
    for (std::size_t type = 0; type < scene::enum_words<scene::CloudType>().size(); ++type) {
        const scene::Cloud cloud = scene::cloud_preset(scene::CloudType(type));
        for (const int texels : {8, 300, 512}) {
            const auto map = scene::make_weather_map(cloud.weather.pattern, 2, texels);
            const render::CloudCells cells = render::make_cloud_cells(cloud.layer, *map);
            const scene::CloudBand band = scene::cloud_band(cloud.layer, map->largest());
            const reference::CloudField field(cloud.layer, map, noise);
            int cloudy = 0;
            for (int n = 0; n < 20000; ++n) {
                const glm::dvec3 share(unit(), unit(), unit());
                const double altitude = cloud.layer.bottom_m + share.y * (cloud.layer.top_m - cloud.layer.bottom_m);
                if (field.density({share.x * cloud.layer.weather_tile_m, altitude,
                                   share.z * cloud.layer.weather_tile_m}) == 0.0) {
                    continue;
                }
                ++cloudy;
                ASSERT_TRUE(altitude >= band.low_m && altitude <= band.high_m) << altitude;
                const double level = (altitude - band.low_m) / (band.high_m - band.low_m);
                const auto cell = [](double of_one, int count) {
                    return std::size_t(std::min(count - 1, int(of_one * count)));
                };
                const std::size_t edge = render::CloudCells::edge;
                ASSERT_EQ(
                    cells.distance[(cell(level, render::CloudCells::slices) * edge + cell(share.z, int(edge))) * edge +
                                   cell(share.x, int(edge))],
                    0);
            }
            EXPECT_GT(cloudy, 10) << type;
        }
    }
}

}  // namespace
}  // namespace bruma::io
