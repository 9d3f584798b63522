// Shelf: closed form for the ramp (its colour by a quadrature of the test's own), reference for the curve.
#include <cmath>

#include "drawing.h"

namespace bruma::render {
namespace {

constexpr glm::ivec2 one_pixel(1, 1);

/// Least-squares slope of log error over log step, of the errors above `floor`.
struct Fit {
    double order = 0.0;
    int points = 0;
};
Fit fit_order(const std::vector<double>& steps, const std::vector<double>& errors, double floor) {
    double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    Fit fit;
    for (std::size_t n = 0; n < steps.size(); ++n) {
        if (errors[n] > floor) {
            const double x = std::log(steps[n]), y = std::log(errors[n]);
            sx += x;
            sy += y;
            sxx += x * x;
            sxy += x * y;
            ++fit.points;
        }
    }
    fit.order = (fit.points * sxy - sx * sy) / (fit.points * sxx - sx * sx);
    return fit;
}

/// Largest error over red, green and blue of the one pixel.
double color_error(const Image& image, const glm::dvec3& expected) {
    double largest = 0.0;
    for (int k = 0; k < 3; ++k) {
        largest = std::max(largest, std::abs(image.rgba[std::size_t(k)] - expected[k]));
    }
    return largest;
}

const glm::dvec3 color_0(0.9, 0.1, 0.4), color_1(0.1, 0.8, 0.4);
constexpr double sigma_0 = 1.0, sigma_1 = 9.0;

/// Data from 0 at the far end to 1 at the near end, seen along the ramp; `u_of_share` bends it.
template <class Curve>
scene::Scene along_z(int voxels, Curve u_of_share) {
    const auto grid = grid_of({2, 2, voxels}, glm::dvec3(1.0 / voxels),
                              [&](glm::ivec3 at) { return u_of_share(at.z / double(voxels - 1)); });
    scene::Scene scene = scene_with(grid, linear_extinction(sigma_0, sigma_1, color_0, color_1));
    // From the first sample to the last one: the outer half voxels, where data are constant, would bend the ramp.
    volume_in(scene).clip = scene::ClipBox{{0.0, 0.0, 0.5 / voxels}, {1.0, 1.0, 1.0 - 0.5 / voxels}};
    scene.camera->edit([&](scene::Camera& camera) { camera.view_height = 1.0 / voxels; });
    return scene;
}

TEST_F(Drawing, Test04LinearRamp) {
    constexpr int voxels = 257;
    scene::Scene scene = along_z(voxels, [](double share) { return share; });
    const double length = (voxels - 1.0) / voxels;
    // Seen from u = 1 towards u = 0. Simpson's rule over 2^16 intervals in double.
    constexpr int intervals = 1 << 16;
    glm::dvec3 expected(0.0);
    for (int n = 0; n <= intervals; ++n) {
        const double x = double(n) / intervals;
        const double sigma = sigma_1 + x * (sigma_0 - sigma_1);
        const double tau = length * (sigma_1 * x + 0.5 * (sigma_0 - sigma_1) * x * x);
        const double weight = (n == 0 || n == intervals ? 1.0 : n % 2 == 1 ? 4.0 : 2.0) / (3.0 * intervals);
        expected += weight * length * sigma * std::exp(-tau) * glm::mix(color_1, color_0, x);
    }
    const double alpha = -std::expm1(-length * 0.5 * (sigma_0 + sigma_1));
    for (const Classification classification : both_classifications) {
        std::vector<double> steps, errors;
        for (const double step : {1.0, 2.0, 4.0, 8.0, 11.3, 16.0, 22.6, 32.0}) {
            settle(scene, classification, step, false);  // the order of the plain method
            const Image image = draw(scene, one_pixel);
            EXPECT_NEAR(image.rgba[3], alpha, 1e-5) << name_of(classification) << ", step " << step << ": exact at any";
            steps.push_back(step);
            errors.push_back(color_error(image, expected));
            report(std::string(name_of(classification)) + " colour error at step " + std::to_string(step),
                   errors.back());
        }
        const Fit fit = fit_order(steps, errors, 1e-5);
        if (classification == Classification::post) {
            report("order of post-classification", fit.order);
            EXPECT_GE(fit.points, 4);
            EXPECT_NEAR(fit.order, 2.0, 0.1);
        } else {
            // Data are linear within each segment, so pre-integration is exact at every step; what is left is float
            // and the 256 entries of the table.
            EXPECT_EQ(fit.points, 0) << "errors above 1e-5";
        }
    }
}

TEST_F(Drawing, Test04CurvedData) {
    constexpr int voxels = 1024;
    scene::Scene scene = along_z(voxels, [](double share) { return 0.05 + 0.9 * share * share; });
    const Image expected = truth(scene, one_pixel, 1e-8);
    for (const Classification classification : both_classifications) {
        std::vector<double> steps, color_errors, alpha_errors;
        for (const double step : {8.0, 11.3, 16.0, 22.6, 32.0, 45.3, 64.0}) {
            settle(scene, classification, step, false);  // the order of the plain method
            const Image image = draw(scene, one_pixel);
            steps.push_back(step);
            color_errors.push_back(color_error(image, {expected.rgba[0], expected.rgba[1], expected.rgba[2]}));
            alpha_errors.push_back(std::abs(double(image.rgba[3]) - expected.rgba[3]));
        }
        // Errors below 3e-5 hold the tables' own (256 entries) and are no measure of the step's.
        const Fit fit = fit_order(steps, color_errors, 3e-5);
        report(std::string("order of ") + name_of(classification), fit.order);
        report(std::string("largest colour error of ") + name_of(classification), color_errors.back());
        report(std::string("largest alpha error of ") + name_of(classification), alpha_errors.back());
        EXPECT_GE(fit.points, 3) << name_of(classification);
        EXPECT_NEAR(fit.order, 2.0, 0.1) << name_of(classification);
    }
}

}  // namespace
}  // namespace bruma::render
