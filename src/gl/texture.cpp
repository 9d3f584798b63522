#include "gl/texture.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>

#include "base/error.h"

namespace bruma::gl {
namespace {

GLuint create(GLenum target) {
    GLuint name = 0;
    glCreateTextures(target, 1, &name);
    return name;
}

}  // namespace

Texture::Texture(GLenum target, std::string_view label, GLenum format, glm::ivec3 size, int levels, int samples)
    : Object(create(target), label), target_(target), format_(format), size_(size) {
    while (glGetError() != GL_NO_ERROR) {
    }
    switch (target) {
        case GL_TEXTURE_1D:
            glTextureStorage1D(name(), 1, format, size.x);
            break;
        case GL_TEXTURE_2D:
            glTextureStorage2D(name(), levels, format, size.x, size.y);
            break;
        case GL_TEXTURE_2D_MULTISAMPLE:
            glTextureStorage2DMultisample(name(), samples, format, size.x, size.y, GL_TRUE);
            break;
        default:
            glTextureStorage3D(name(), 1, format, size.x, size.y, size.z);
            break;
    }
    if (const GLenum error = glGetError(); error != GL_NO_ERROR) {
        // The same input would do on a machine with more room, so it is not the input that is at fault.
        throw MachineError(fmt::format("no room for the texture '{}' of {} x {} x {} ({}); a smaller {} may fit", label,
                                       size.x, size.y, size.z,
                                       error == GL_OUT_OF_MEMORY ? "out of memory" : "refused by the driver",
                                       target == GL_TEXTURE_2D_ARRAY ? "map, or fewer of them," : "picture or volume"));
    }
    if (target == GL_TEXTURE_2D_MULTISAMPLE) {
        return;  // never filtered
    }
    glTextureParameteri(name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
        glTextureParameteri(name(), wrap, GL_CLAMP_TO_EDGE);
    }
}

Texture Texture::make_1d(std::string_view label, GLenum format, int width) {
    return {GL_TEXTURE_1D, label, format, {width, 1, 1}};
}
Texture Texture::make_2d(std::string_view label, GLenum format, glm::ivec2 size) {
    return {GL_TEXTURE_2D, label, format, {size, 1}};
}
Texture Texture::make_2d_with_levels(std::string_view label, GLenum format, glm::ivec2 size) {
    return {GL_TEXTURE_2D, label, format, {size, 1}, int(std::bit_width(unsigned(std::max(size.x, size.y))))};
}
Texture Texture::make_2d_samples(std::string_view label, GLenum format, glm::ivec2 size, int samples) {
    return {GL_TEXTURE_2D_MULTISAMPLE, label, format, {size, 1}, 1, samples};
}
Texture Texture::make_3d(std::string_view label, GLenum format, glm::ivec3 size) {
    return {GL_TEXTURE_3D, label, format, size};
}

Texture Texture::make_2d_array(std::string_view label, GLenum format, glm::ivec3 size) {
    return {GL_TEXTURE_2D_ARRAY, label, format, size};
}

void Texture::upload(PixelFormat pixels, const void* data) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    switch (target_) {
        case GL_TEXTURE_1D:
            glTextureSubImage1D(name(), 0, 0, size_.x, pixels.channels, pixels.type, data);
            break;
        case GL_TEXTURE_2D:
            glTextureSubImage2D(name(), 0, 0, 0, size_.x, size_.y, pixels.channels, pixels.type, data);
            break;
        default:
            upload_slices(0, size_.z, pixels, data);
            break;
    }
}

void Texture::upload_slices(int first, int count, PixelFormat pixels, const void* data) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage3D(name(), 0, 0, 0, first, size_.x, size_.y, count, pixels.channels, pixels.type, data);
}

void Texture::download(PixelFormat pixels, std::size_t bytes, void* data) const {
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(name(), 0, pixels.channels, pixels.type, GLsizei(bytes), data);
}

void Texture::set_nearest() {
    glTextureParameteri(name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void Texture::set_repeat() {
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
        glTextureParameteri(name(), wrap, GL_REPEAT);
    }
}

void Texture::make_smaller_levels() {
    glGenerateTextureMipmap(name());
    glTextureParameteri(name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
}

Framebuffer::Framebuffer(std::string_view label, std::initializer_list<const Texture*> colors, const Texture* depth)
    : Object(label) {
    GLenum count = 0;
    for (const Texture* texture : colors) {
        attach(GL_COLOR_ATTACHMENT0 + count++, {texture});
    }
    attach(GL_DEPTH_ATTACHMENT, {depth});
    finish(label, count);
}

Framebuffer::Framebuffer(std::string_view label, std::initializer_list<Layer> colors, Layer depth) : Object(label) {
    GLenum count = 0;
    for (const Layer& layer : colors) {
        attach(GL_COLOR_ATTACHMENT0 + count++, layer);
    }
    attach(GL_DEPTH_ATTACHMENT, depth);
    finish(label, count);
}

void Framebuffer::attach(GLenum place, Layer layer) {
    if (layer.texture == nullptr) {
        return;
    }
    size_ = glm::ivec2(layer.texture->size());
    if (layer.texture->format() == GL_DEPTH32F_STENCIL8) {
        place = GL_DEPTH_STENCIL_ATTACHMENT;
    }
    if (layer.layer < 0) {
        glNamedFramebufferTexture(name(), place, layer.texture->name(), 0);
    } else {
        glNamedFramebufferTextureLayer(name(), place, layer.texture->name(), 0, layer.layer);
    }
}

void Framebuffer::finish(std::string_view label, GLenum colors) const {
    std::array<GLenum, 8> buffers{};
    for (GLenum n = 0; n < colors; ++n) {
        buffers[n] = GL_COLOR_ATTACHMENT0 + n;
    }
    glNamedFramebufferDrawBuffers(name(), GLsizei(colors), buffers.data());
    if (glCheckNamedFramebufferStatus(name(), GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        throw MachineError(fmt::format("the driver cannot draw into '{}'", label));
    }
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, name());
    glViewport(0, 0, size_.x, size_.y);
}

}  // namespace bruma::gl
