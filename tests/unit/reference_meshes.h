#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "reference/subsurface/ray_mesh.h"

/// Meshes for tests of the reference.
namespace bruma::reference {

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
