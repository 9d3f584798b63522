#include "gl/memory.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include "base/memory.h"

namespace bruma::gl {
namespace {

std::string_view text_of(const GLubyte* text) {
    return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

bool has_extension(std::string_view name) {
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint n = 0; n < count; ++n) {
        if (text_of(glGetStringi(GL_EXTENSIONS, GLuint(n))) == name) {
            return true;
        }
    }
    return false;
}

std::uint64_t free_bytes() {
    const std::string_view renderer = text_of(glGetString(GL_RENDERER));
    if (renderer.find("llvmpipe") != std::string_view::npos || renderer.find("softpipe") != std::string_view::npos) {
        return available_memory();
    }
    GLint kibibytes[4] = {0, 0, 0, 0};  // the second extension tells four numbers, the free ones first
    if (has_extension("GL_NVX_gpu_memory_info")) {
        glGetIntegerv(GL_GPU_MEMORY_INFO_CURRENT_AVAILABLE_VIDMEM_NVX, kibibytes);
    } else if (has_extension("GL_ATI_meminfo")) {
        glGetIntegerv(GL_TEXTURE_FREE_MEMORY_ATI, kibibytes);
    }
    return kibibytes[0] > 0 ? std::uint64_t(kibibytes[0]) * 1024 : std::numeric_limits<std::uint64_t>::max();
}

}  // namespace

TextureRoom texture_room() {
    TextureRoom room{free_bytes()};
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &room.longest_edge);
    return room;
}

bool takes_3d(GLenum format, glm::ivec3 size) {
    // A proxy takes the formats of the samples too, of which any will do that the format can be made from.
    glTexImage3D(GL_PROXY_TEXTURE_3D, 0, GLint(format), size.x, size.y, size.z, 0, GL_RGBA, GL_FLOAT, nullptr);
    GLint width = 0;
    glGetTexLevelParameteriv(GL_PROXY_TEXTURE_3D, 0, GL_TEXTURE_WIDTH, &width);
    return width == size.x;
}

}  // namespace bruma::gl
