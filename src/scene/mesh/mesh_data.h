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

/// How a picture lies on a surface.
struct TexturePlacement {
    glm::dvec2 scale{1.0}, offset{0.0};  ///< texture coordinates are multiplied by `scale`, then `offset` is added
    bool once = false;                   ///< lies there once, from (0, 0) to (1, 1), and changes nothing around it
    double base = 0.0, gain = 1.0;       ///< its linear values are multiplied by `gain`, then `base` is added
    bool operator==(const TexturePlacement&) const = default;
};

/// What a mesh file says of a part's surface. Colours are taken as linear Rec.709.
struct MeshMaterial {
    std::string name;  ///< empty: the file names none
    glm::dvec3 diffuse{0.8};
    glm::dvec3 specular{0.0};
    double shininess = 30.0;
    std::shared_ptr<const MeshTexture> diffuse_texture = {};  ///< multiplies `diffuse`; null: none
    TexturePlacement placement = {};                          ///< of `diffuse_texture`
    glm::dvec3 emission{0.0};                                 ///< radiance that it sends of its own
    bool constant = false;                                    ///< shows its diffuse colour in any light
};

/// A surface of triangles in model space: metres from `origin`. All numbers are finite, all indices valid, every
/// triangle has an area. Never changed once it is shared.
struct TriangleMesh {
    std::string name;                            ///< file stem or builtin name, for people
    std::vector<glm::vec3> positions;            ///< metres
    std::vector<glm::vec3> normals;              ///< unit length, one per position
    std::vector<glm::vec2> texture_coordinates;  ///< one per position or none at all; (0, 0) is the lower left corner
    std::vector<glm::vec3> colors;      ///< linear factors of the diffuse colour, one per position or none at all
    std::vector<glm::uvec3> triangles;  ///< counter-clockwise seen from outside
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
