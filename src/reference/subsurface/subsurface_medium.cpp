#include "reference/subsurface/subsurface_medium.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace bruma::reference {
namespace {

void check(const SubsurfaceChannel& channel, const char* name) {
    const auto refuse = [&](const char* what, double found, const char* expected) {
        throw InputError(fmt::format("subsurface medium, {}: {} is {}, expected {}; choose another material or edit it",
                                     name, what, found, expected));
    };
    if (!(channel.sigma_a >= 0.0 && std::isfinite(channel.sigma_a))) {
        refuse("sigma_a", channel.sigma_a, "at least 0 per mm");
    }
    if (!(channel.sigma_s > 0.0 && std::isfinite(channel.sigma_s))) {
        refuse("sigma_s", channel.sigma_s, "more than 0 per mm");
    }
    if (!(std::abs(channel.g) < 1.0)) {
        refuse("g", channel.g, "a mean cosine between -1 and 1");
    }
    if (!(channel.eta >= 1.0 && std::isfinite(channel.eta))) {
        refuse("eta", channel.eta, "n_inside / n_outside of at least 1");
    }
}

}  // namespace

void check(const SubsurfaceChannel& channel) {
    check(channel, "one channel");
}

void check(const SubsurfaceMedium& medium) {
    constexpr const char* names[] = {"red", "green", "blue"};
    for (int c = 0; c < 3; ++c) {
        check(medium.channel(c), names[c]);
    }
}

DiffusionConstants diffusion_constants(const SubsurfaceChannel& channel) {
    DiffusionConstants result;
    result.sigma_s_reduced = channel.sigma_s * (1.0 - channel.g);
    result.sigma_t = channel.sigma_a + channel.sigma_s;
    result.sigma_t_reduced = channel.sigma_a + result.sigma_s_reduced;
    result.albedo_reduced = std::max(1e-3, result.sigma_s_reduced / result.sigma_t_reduced);
    result.d = 1.0 / (3.0 * result.sigma_t_reduced);
    result.sigma_tr = std::sqrt(channel.sigma_a / result.d);
    result.d_e = 2.131 * result.d / std::sqrt(result.albedo_reduced);
    return result;
}

double unscattered_extinction(const SubsurfaceChannel& channel) {
    return channel.sigma_a + channel.sigma_s * (1.0 - channel.g * channel.g);
}

double unscattered_transmittance(const SubsurfaceChannel& channel, double chord) {
    return std::exp(-unscattered_extinction(channel) * chord);
}

}  // namespace bruma::reference
