// Shelf: independent reference. Density and intervals of clouds as shaders find them, against double precision.
#include <cmath>
#include <random>

#include "drawing.h"
#include "gl/buffer.h"
#include "reference/clouds/cloud_field.h"
#include "reference/clouds/cloud_intervals.h"
#include "render/clouds/cloud_uniforms.h"

namespace bruma::render {
namespace {

class CloudFieldShader : public Drawing {
  protected:
    struct Value {
        float density, coverage, shape, without_detail;
    };

    std::vector<glm::vec4> evaluate(gl::Program& program, const std::vector<glm::vec4>& points) {
        const gl::Buffer in("points", std::span<const glm::vec4>(points));
        std::vector<glm::vec4> values(points.size());
        const gl::Buffer out("values", std::span<const glm::vec4>(values));
        program.use();
        in.bind_storage(0);
        out.bind_storage(1);
        glDispatchCompute(GLuint((points.size() + 63) / 64), 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        out.read(std::span<glm::vec4>(values));
        return values;
    }

    std::vector<glm::vec4> field_values(const scene::CloudLayer& layer, const scene::WeatherMap& map,
                                        const glm::dvec3& place, double time_s, const std::vector<glm::vec4>& points) {
        FrameGraph graph;
        CloudNoisePass noise(graph, shaders(), layer.packing);
        noise.update(layer.linear_coverage);
        graph.run({noise.noise.index});
        gl::Texture weather = gl::Texture::make_2d("weather under test", GL_RGBA16, {map.width, map.height});
        weather.upload({GL_RGBA, GL_UNSIGNED_BYTE}, map.rgba.data());
        weather.set_repeat();
        gl::Program& program = shaders().get("../tests/gpu/cloud_values.comp", cloud_field_defines(layer));
        GLuint unit = 0;
        set_cloud_field(program, layer, cloud_origins(layer, place, time_s), weather, *graph.product(noise.noise),
                        unit);
        return evaluate(program, points);
    }
};

/// Points around the camera, in the layer and a little beside it.
std::vector<glm::vec4> points_in(const scene::CloudLayer& layer, int count) {
    std::mt19937 random(5);
    const auto between = [&](double a, double b) { return a + (b - a) * double(random() >> 8U) * 0x1p-24; };
    std::vector<glm::vec4> points;
    const double thickness = layer.top_m - layer.bottom_m;
    for (int n = 0; n < count; ++n) {
        const double far = std::pow(10.0, between(2.0, 5.0));
        points.emplace_back(between(-far, far), between(layer.bottom_m - 0.05 * thickness, layer.top_m + 50.0),
                            between(-far, far), 0.0);
    }
    return points;
}

/// The normative noise, once for all tests: making it in double takes seconds.
std::shared_ptr<const reference::CloudNoise> normative_noise(scene::NoisePacking packing) {
    static const auto channels = reference::normative_cloud_noise();
    static const auto packed = std::make_shared<const reference::CloudNoise>(
        reference::CloudNoise{reference::packed_shape(channels->shape), reference::packed_detail(channels->detail)});
    return packing == scene::NoisePacking::packed ? packed : channels;
}

TEST_F(CloudFieldShader, DensityIsThatOfDoublePrecision) {
    const glm::dvec3 place(12345.678, 2.0, -98765.432);
    constexpr double time_s = 7200.5;
    for (std::size_t type = 0; type < scene::enum_words<scene::CloudType>().size(); ++type) {
        scene::Cloud cloud = scene::cloud_preset(scene::CloudType(type));
        if (type == 1) {
            cloud.layer.packing = scene::NoisePacking::packed;
            cloud.layer.coverage_rule = scene::CoverageRule::overlay;
        }
        cloud.layer.linear_coverage = type == 5;
        const auto map = scene::make_weather_map(cloud.weather.pattern, cloud.weather.variation, 256);
        const reference::CloudField field(cloud.layer, map, normative_noise(cloud.layer.packing), time_s);
        const auto points = points_in(cloud.layer, 4096);
        const auto found = field_values(cloud.layer, *map, place, time_s, points);
        int cloudy = 0;
        double worst = 0.0;
        for (std::size_t n = 0; n < points.size(); ++n) {
            const glm::dvec3 at = glm::dvec3(points[n]) + glm::dvec3(place.x, 0.0, place.z);
            const double exact = field.density(at);
            const reference::CloudTerms terms = field.terms(at);
            cloudy += exact > 0.0 ? 1 : 0;
            // Filtering with weights of eight bits errs by 1/512 of a texel's contrast on each axis, in the noise as in
            // the weather map; the cut by the coverage divides that by the coverage.
            const double room = (1e-3 + 2e-3) / std::max(terms.coverage, 1e-2) * terms.height_density * 1.6 + 1e-6;
            worst = std::max(worst, std::abs(found[n].x - exact) / room);
            EXPECT_GE(found[n].w, found[n].x) << "without detail there is never less";
        }
        EXPECT_GT(cloudy, 50) << type;
        EXPECT_LE(worst, 1.0) << scene::enum_words<scene::CloudType>()[type];
        report(std::string("error of the density of ") + std::string(scene::enum_words<scene::CloudType>()[type]) +
                   ", as a share of what is allowed",
               worst);
    }
}

TEST_F(CloudFieldShader, NothingSwimsAtTenMillionSeconds) {
    const scene::Cloud cloud = scene::cloud_preset(scene::CloudType::cumulus);
    const auto map = scene::make_weather_map(cloud.weather.pattern, 1, 128);
    const auto points = points_in(cloud.layer, 1024);
    // The wind has carried the pattern by whole tiles of everything: the same picture.
    const double tile = 40000.0 / cloud.layer.wind_speed_m_s;
    const auto early = field_values(cloud.layer, *map, glm::dvec3(0.0), 123.4, points);
    const auto late = field_values(cloud.layer, *map, glm::dvec3(0.0), 123.4 + 2500.0 * tile, points);
    for (std::size_t n = 0; n < points.size(); ++n) {
        ASSERT_NEAR(early[n].x, late[n].x, 1e-4);
    }
}

TEST_F(CloudFieldShader, IntervalsAreThoseOfDoublePrecision) {
    constexpr double planet = 6360e3;
    std::mt19937 random(7);
    const auto between = [&](double a, double b) { return a + (b - a) * double(random() >> 8U) * 0x1p-24; };
    std::vector<glm::vec4> rays;
    for (int n = 0; n < 20000; ++n) {
        const double altitude = std::pow(10.0, between(0.3, 4.5));
        const double climb = n % 2 ? between(-1.0, 1.0) : between(-0.1, 0.1);
        rays.emplace_back(altitude, climb, 1500.0, 4000.0);
    }
    gl::Program& program = shaders().get("../tests/gpu/cloud_values.comp", {{"INTERVALS", ""}});
    program.set("planet_radius", float(planet));
    const auto found = evaluate(program, rays);
    double worst = 0.0;
    int grazing = 0;
    for (std::size_t n = 0; n < rays.size(); ++n) {
        const auto exact =
            reference::shell_intervals<double>(planet, rays[n].x, rays[n].y, double(rays[n].z), double(rays[n].w));
        const double lengths[2] = {std::max(0.0F, found[n].y - found[n].x), std::max(0.0F, found[n].w - found[n].z)};
        for (int k = 0; k < 2; ++k) {
            const reference::Interval<double> part =
                k < exact.count ? exact.parts[std::size_t(k)] : reference::Interval<double>{};
            const double apart = std::abs(lengths[k] - (part.end - part.begin));
            // Near a tangent the discriminant cancels: chords of some hundred metres are uncertain, and harmless.
            if (apart > 1e-4 * std::max(1000.0, part.end)) {
                ++grazing;
            } else {
                worst = std::max(worst, apart / std::max(1000.0, part.end));
            }
        }
    }
    EXPECT_LE(grazing, 60) << "0.3 % of rays graze a sphere";
    report("largest relative error of a length", worst);
    report("rays that graze", grazing);
}

}  // namespace
}  // namespace bruma::render
