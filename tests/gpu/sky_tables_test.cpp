// Shelf: independent reference. The tables of the sky made by the GPU against the same quantities in double precision.
#include <cmath>

#include "reference/clouds/light_of_sky.h"
#include "sky_scenes.h"

namespace bruma::render {
namespace {

/// Texels of four floats.
struct Texels {
    int width = 0, height = 0;
    std::vector<float> values;
    glm::dvec3 at(int x, int y) const {
        const float* texel = &values[4 * (std::size_t(y) * width + x)];
        return {texel[0], texel[1], texel[2]};
    }
    glm::dvec2 coordinates(int x, int y) const { return {x / double(width - 1), y / double(height - 1)}; }
};

Texels read(const gl::Texture& texture) {
    Texels texels{texture.size().x, texture.size().y, {}};
    texels.values.resize(std::size_t(4) * texels.width * texels.height);
    texture.download({GL_RGBA, GL_FLOAT}, texels.values.size() * sizeof(float), texels.values.data());
    return texels;
}

double largest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

class SkyTables : public Drawing {
  protected:
    void SetUp() override {
        Drawing::SetUp();
        if (!IsSkipped()) {
            passes = std::make_unique<SkyPasses>(graph, shaders());
        }
    }
    void run(const scene::Scene& scene, int wanted) {
        passes->update(scene, {}, {8, 8});
        graph.run({wanted});
    }
    FrameGraph graph;
    std::unique_ptr<SkyPasses> passes;
};

TEST_F(SkyTables, Transmittance) {
    const scene::Scene scene = sky_scene(2.0, 45.0);
    const scene::Atmosphere& air = *scene.outdoors->atmosphere;
    run(scene, passes->transmittance.index);
    const Texels table = read(graph.product(passes->transmittance)->texture);
    ASSERT_EQ(table.width, 256);
    ASSERT_EQ(table.height, 64);
    double same_points = 0.0, converged = 0.0;
    for (int y = 0; y < table.height; ++y) {
        for (int x = 0; x < table.width; ++x) {
            const auto place = reference::transmittance_place(air, table.coordinates(x, y));
            const glm::dvec3 exact = reference::transmittance_to_top(air, place.altitude_m, place.climb, 40);
            same_points = std::max(same_points, largest(table.at(x, y) - exact));
            if (x % 8 == 7 && y % 4 == 0) {
                converged = std::max(converged, largest(table.at(x, y) - reference::transmittance_to_top(
                                                                             air, place.altitude_m, place.climb)));
            }
        }
    }
    // Floats hold altitudes to some millimetres and lengths to 0.1 m, of 1200 m that change the air by 1/e; 1.4e-6 was
    // measured.
    EXPECT_LE(same_points, 1e-5);
    // The error of 40 midpoints itself, 6e-3 at the horizon.
    EXPECT_LE(converged, 6.5e-3);
    report("largest difference of transmittance", same_points);
    report("the same to the converged integral", converged);
}

TEST_F(SkyTables, MultipleScattering) {
    const scene::Scene scene = sky_scene(2.0, 45.0);
    run(scene, passes->multiple_scattering.index);
    const Texels table = read(graph.product(passes->multiple_scattering)->texture);
    const reference::AtmosphereTables tables(*scene.outdoors->atmosphere);
    double apart = 0.0, mean = 0.0;
    for (int y = 0; y < table.height; ++y) {
        for (int x = 0; x < table.width; ++x) {
            const glm::dvec3 exact = tables.multiple_table().at(x, y);
            mean += exact.y / (table.width * table.height);
            // Far below the horizon both fade to nothing.
            apart = std::max(apart, largest((table.at(x, y) - exact) / (exact + 1e-4)));
        }
    }
    // The roundings of the transmittance, where the sun stands at the horizon of some sample; 5e-6 was measured.
    EXPECT_LE(apart, 1e-4);
    EXPECT_GT(mean, 0.01) << "not all black";
    report("largest relative difference of multiple scattering", apart);
}

TEST_F(SkyTables, IrradianceOfTheGround) {
    const scene::Scene scene = sky_scene(2.0, 45.0);
    run(scene, passes->irradiance.index);
    const Texels table = read(graph.product(passes->irradiance)->texture);
    const reference::AtmosphereTables tables(*scene.outdoors->atmosphere);
    double apart = 0.0;
    for (const int x : {255, 200, 150, 128, 110, 90}) {
        const double root = 2.0 * x / 255.0 - 1.0;
        const double climb = root * std::abs(root);
        const reference::SkyView view(tables, 1.0, {std::sqrt(std::max(0.0, 1.0 - climb * climb)), climb, 0.0},
                                      {96, 108}, 100);
        for (const int row : {0, 1}) {
            const glm::dvec3 exact = row == 0 ? view.planar_irradiance() : view.scalar_irradiance();
            const double relative = largest((table.at(x, row) - exact) / (exact + 1e-7));
            apart = std::max(apart, relative);
            EXPECT_LE(relative, 0.02) << "sine of the sun's elevation " << climb << ", row " << row;
        }
    }
    report("largest relative difference of the sky's irradiance", apart);
}

TEST_F(SkyTables, ViewFromAnyAltitude) {
    double worst = 0.0;
    for (const double altitude : {1.0, 1500.0, 12e3, 100e3}) {
        for (const double elevation : {80.0, 10.0, 1.0, -4.0}) {
            scene::Scene scene = sky_scene(altitude, elevation);
            scene.outdoors->atmosphere.edit([](scene::Atmosphere& air) { air.ground_albedo = glm::dvec3(0.0); });
            const scene::Atmosphere& air = *scene.outdoors->atmosphere;
            run(scene, passes->view.index);
            const SkyViewTables& view = *graph.product(passes->view);
            const Texels clear = read(view.clear), haze = read(view.haze);
            static std::unique_ptr<reference::AtmosphereTables> tables;
            if (!tables) {
                tables = std::make_unique<reference::AtmosphereTables>(air);
            }
            const double climb = std::sin(elevation * rad);
            const glm::dvec3 to_sun(std::cos(elevation * rad), climb, 0.0);
            double squares = 0.0, total = 0.0, largest_part = 0.0, brightest = 0.0;
            int count = 0;
            for (int y = 0; y<clear.height; y += y> 48 && y < 60 ? 1 : 4) {
                for (int x = 0; x < clear.width; x += 24) {
                    const auto place = reference::sky_view_place(air, altitude, clear.coordinates(x, y));
                    const double level = std::sin(place.zenith_angle);
                    const glm::dvec3 direction(
                        level * place.azimuth_cosine, std::cos(place.zenith_angle),
                        level * std::sqrt(std::max(0.0, 1.0 - place.azimuth_cosine * place.azimuth_cosine)));
                    const glm::dvec3 exact =
                        tables
                            ->air_light(altitude, direction, to_sun,
                                        y > 53 ? reference::distance_to_end(air, altitude, direction.y)
                                               : reference::distance_to_top(air, altitude, direction.y),
                                        1000)
                            .radiance;
                    const glm::dvec3 found =
                        clear.at(x, y) + haze.at(x, y) * reference::mie_phase(glm::dot(direction, to_sun), air.mie_g);
                    squares += glm::dot(found - exact, found - exact);
                    total += exact.x + exact.y + exact.z;
                    brightest = std::max(brightest, largest(exact));
                    largest_part = std::max(largest_part, largest(found - exact));
                    count += 3;
                }
            }
            const double relative = std::sqrt(squares / count) / (total / count);
            worst = std::max(worst, relative);
            // Midpoints of 40 segments where the reference takes 1000: 0.0056 at worst was measured.
            EXPECT_LE(relative, 0.008) << altitude << " m, sun " << elevation;
            EXPECT_LE(largest_part, 0.01 * brightest) << altitude << " m, sun " << elevation;
        }
    }
    report("largest RMSE of the sky view over its mean", worst);
}

TEST_F(SkyTables, LightForMatter) {
    for (const double elevation : {70.0, 12.0, 0.5, -3.0}) {
        scene::Scene scene = sky_scene(2.0, elevation);
        scene.outdoors->sun.edit([](scene::Sun& sun) { sun.irradiance = {2.0, 3.0, 4.0}; });
        run(scene, passes->light.index);
        std::array<glm::vec4, 4> found{};
        graph.product(passes->light)->buffer.read<glm::vec4>(found);
        static const auto tables = std::make_shared<const reference::AtmosphereTables>(*scene.outdoors->atmosphere);
        const reference::CloudLight exact = reference::light_of_sky(tables, *scene.outdoors->sun, 0.0);
        EXPECT_LE(largest(glm::dvec3(found[0]) - exact.to_sun_world), 1e-6);
        // The reference looks its sun up in a table of 40 midpoints.
        EXPECT_LE(largest((glm::dvec3(found[1]) - exact.sun_irradiance(0.0)) / (exact.sun_irradiance(0.0) + 0.02)),
                  0.05)
            << elevation;
        EXPECT_LE(largest((glm::dvec3(found[2]) - exact.sky_top) / exact.sky_top), 0.03) << elevation;
        EXPECT_LE(largest((glm::dvec3(found[3]) - exact.sky_bottom) / exact.sky_bottom), 0.03) << elevation;
    }
}

}  // namespace
}  // namespace bruma::render
