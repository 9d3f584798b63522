#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <string>

#include "reference/dipole.h"
#include "reference/gauss_legendre.h"
#include "reference/plane_integral.h"
#include "reference/ray_mesh.h"

/// Materials and shapes for tests of subsurface scattering, with values from a program that shares no code with ours.
namespace bruma::reference {

/// A channel of a material of Jensen et al. 2001 (reduced coefficients, 1/mm), and the share of the light that enters a
/// half-space and leaves it again, at 0, 45 and 70 degrees.
struct HalfSpaceTruth {
    const char* name;
    double sigma_s, sigma_a, eta;
    double standard_dipole;            ///< total reflectance, with the exact internal reflectance
    std::array<double, 3> walk;        ///< by random walks, isotropic scattering
    std::array<double, 3> walk_error;  ///< standard error
    std::array<double, 3> dipole;      ///< the directional dipole integrated over the plane, published fits
    SubsurfaceChannel channel() const { return {sigma_a, sigma_s, 0.0, eta}; }
};
constexpr std::array<double, 3> half_space_angles_deg{0.0, 45.0, 70.0};
constexpr std::array<HalfSpaceTruth, 33> half_space_truths{{
    {"apple R",
     2.29,
     0.003,
     1.3,
     0.8465,
     {0.85597, 0.86377, 0.86944},
     {0.00072, 0.00070, 0.00069},
     {1.08522, 1.08428, 1.08421}},
    {"apple G",
     2.39,
     0.0034,
     1.3,
     0.8407,
     {0.84982, 0.85787, 0.86519},
     {0.00074, 0.00072, 0.00070},
     {1.07932, 1.07869, 1.07892}},
    {"apple B",
     1.97,
     0.046,
     1.3,
     0.5280,
     {0.53813, 0.55322, 0.56966},
     {0.00073, 0.00073, 0.00072},
     {0.74208, 0.75827, 0.77440}},
    {"chicken1 R",
     0.15,
     0.015,
     1.3,
     0.3137,
     {0.30649, 0.32359, 0.33985},
     {0.00068, 0.00069, 0.00070},
     {0.49238, 0.51844, 0.54432}},
    {"chicken1 G",
     0.21,
     0.077,
     1.3,
     0.1558,
     {0.13941, 0.14990, 0.16043},
     {0.00050, 0.00052, 0.00053},
     {0.31081, 0.34130, 0.37231}},
    {"chicken1 B",
     0.38,
     0.19,
     1.3,
     0.1265,
     {0.11135, 0.11904, 0.12913},
     {0.00047, 0.00049, 0.00050},
     {0.27913, 0.30999, 0.34166}},
    {"chicken2 R",
     0.19,
     0.018,
     1.3,
     0.3213,
     {0.31514, 0.33203, 0.34849},
     {0.00070, 0.00070, 0.00071},
     {0.50132, 0.52709, 0.55267}},
    {"chicken2 G",
     0.25,
     0.088,
     1.3,
     0.1600,
     {0.14351, 0.15454, 0.16536},
     {0.00052, 0.00053, 0.00054},
     {0.31534, 0.34576, 0.37667}},
    {"chicken2 B",
     0.32,
     0.2,
     1.3,
     0.1076,
     {0.09361, 0.10102, 0.10887},
     {0.00043, 0.00045, 0.00046},
     {0.25918, 0.29020, 0.32224}},
    {"cream R",
     7.38,
     0.0002,
     1.3,
     0.9757,
     {0.97778, 0.97866, 0.97984},
     {0.00030, 0.00030, 0.00029},
     {1.21612, 1.20797, 1.20118}},
    {"cream G",
     5.47,
     0.0028,
     1.3,
     0.9001,
     {0.90615, 0.91165, 0.91625},
     {0.00060, 0.00058, 0.00057},
     {1.13996, 1.13604, 1.13319}},
    {"cream B",
     3.15,
     0.0163,
     1.3,
     0.7248,
     {0.73727, 0.74924, 0.76273},
     {0.00064, 0.00063, 0.00062},
     {0.95806, 0.96380, 0.97001}},
    {"ketchup R",
     0.18,
     0.061,
     1.3,
     0.1639,
     {0.14668, 0.15751, 0.17080},
     {0.00052, 0.00054, 0.00055},
     {0.31962, 0.34997, 0.38079}},
    {"ketchup G",
     0.07,
     0.97,
     1.3,
     0.0063,
     {0.00531, 0.00587, 0.00640},
     {0.00005, 0.00005, 0.00005},
     {0.14764, 0.17826, 0.21186}},
    {"ketchup B",
     0.03,
     1.45,
     1.3,
     0.0018,
     {0.00156, 0.00171, 0.00188},
     {0.00001, 0.00001, 0.00001},
     {0.14141, 0.17194, 0.20564}},
    {"marble R",
     2.19,
     0.0021,
     1.5,
     0.8303,
     {0.83841, 0.84309, 0.84653},
     {0.00076, 0.00075, 0.00075},
     {1.01945, 1.01978, 1.02035}},
    {"marble G",
     2.62,
     0.0041,
     1.5,
     0.7911,
     {0.79955, 0.80425, 0.81094},
     {0.00083, 0.00082, 0.00081},
     {0.97706, 0.97862, 0.98026}},
    {"marble B",
     3,
     0.0071,
     1.5,
     0.7528,
     {0.76045, 0.76823, 0.77336},
     {0.00063, 0.00062, 0.00062},
     {0.93501, 0.93776, 0.94045}},
    {"potato R",
     0.68,
     0.0024,
     1.3,
     0.7645,
     {0.77514, 0.78674, 0.79638},
     {0.00061, 0.00060, 0.00059},
     {1.00001, 1.00359, 1.00776}},
    {"potato G",
     0.7,
     0.009,
     1.3,
     0.6126,
     {0.62442, 0.64015, 0.65463},
     {0.00071, 0.00070, 0.00069},
     {0.83663, 0.84842, 0.86034}},
    {"potato B",
     0.55,
     0.12,
     1.3,
     0.2127,
     {0.19822, 0.21183, 0.22500},
     {0.00059, 0.00060, 0.00061},
     {0.37442, 0.40375, 0.43321}},
    {"skimmilk R",
     0.7,
     0.0014,
     1.3,
     0.8150,
     {0.82494, 0.83404, 0.84274},
     {0.00078, 0.00077, 0.00075},
     {1.05274, 1.05354, 1.05510}},
    {"skimmilk G",
     1.22,
     0.0025,
     1.3,
     0.8131,
     {0.82207, 0.83168, 0.84063},
     {0.00056, 0.00055, 0.00053},
     {1.05071, 1.05161, 1.05327}},
    {"skimmilk B",
     1.9,
     0.0142,
     1.3,
     0.6824,
     {0.69541, 0.70814, 0.72251},
     {0.00067, 0.00066, 0.00065},
     {0.91265, 0.92069, 0.92908}},
    {"skin1 R",
     0.74,
     0.032,
     1.3,
     0.4360,
     {0.44004, 0.45718, 0.47493},
     {0.00074, 0.00074, 0.00073},
     {0.63644, 0.65718, 0.67772}},
    {"skin1 G",
     0.88,
     0.17,
     1.3,
     0.2274,
     {0.21414, 0.22753, 0.24037},
     {0.00063, 0.00064, 0.00065},
     {0.39120, 0.42014, 0.44915}},
    {"skin1 B",
     1.01,
     0.48,
     1.3,
     0.1310,
     {0.11619, 0.12414, 0.13335},
     {0.00049, 0.00050, 0.00052},
     {0.28399, 0.31481, 0.34638}},
    {"skin2 R",
     1.09,
     0.013,
     1.3,
     0.6227,
     {0.63353, 0.64978, 0.66452},
     {0.00071, 0.00070, 0.00069},
     {0.84777, 0.85902, 0.87043}},
    {"skin2 G",
     1.59,
     0.07,
     1.3,
     0.4334,
     {0.43673, 0.45515, 0.47315},
     {0.00073, 0.00073, 0.00073},
     {0.63331, 0.65418, 0.67485}},
    {"skin2 B",
     1.79,
     0.145,
     1.3,
     0.3435,
     {0.34015, 0.35626, 0.37346},
     {0.00071, 0.00072, 0.00072},
     {0.52763, 0.55251, 0.57716}},
    {"wholemilk R",
     2.55,
     0.0011,
     1.3,
     0.9077,
     {0.91255, 0.91786, 0.92260},
     {0.00058, 0.00056, 0.00055},
     {1.14774, 1.14340, 1.14015}},
    {"wholemilk G",
     3.21,
     0.0024,
     1.3,
     0.8809,
     {0.88865, 0.89378, 0.90070},
     {0.00065, 0.00063, 0.00061},
     {1.12049, 1.11763, 1.11578}},
    {"wholemilk B",
     3.77,
     0.014,
     1.3,
     0.7595,
     {0.77039, 0.78184, 0.79237},
     {0.00061, 0.00060, 0.00059},
     {0.99474, 0.99859, 1.00302}},
}};

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

/// A sphere of 20 * 4^level triangles with exact normals.
inline TriangleMesh sphere_mesh(double radius, int level, glm::dvec3 centre = glm::dvec3(0.0)) {
    const double golden = 0.5 * (1.0 + std::sqrt(5.0));
    TriangleMesh mesh;
    for (const double a : {-1.0, 1.0}) {
        for (const double b : {-golden, golden}) {
            mesh.normals.push_back(glm::normalize(glm::dvec3(0.0, a, b)));
            mesh.normals.push_back(glm::normalize(glm::dvec3(a, b, 0.0)));
            mesh.normals.push_back(glm::normalize(glm::dvec3(b, 0.0, a)));
        }
    }
    const double edge = 1.06;  // neighbours of an icosahedron on the unit sphere are 1.0515 apart
    for (unsigned i = 0; i < 12; ++i) {
        for (unsigned j = i + 1; j < 12; ++j) {
            for (unsigned k = j + 1; k < 12; ++k) {
                const glm::dvec3 a = mesh.normals[i];
                const glm::dvec3 b = mesh.normals[j];
                const glm::dvec3 c = mesh.normals[k];
                if (glm::length(a - b) < edge && glm::length(b - c) < edge && glm::length(c - a) < edge) {
                    const bool outward = glm::dot(glm::cross(b - a, c - a), a) > 0.0;
                    mesh.triangles.push_back(outward ? glm::uvec3(i, j, k) : glm::uvec3(i, k, j));
                }
            }
        }
    }
    for (int n = 0; n < level; ++n) {
        std::vector<glm::uvec3> finer;
        const auto between = [&](unsigned i, unsigned j) {
            mesh.normals.push_back(glm::normalize(mesh.normals[i] + mesh.normals[j]));
            return unsigned(mesh.normals.size() - 1);
        };
        for (const glm::uvec3 t : mesh.triangles) {
            const unsigned ab = between(t.x, t.y);
            const unsigned bc = between(t.y, t.z);
            const unsigned ca = between(t.z, t.x);
            for (const glm::uvec3 part :
                 {glm::uvec3(t.x, ab, ca), glm::uvec3(ab, t.y, bc), glm::uvec3(ca, bc, t.z), glm::uvec3(ab, bc, ca)}) {
                finer.push_back(part);
            }
        }
        mesh.triangles = finer;
    }
    for (const glm::dvec3 normal : mesh.normals) {
        mesh.positions.push_back(centre + radius * normal);
    }
    return mesh;
}

/// A box with flat faces.
inline TriangleMesh box_mesh(glm::dvec3 low, glm::dvec3 high) {
    TriangleMesh mesh;
    for (int corner = 0; corner < 8; ++corner) {
        mesh.positions.emplace_back((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                                    (corner & 4) != 0 ? high.z : low.z);
    }
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

}  // namespace bruma::reference
