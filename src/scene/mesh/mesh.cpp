#include "scene/mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace bruma::scene {

bool same_triangles(const MeshSource& a, const MeshSource& b) {
    MeshSource placed = a;
    placed.origin = b.origin;
    return placed == b;
}

glm::dvec3 shift_of(const Mesh& mesh) {
    const TriangleMesh& triangles = **mesh.triangles;
    const glm::dvec3 placed = mesh.source.origin.value_or(glm::dvec3(0.0));
    return triangles.origin - 1e-3 * triangles.millimetres_per_unit * placed;
}

SubsurfaceMedium medium_of(const MeshSurface& surface) {
    return surface.material == Material::custom ? surface.custom_medium : medium_of(surface.material);
}

MeshMaterial shown_material(const TriangleMesh& mesh, const MeshSurface& surface, std::size_t index) {
    MeshMaterial shown = mesh.materials.at(index);
    if (!surface.file_materials || shown.name.empty()) {
        shown.diffuse = surface.diffuse_color;
        shown.specular = glm::dvec3(surface.specular);
        shown.shininess = surface.shininess;
        shown.emission = glm::dvec3(0.0);
        shown.constant = false;
    }
    if (!surface.textured) {
        shown.diffuse_texture = nullptr;
    }
    return shown;
}

glm::dvec3 MeshTexture::linear_color(int x, int y) const {
    const std::size_t texel =
        4 * (std::size_t(std::clamp(y, 0, height - 1)) * std::size_t(width) + std::size_t(std::clamp(x, 0, width - 1)));
    glm::dvec3 color(0.0);
    for (int c = 0; c < 3; ++c) {
        double encoded = 0.0;
        if (bits == 16) {
            std::uint16_t sample = 0;
            std::memcpy(&sample, texels.data() + 2 * (texel + std::size_t(c)), 2);
            encoded = sample / 65535.0;
        } else {
            encoded = std::to_integer<int>(texels[texel + std::size_t(c)]) / 255.0;
        }
        // The curve of IEC 61966-2-1.
        color[c] = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    }
    return color;
}

}  // namespace bruma::scene
