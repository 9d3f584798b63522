#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

namespace bruma::scene {

/// A picture laid over a surface. Four channels, straight alpha, sRGB-encoded, top row first, native byte order.
struct MeshTexture {
    std::string file;  ///< for people
    int width = 0, height = 0;
    int bits = 8;                   ///< per channel: 8 or 16
    std::vector<std::byte> texels;  ///< width * height * 4 * bits / 8

    /// Linear Rec.709 colour of one texel; indices are clamped to the picture.
    glm::dvec3 linear_color(int x, int y) const;
};

/// What a mesh file says of a part's surface. Colours are taken as linear Rec.709.
struct MeshMaterial {
    std::string name;  ///< empty: the file names none
    glm::dvec3 diffuse{0.8};
    glm::dvec3 specular{0.0};
    double shininess = 30.0;
    std::shared_ptr<const MeshTexture> diffuse_texture = {};  ///< multiplies `diffuse`; null: none
};

/// A surface of triangles in model space: metres from `origin`. All numbers are finite, all indices valid, every
/// triangle has an area. Never changed once it is shared.
struct TriangleMesh {
    std::string name;                            ///< file stem or builtin name, for people
    std::vector<glm::vec3> positions;            ///< metres
    std::vector<glm::vec3> normals;              ///< unit length, one per position
    std::vector<glm::vec2> texture_coordinates;  ///< one per position or none at all; (0, 0) is the lower left corner
    std::vector<glm::uvec3> triangles;           ///< counter-clockwise seen from outside
    std::vector<std::uint32_t> triangle_materials;  ///< one per triangle, into `materials`
    std::vector<MeshMaterial> materials;            ///< at least one
    double millimetres_per_unit = 1.0;              ///< how long a unit of the file was taken to be
    glm::dvec3 low{0.0}, high{0.0};                 ///< box around all positions, metres
    /// What positions are counted from, metres in the coordinates of the file. Not 0 where floats would round those
    /// coordinates too coarsely: it was taken off in double then.
    glm::dvec3 origin{0.0};
    bool closed = false;  ///< every edge has a triangle on both sides, so that there is an inside
};

}  // namespace bruma::scene
