#pragma once
#include <array>
#include <glm/glm.hpp>

/// What a translucent body is made of. Coefficients are in 1/mm and every length of the BSSRDF in mm; another unit may
/// be used if it is used for both, since radiance depends on their product alone.
namespace bruma::reference {

/// One colour channel. Tables that give the reduced scattering coefficient go in with g = 0.
struct SubsurfaceChannel {
    double sigma_a = 0.0;  ///< absorption, 1/mm, >= 0
    double sigma_s = 1.0;  ///< scattering, 1/mm, > 0
    double g = 0.0;        ///< mean cosine of scattering, (-1, 1)
    double eta = 1.3;      ///< n_inside / n_outside, >= 1
};

/// Red, green and blue of one body; the index is shared.
struct SubsurfaceMedium {
    glm::dvec3 sigma_a{0.0};  ///< 1/mm
    glm::dvec3 sigma_s{1.0};  ///< 1/mm
    glm::dvec3 g{0.0};
    double eta = 1.3;

    SubsurfaceChannel channel(int c) const { return {sigma_a[c], sigma_s[c], g[c], eta}; }
};

/// Throws InputError for coefficients out of range, naming the channel.
void check(const SubsurfaceMedium& medium);
void check(const SubsurfaceChannel& channel);

/// What diffusion theory makes of a channel.
struct DiffusionConstants {
    double sigma_s_reduced = 0.0;  ///< sigma_s' = sigma_s (1 - g), 1/mm
    double sigma_t = 0.0;          ///< 1/mm
    double sigma_t_reduced = 0.0;  ///< sigma_t' = sigma_a + sigma_s', 1/mm
    double albedo_reduced = 0.0;   ///< alpha' = sigma_s' / sigma_t', raised to 1e-3 where d_e would be infinite
    double d = 0.0;                ///< diffusion coefficient D = 1 / (3 sigma_t'), mm
    double sigma_tr = 0.0;         ///< effective transport coefficient sqrt(3 sigma_a sigma_t'), 1/mm
    double d_e = 0.0;              ///< extrapolation distance 2.131 D / sqrt(alpha'), mm
};
DiffusionConstants diffusion_constants(const SubsurfaceChannel& channel);

/// Extinction of light that goes straight through, 1/mm. The forward peak of the phase function, g^2 of it, counts as
/// not scattered (delta-Eddington; Joseph, Wiscombe and Weinman 1976): sigma_a + sigma_s (1 - g^2).
double unscattered_extinction(const SubsurfaceChannel& channel);
/// Share of the light inside that is left after `chord` mm without being scattered, apart from the boundaries.
double unscattered_transmittance(const SubsurfaceChannel& channel, double chord);

}  // namespace bruma::reference
