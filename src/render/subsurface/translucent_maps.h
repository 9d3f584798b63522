#pragma once
#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "gl/shader_library.h"
#include "render/map_camera.h"
#include "render/mesh/mesh_passes.h"
#include "render/subsurface/body_frame.h"

/// What lamps, and cameras around it, see of a translucent body. Everything is in the body's frame, mm.
namespace bruma::render {

/// Where the lamps' light enters a body: what each of them sees of it.
struct LightMaps {
    gl::Texture points;   ///< RGBA32F array: mm; alpha: share of the light that passes the surface, 0 where none is
    gl::Texture normals;  ///< RG16 array, octahedral
    double bounding_radius = 0.0;  ///< mm
    /// What one lamp's layers hold.
    struct Drawn {
        BodyLamp lamp;
        int first_layer = 0;
        std::vector<MapCamera> cameras;  ///< one, or the six of a cube
    };
    std::vector<Drawn> lamps;
    double coarsest_texel_mm = 0.0;  ///< where the body stands
};

/// Where light leaves a body: what parallel cameras around it see.
struct ExitMaps {
    gl::Texture depth;              ///< depth array, 1 where nothing is
    gl::Texture normals;            ///< RG16 array, octahedral
    gl::Buffer cameras;             ///< for subsurface/exit_maps.glsl
    gl::Buffer see_body;            ///< texels that do, bits of subsurface/exit_texels.glsl
    std::uint32_t texel_count = 0;  ///< of these
    double texel_mm = 0.0;          ///< largest
    int maps = 0;
    /// Words of 32 bits that hold one bit for each texel of a row, and of all rows.
    std::uint32_t row_words() const { return (std::uint32_t(depth.size().x) + 31) / 32; }
    std::uint32_t words() const { return row_words() * std::uint32_t(depth.size().y) * std::uint32_t(depth.size().z); }
    /// EXIT_MAPS of subsurface/exit_light.glsl: few different ones, since each is a shader of its own.
    std::string room() const { return std::to_string(std::max(8, (maps + 7) / 8 * 8)); }
    /// For subsurface/exit_maps.glsl.
    void bind_cameras() const { glBindBufferBase(GL_UNIFORM_BUFFER, 1, cameras.name()); }
};

/// Which texels the camera's pixels look up, of each body by name: bits of subsurface/exit_texels.glsl.
struct MapReads {
    std::map<std::string, gl::Buffer> of;
};

/// A body ready to be looked at.
struct SeenBody {
    const MeshBuffers& buffers;
    const scene::TriangleMesh& triangles;
    glm::dmat3 body_from_model{1.0};
};
/// A mesh that may stand in its light.
struct SeenShade {
    const MeshBuffers& buffers;
    glm::dmat4 body_from_model{1.0};  ///< of the model's own coordinates, metres
};

/// Uniforms of subsurface/body_vertex.glsl and mesh.vert.
void set_body(gl::Program& program, const glm::dmat3& body_from_model);
/// Draws what each lamp sees, `size` texels along an edge; returns words for the frame graph's table.
std::string draw_light_maps(LightMaps& out, gl::ShaderLibrary& shaders, const SeenBody& body,
                            const std::vector<SeenShade>& shades, const std::vector<BodyLamp>& lamps, double eta,
                            int size);
/// Draws what `maps` parallel cameras all around see; none leaves one layer that nobody reads.
std::string draw_exit_maps(ExitMaps& out, gl::ShaderLibrary& shaders, const SeenBody& body, int maps, int size);

}  // namespace bruma::render
