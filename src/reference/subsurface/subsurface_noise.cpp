#include "reference/subsurface/subsurface_noise.h"

#include <cmath>
#include <numbers>

#include "reference/plane_integral.h"

namespace bruma::reference {
namespace {

using std::numbers::pi;
const glm::dvec3 up(0.0, 0.0, 1.0);

}  // namespace

double EstimateMoments::deviation() const {
    return std::sqrt(square / (mean * mean) - 1.0);
}

EstimateMoments lit_slab_moments(const Dipole& dipole, double rate, const PlaneDensity& pdf, double end) {
    const double finest = 1e-3 * dipole.diffusion().d;
    const auto s_d = [&](double rho) { return dipole.s_d({}, -up, {{rho, 0.0, 0.0}, up}); };
    EstimateMoments moments;
    moments.mean = integrate_plane(rate, finest, s_d, end);
    moments.square = integrate_plane(
        rate, finest,
        [&](double rho) {
            const double s = s_d(rho);
            return s * s / pdf({rho, 0.0});
        },
        end);
    return moments;
}

double sphere_kernel(const Dipole& dipole, double eta, double radius, glm::dvec2 across, const SurfacePoint& exit) {
    const double height2 = radius * radius - glm::dot(across, across);
    if (height2 <= 0.0) {
        return 0.0;
    }
    const SurfacePoint entry{{across, std::sqrt(height2)}, glm::dvec3(across, std::sqrt(height2)) / radius};
    return fresnel_transmittance(entry.normal.z, eta) * dipole.s_d(entry, refract_into(up, entry.normal, eta), exit);
}

SurfacePoint on_sphere(double radius, double cosine) {
    const glm::dvec3 normal(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
    return {radius * normal, normal};
}

EstimateMoments sphere_moments(const Dipole& dipole, double eta, double radius, const SurfacePoint& exit,
                               const PlaneDensity& pdf) {
    static const GaussLegendre rule(96);
    constexpr int azimuths = 128;
    EstimateMoments moments;
    for (std::size_t n = 0; n < rule.node.size(); ++n) {
        // The rim of the sphere has a square-root edge: rho = radius (1 - t^2).
        const double t = rule.node[n];
        const double rho = radius * (1.0 - t * t);
        const double ring = rule.weight[n] * 2.0 * radius * t * rho * 2.0 * pi / azimuths;
        for (int k = 0; k < azimuths; ++k) {
            const double phi = 2.0 * pi * (k + 0.5) / azimuths;
            const glm::dvec2 across = rho * glm::dvec2(std::cos(phi), std::sin(phi));
            const double s = sphere_kernel(dipole, eta, radius, across, exit);
            moments.mean += ring * s;
            moments.square += ring * s * s / pdf(across - glm::dvec2(exit.position));
        }
    }
    return moments;
}

}  // namespace bruma::reference
