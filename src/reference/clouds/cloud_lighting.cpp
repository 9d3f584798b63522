#include "reference/clouds/cloud_lighting.h"

#include <algorithm>

#include "base/integer_hash.h"
#include "reference/clouds/cloud_phase.h"
#include "reference/interpolation.h"

namespace bruma::reference {

double silver_rim(double mu, const scene::CloudOptics& optics) {
    // pow(0, 0) has no value in GLSL: the definition here names one.
    return mu > 0.0 ? optics.silver_intensity * std::exp(optics.silver_exponent * std::log(std::min(mu, 1.0))) : 0.0;
}

double in_out_scatter(double mu, const scene::CloudOptics& optics) {
    const double towards = std::max(henyey_greenstein(mu, optics.in_scatter), silver_rim(mu, optics));
    return mix(towards, henyey_greenstein(mu, -optics.out_scatter), optics.in_out_mix);
}

double powdered_attenuation(double mu, double x, const scene::CloudOptics& optics) {
    const double attenuation = std::exp(-x);
    const double powder = -2.0 * std::expm1(-2.0 * x);
    if (optics.powder == scene::CloudPowder::everywhere) {
        return attenuation * powder;
    }
    const double towards_sun = saturate(0.5 + 0.5 * mu);
    return attenuation * mix(powder, 1.0, towards_sun * towards_sun);
}

double scattering_octaves(double mu, double sun_optical_depth, const scene::CloudOptics& optics) {
    double sum = 0.0;
    double strength = 1.0, extinction = 1.0, anisotropy = 1.0;
    for (std::int64_t n = 0; n < optics.octaves; ++n) {
        sum += strength * std::exp(-extinction * sun_optical_depth) * dual_lobe(mu, optics, anisotropy);
        strength *= optics.octave_strength;
        extinction *= optics.octave_extinction;
        anisotropy *= optics.octave_anisotropy;
    }
    return sum;
}

namespace {

/// What many scatterings of albedo below 1 leave; their number is about the optical depth.
double not_absorbed(const CloudDepths& depths, const scene::CloudOptics& optics) {
    return 1.0 / (1.0 + (1.0 - optics.albedo) * (depths.up + depths.down));
}

}  // namespace

double scattered_again(double mu, double sun_climb, const CloudDepths& depths, const scene::CloudOptics& optics) {
    const double reduced = 1.0 - scene::mean_asymmetry(optics);
    const double whole = reduced * (depths.up + depths.down);
    const double leak = (reduced * depths.down + 1.7) / (reduced * (depths.sun + depths.down) + 3.4);
    const double ahead = 0.77 * dual_lobe(mu, optics, 0.77) * std::exp(-0.32 * depths.sun);
    const double around = (0.8 + 1.25 * std::max(0.0, sun_climb)) * leak * 0.25 * std::numbers::inv_pi;
    return optics.albedo * not_absorbed(depths, optics) * whole / (whole + 0.35) * (ahead + around);
}

double share_from_above(const CloudDepths& depths, const scene::CloudOptics& optics) {
    const double reduced = 1.0 - scene::mean_asymmetry(optics);
    return (reduced * depths.down + 1.1) / (reduced * (depths.up + depths.down) + 2.2);
}

double light_on_ground_below_clouds(double sun_depth, double sun_climb, const scene::CloudOptics& optics) {
    const double depth = (1.0 - scene::mean_asymmetry(optics)) * sun_depth * sun_climb;
    return (2.0 / 3.0 + sun_climb + (2.0 / 3.0 - sun_climb) * std::exp(-depth / sun_climb)) / (4.0 / 3.0 + depth);
}

void CloudLight::set_uniform_sky(const glm::dvec3& radiance) {
    sky_radiance = [radiance](const glm::dvec3&) { return radiance; };
    sky_scalar_irradiance = 2.0 * std::numbers::pi * radiance;
    sky_planar_irradiance = std::numbers::pi * radiance;
    sky_top = sky_bottom = radiance;
}

glm::dvec3 ambient_source(const CloudLight& light, const glm::dvec3& up_world, double optical_depth_up,
                          double optical_depth_down) {
    const glm::dvec3 sky = light.sky_scalar_irradiance * (0.25 * std::numbers::inv_pi * std::exp(-optical_depth_up));
    const double climb = std::max(0.0, glm::dot(up_world, light.to_sun_world));
    const glm::dvec3 on_ground = light.sun_irradiance(0.0) * climb + light.sky_planar_irradiance;
    // Half: the lower hemisphere's 2 pi of the isotropic 1 / (4 pi).
    return sky + light.ground_albedo * on_ground * (0.5 * std::numbers::inv_pi * std::exp(-optical_depth_down));
}

glm::dvec3 diffused_ambient_source(const CloudLight& light, const glm::dvec3& up_world, const CloudDepths& depths,
                                   const scene::CloudOptics& optics) {
    const double above = share_from_above(depths, optics);
    const double reduced = 1.0 - scene::mean_asymmetry(optics);
    const double shade = 1.0 / (1.0 + 0.25 * reduced * (depths.up + depths.down));
    const double climb = std::max(0.0, glm::dot(up_world, light.to_sun_world));
    const glm::dvec3 on_ground = light.sun_irradiance(0.0) * climb + light.sky_planar_irradiance;
    // Twice what the hemispheres send without scattering: the shares are of the whole sphere.
    return not_absorbed(depths, optics) *
           (light.sky_scalar_irradiance * (0.5 * std::numbers::inv_pi * above) +
            light.ground_albedo * on_ground * (std::numbers::inv_pi * (1.0 - above) * shade));
}

const std::array<glm::dvec3, 6>& cone_kernel() {
    static const std::array<glm::dvec3, 6> kernel = [] {
        std::array<glm::dvec3, 6> made{};
        for (std::uint32_t i = 1; i <= 5; ++i) {
            const double z = 2.0 * unit_interval(pcg(2 * i - 2)) - 1.0;
            const double phi = 2.0 * std::numbers::pi * unit_interval(pcg(2 * i - 1));
            const double radius = std::sqrt(1.0 - z * z);
            made[i - 1] = {radius * std::cos(phi), z, radius * std::sin(phi)};
        }
        return made;
    }();
    return kernel;
}

std::array<ConeSample, 6> cone_samples(const scene::CloudOptics& optics, double thickness_m, double exit_m) {
    const double reach = optics.cone_length * thickness_m;
    std::array<ConeSample, 6> samples{};
    double begin = 0.0;
    for (int i = 1; i <= 6; ++i) {
        const double end = std::min(exit_m, i < 6 ? reach * (i / 5.0) * (i / 5.0) : optics.cone_far * reach);
        const double middle = 0.5 * (begin + end);
        const auto n = std::size_t(i - 1);
        samples[n] = {middle, std::max(0.0, end - begin), optics.cone_spread * middle * cone_kernel()[n]};
        begin = std::max(begin, end);
    }
    return samples;
}

}  // namespace bruma::reference
