#pragma once
#include <GL/glew.h>

#include <cstdint>
#include <glm/glm.hpp>

namespace bruma::gl {

/// Room for textures, as far as the driver tells.
struct TextureRoom {
    /// Bytes free: of graphics memory (NVX_gpu_memory_info, ATI_meminfo), of the computer's where the driver draws in
    /// software; the largest number when nothing tells.
    std::uint64_t free_bytes = 0;
    int longest_edge = 0;  ///< samples along an edge of a 3-D texture
};
TextureRoom texture_room();

/// Whether the driver would make such a 3-D texture if there were memory for it; nothing is allocated.
bool takes_3d(GLenum format, glm::ivec3 size);

}  // namespace bruma::gl
