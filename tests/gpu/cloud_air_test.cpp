// Shelf: independent reference. Clouds under a sky: the air before them, and the colour that the sun has where they
// are. The reference takes the air before each segment of a ray, pictures that before the mean distance of all of it.
#include <algorithm>

#include "cloud_scenes.h"
#include "kept_renderer.h"
#include "reference/clouds/render_clouds.h"

namespace bruma::render {
namespace {

class CloudAir : public KeptRenderer {
  protected:
    /// A closed deck of the given optics, seen from the ground or from above.
    static scene::Scene deck(double bottom_m, double top_m, double eye_m, double view_elevation_deg,
                             double vertical_angle_deg) {
        scene::Scene scene = scene::clouds_under_sky_scene();
        set_even_weather(scene, {255, 255, 255, 128});
        scene.outdoors->sky.edit([](scene::Sky& sky) { sky.shafts = false; });
        clouds_in(scene).layer.edit([&](scene::CloudLayer& layer) {
            layer.bottom_m = bottom_m;
            layer.top_m = top_m;
            layer.coverage = 1.0;
        });
        clouds_in(scene).march.edit([](scene::CloudMarch& march) {
            march.step_m = 10.0;
            march.step_growth = 0.002;
            march.grid_columns = 128;
        });
        scene.camera->edit([&](scene::Camera& camera) {
            const double elevation = glm::radians(view_elevation_deg);
            camera.eye_world = {0.0, eye_m, 0.0};
            camera.target_world = camera.eye_world + glm::dvec3(0.0, std::sin(elevation), -std::cos(elevation));
            camera.vertical_angle_deg = vertical_angle_deg;
        });
        return scene;
    }
    /// Radiance and transmittance of the clouds alone, top row first.
    Image clouds_of(const scene::Scene& scene, glm::ivec2 pixels) {
        renderer->render(scene, {pixels, 1.0});
        const gl::Texture& radiance = renderer->cloud_pictures().front()->radiance;
        Image bottom_up(pixels.x, pixels.y), image(pixels.x, pixels.y);
        radiance.download({GL_RGBA, GL_FLOAT}, bottom_up.rgba.size() * sizeof(float), bottom_up.rgba.data());
        for (int y = 0; y < pixels.y; ++y) {
            std::copy_n(bottom_up.pixel(0, pixels.y - 1 - y), std::size_t(4) * pixels.x, image.pixel(0, y));
        }
        EXPECT_TRUE(all_finite(image));
        return image;
    }
    static Image exact_clouds(const scene::Scene& scene, glm::ivec2 pixels, double step_m, double stop) {
        reference::CloudImageOptions options;
        options.fixed_step_m = step_m;
        options.fixed_sun_samples = 64;
        options.march.stop_transmittance = stop;
        options.sky_tables = {};  // as fine as those of pictures; finer ones move these by 0.3 %
        return reference::render_clouds(scene, pixels.x, pixels.y, options).image;
    }
    /// Largest difference of a channel over the brightest channel of its pixel.
    static double apart(const Image& found, const Image& exact) {
        double most = 0.0;
        for (int y = 0; y < exact.height; ++y) {
            for (int x = 0; x < exact.width; ++x) {
                const float *a = found.pixel(x, y), *b = exact.pixel(x, y);
                const double level = std::max({b[0], b[1], b[2]});
                for (int k = 0; k < 3; ++k) {
                    most = std::max(most, std::abs(double(a[k]) - b[k]) / level);
                }
            }
        }
        return most;
    }
};

TEST_F(CloudAir, ShinesBeforeBlackCloudsAndDimsWhiteOnes) {
    struct Case {
        double eye_m, view_elevation_deg, sun_elevation_deg;
    };
    for (const Case& c : {Case{2.0, 8.0, 40.0}, Case{2.0, 1.2, 40.0}, Case{2.0, 1.2, 6.0}, Case{4000.0, -8.0, 40.0},
                          Case{4000.0, -1.7, 6.0}, Case{12e3, -40.0, 40.0}}) {
        scene::Scene scene = deck(1500.0, 2200.0, c.eye_m, c.view_elevation_deg, 0.6);
        clouds_in(scene).optics.edit([](scene::CloudOptics& optics) {
            optics.albedo = 0.0;
            optics.extinction_per_m = 0.5;
        });
        scene.outdoors->sun.edit([&](scene::Sun& sun) { sun.elevation_deg = c.sun_elevation_deg; });
        const glm::ivec2 pixels(1, 3);
        const Image found = clouds_of(scene, pixels);
        const Image exact = exact_clouds(scene, pixels, 10.0, 1e-4);
        EXPECT_LE(found.pixel(0, 1)[3], 0.01F) << "closed";
        const double largest = apart(found, exact);
        // Midpoints of 4 km where the reference takes 200 m near the eye, and one distance for all of a pixel.
        EXPECT_LE(largest, 0.02) << "from " << c.eye_m << " m at " << c.view_elevation_deg << " deg, sun at "
                                 << c.sun_elevation_deg;
        report("radiance of the air, green", exact.pixel(0, 1)[1]);
        report("largest relative difference", largest);
    }
    const scene::Scene white = deck(1500.0, 2200.0, 2.0, 6.0, 10.0);
    const glm::ivec2 pixels(1, 6);
    const double largest = apart(clouds_of(white, pixels), exact_clouds(white, pixels, 20.0, 1e-4));
    // The same, and the march's own error.
    EXPECT_LE(largest, 0.02);
    report("largest relative difference of white clouds from 1 to 11 degrees", largest);
}

TEST_F(CloudAir, DimsAndReddensTheSunByTheAltitude) {
    // Thin and near, so that nothing but the sun's colour there is seen.
    for (const double bottom : {500.0, 3000.0, 9000.0}) {
        scene::Scene scene = deck(bottom, bottom + 300.0, bottom - 50.0, 50.0, 2.0);
        scene.outdoors->sun.edit([](scene::Sun& sun) { sun.elevation_deg = 4.0; });
        clouds_in(scene).optics.edit([](scene::CloudOptics& optics) {
            optics.extinction_per_m = 2e-4;
            optics.ambient = 0.0;
        });
        const Image found = clouds_of(scene, {1, 1});
        const Image exact = exact_clouds(scene, {1, 1}, 4.0, 1e-6);
        const float *a = found.pixel(0, 0), *b = exact.pixel(0, 0);
        EXPECT_LE(apart(found, exact), 0.02) << bottom;
        // The colour alone, of which no error of the density is left: the tables hold it to 6e-3.
        EXPECT_NEAR(a[2] / a[0], b[2] / b[0], 0.01) << bottom;
        report("blue over red of the light", b[2] / b[0]);
    }
}

}  // namespace
}  // namespace bruma::render
