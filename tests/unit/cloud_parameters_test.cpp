// Shelf: closed form. Presets and parameters of clouds and sky: in range, readable back, and maps without seams.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "io/json/json_fields.h"
#include "scene/clouds/cloud_presets.h"
#include "scene/sky/sky.h"

namespace bruma::scene {
namespace {

/// Every value through JSON, which checks its range, and back.
template <class T>
void expect_survives_file(const T& value, const std::string& name) {
    io::json object = io::json::object();
    io::write_fields(value, object);
    EXPECT_EQ(io::read_fields<T>(object, name), value) << name;
    EXPECT_EQ(object.size(), io::field_names<T>().size()) << name << " has two fields of one name";
}

TEST(CloudParameters, PresetsAreInRangeAndSurviveFiles) {
    for (std::size_t type = 0; type < enum_words<CloudType>().size(); ++type) {
        const Cloud cloud = cloud_preset(CloudType(type));
        const std::string name(enum_words<CloudType>()[type]);
        expect_survives_file(cloud.layer, name);
        expect_survives_file(cloud.optics, name);
        expect_survives_file(cloud.weather, name);
        EXPECT_NO_THROW(check(cloud.layer, name));
        EXPECT_LE(cloud.optics.octave_strength, cloud.optics.octave_extinction) << "makes energy in thick cloud";
    }
    expect_survives_file(Atmosphere{}, "atmosphere");
    expect_survives_file(Sun{}, "sun");
    expect_survives_file(Sky{}, "sky");
}

TEST(CloudParameters, TheThesisPresetsAreAsPrinted) {
    const auto pair = [](CloudType type) {
        const Cloud cloud = cloud_preset(type);
        return std::array{cloud.layer.coverage, cloud.layer.density};
    };
    EXPECT_EQ(pair(CloudType::cumulus), (std::array{0.4, 1.0}));
    EXPECT_EQ(pair(CloudType::stratocumulus), (std::array{0.8, 0.5}));
    EXPECT_EQ(pair(CloudType::stratus), (std::array{1.0, 0.2}));
    const CloudOptics optics;
    EXPECT_EQ((std::array{optics.in_scatter, optics.out_scatter, optics.in_out_mix, optics.silver_intensity,
                          optics.silver_exponent, optics.absorption}),
              (std::array{0.2, 0.1, 0.5, 3.0, 2.0, 6.0}));
}

TEST(CloudParameters, ALayerWithoutThicknessIsTold) {
    CloudLayer layer;
    layer.top_m = layer.bottom_m;
    try {
        check(layer, "clouds.low");
        FAIL() << "no word about an empty layer";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("clouds.low"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("1500 m"), std::string::npos);
    }
}

TEST(CloudParameters, MapsHaveNoSeamAndTheirCharacter) {
    for (std::size_t n = 0; n < enum_words<WeatherPattern>().size(); ++n) {
        const auto map = make_weather_map(WeatherPattern(n), 1, 128);
        // Across the border texels differ no more than they do elsewhere.
        double inside = 0.0, across = 0.0;
        for (int row = 0; row < 128; ++row) {
            const auto at = [&](int x) { return map->sample((x + 0.5) / 128.0, (row + 0.5) / 128.0).placement; };
            across = std::max(across, std::abs(at(0) - at(127)));
            for (int x = 1; x < 128; ++x) {
                inside = std::max(inside, std::abs(at(x) - at(x - 1)));
            }
        }
        EXPECT_LE(across, inside) << n;
        EXPECT_NE(make_weather_map(WeatherPattern(n), 2, 32)->rgba, make_weather_map(WeatherPattern(n), 1, 32)->rgba);
        EXPECT_EQ(make_weather_map(WeatherPattern(n), 2, 32)->rgba, make_weather_map(WeatherPattern(n), 2, 32)->rgba);
    }
    const CloudWeather low = make_weather_map(WeatherPattern::overcast)->largest();
    EXPECT_LE(low.top, 0.36) << "stratus is low in its layer";
    EXPECT_NEAR(low.density, 0.5, 1.0 / 255.0) << "neutral";
    EXPECT_THROW(make_weather_map(WeatherPattern::towers, 1, 0), InputError);
    EXPECT_THROW(make_weather_map(WeatherPattern::towers, 1, 8193), InputError);
}

TEST(CloudParameters, MapsAreSampledBetweenTexelCentres) {
    WeatherMap map{"two", 2, 1, {0, 0, 0, 0, 255, 51, 102, 204}};
    EXPECT_EQ(map.sample(0.75, 0.3).placement, 1.0) << "at the centre of the second texel";
    EXPECT_NEAR(map.sample(0.5, 0.0).density, 0.4, 1e-15) << "halfway";
    EXPECT_NEAR(map.sample(0.0, 0.0).top, 0.2, 1e-15) << "halfway over the border";
    EXPECT_NEAR(map.sample(-3.25, 9.0).placement, 1.0, 1e-15) << "repeats";
}

}  // namespace
}  // namespace bruma::scene
