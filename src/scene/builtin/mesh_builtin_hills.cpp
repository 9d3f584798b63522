#include <array>
#include <cmath>

#include "scene/builtin/mesh_builtin.h"

namespace bruma::scene {
namespace {

constexpr int cells = 96;
constexpr double edge = 240.0;

/// Ridges of three lengths on a plain, and its slopes along x and z.
glm::dvec3 height_and_slopes(double x, double z) {
    struct Wave {
        double height, along_x, along_z, phase;
    };
    constexpr std::array<Wave, 3> waves{
        {{1.1, 0.061, 0.043, 0.4}, {0.55, -0.090, 0.118, 2.0}, {0.22, 0.21, 0.17, 4.1}}};
    glm::dvec3 sum(0.0);
    for (const Wave& wave : waves) {
        // (1 + sin)^2 is flat in the valleys and steep on the ridges.
        const double at = wave.along_x * x + wave.along_z * z + wave.phase;
        const double root = 0.5 + 0.5 * std::sin(at);
        const double slope = wave.height * root * std::cos(at);
        sum += glm::dvec3(wave.height * root * root, slope * wave.along_x, slope * wave.along_z);
    }
    return sum;
}

}  // namespace

MeshParts hills_parts() {
    MeshParts parts;
    parts.materials = {{.name = "grass", .diffuse = {0.20, 0.24, 0.11}}};
    for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) {
            const double x = edge * (double(i) / cells - 0.5), z = edge * (double(j) / cells - 0.5);
            const glm::dvec3 hill = height_and_slopes(x, z);
            parts.positions.emplace_back(x, hill.x, z);
            parts.normals.emplace_back(-hill.y, 1.0, -hill.z);
        }
    }
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
            const auto corner = [&](int a, int b) {
                const std::int32_t n = (j + b) * (cells + 1) + i + a;
                return FaceCorner{n, -1, n};
            };
            const std::array<FaceCorner, 4> face{corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0)};
            parts.add_face(face, 0);
        }
    }
    return parts;
}

}  // namespace bruma::scene
