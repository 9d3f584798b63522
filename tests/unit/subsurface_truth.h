#pragma once
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "half_space_truth.h"
#include "reference/plane_integral.h"
#include "reference/subsurface/dipole.h"
#include "reference_meshes.h"

/// Materials and shapes for tests of subsurface scattering, with values from a program that shares no code with ours.
namespace bruma::reference {

inline SubsurfaceMedium cream() {
    return {{0.0002, 0.0028, 0.0163}, {7.38, 5.47, 3.15}, glm::dvec3(0.0), 1.3};
}
inline SubsurfaceMedium marble() {
    return {{0.0021, 0.0041, 0.0071}, {2.19, 2.62, 3.00}, glm::dvec3(0.0), 1.5};
}
inline SubsurfaceMedium potato() {
    return {{0.0024, 0.0090, 0.12}, {0.68, 0.70, 0.55}, glm::dvec3(0.0), 1.3};
}
inline SubsurfaceMedium skin1() {
    return {{0.032, 0.17, 0.48}, {0.74, 0.88, 1.01}, glm::dvec3(0.0), 1.3};
}
inline SubsurfaceMedium ketchup() {
    return {{0.061, 0.97, 1.45}, {0.18, 0.07, 0.03}, glm::dvec3(0.0), 1.3};
}

/// Exitance over E_perp of a sphere in a directional light, in ten equal steps of the cosine from the lit pole, -1
/// to 1.
struct SphereTruth {
    const char* name;
    SubsurfaceChannel channel;
    double radius;  ///< mm
    std::array<double, 10> walk, walk_error, dipole;
};
constexpr std::array<SphereTruth, 3> sphere_truths{{
    {"marble G",
     {0.0041, 2.62, 0.0, 1.5},
     10.0,
     {0.00490, 0.00748, 0.01042, 0.01821, 0.03466, 0.10022, 0.24145, 0.39144, 0.54712, 0.67849},
     {0.00031, 0.00040, 0.00048, 0.00066, 0.00095, 0.00168, 0.00280, 0.00373, 0.00450, 0.00504},
     {0.00175, 0.00315, 0.00585, 0.01178, 0.02832, 0.09923, 0.26088, 0.44974, 0.63525, 0.81134}},
    {"potato G",
     {0.0090, 0.70, 0.0, 1.3},
     10.0,
     {0.02242, 0.03010, 0.04157, 0.05991, 0.09132, 0.15836, 0.25158, 0.34346, 0.43462, 0.51089},
     {0.00047, 0.00056, 0.00067, 0.00082, 0.00104, 0.00140, 0.00183, 0.00220, 0.00250, 0.00272},
     {0.00839, 0.01381, 0.02287, 0.03923, 0.07186, 0.15073, 0.28374, 0.42150, 0.54643, 0.65709}},
    {"ketchup R",
     {0.061, 0.18, 0.0, 1.3},
     5.0,
     {0.39624, 0.08545, 0.08206, 0.08024, 0.08392, 0.09407, 0.10071, 0.11111, 0.11612, 0.12163},
     {0.00238, 0.00091, 0.00089, 0.00087, 0.00089, 0.00095, 0.00100, 0.00105, 0.00108, 0.00111},
     {0.04613, 0.05492, 0.06690, 0.08628, 0.11412, 0.14551, 0.17414, 0.19242, 0.19951, 0.19861}},
}};

/// S_d of a flat half-space z < 0 under light at this angle, at the offset of polar coordinates (rho, phi).
inline double flat_s_d(const Dipole& dipole, double eta, double angle_deg, double rho, double phi) {
    const double angle = angle_deg * std::numbers::pi / 180.0;
    const glm::dvec3 omega_12 = refract_into({std::sin(angle), 0.0, std::cos(angle)}, {0.0, 0.0, 1.0}, eta);
    return dipole.s_d({}, omega_12, {{rho * std::cos(phi), rho * std::sin(phi), 0.0}, {0.0, 0.0, 1.0}});
}

}  // namespace bruma::reference
