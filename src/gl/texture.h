#pragma once
#include <glm/glm.hpp>

#include "gl/object.h"

namespace bruma::gl {

/// Format of the caller's data for an upload or a download.
struct PixelFormat {
    GLenum channels;  ///< GL_RED, GL_RGBA, GL_RED_INTEGER, ...
    GLenum type;      ///< GL_FLOAT, GL_UNSIGNED_BYTE, ...
};

/// A texture of immutable storage with one mip level unless said otherwise. Sampling is linear with clamped edges until
/// set otherwise.
class Texture : public Object<TextureTraits> {
  public:
    Texture() = default;
    static Texture make_1d(std::string_view label, GLenum format, int width);
    static Texture make_2d(std::string_view label, GLenum format, glm::ivec2 size);
    /// With all mip levels, which `make_smaller_levels` fills from the first.
    static Texture make_2d_with_levels(std::string_view label, GLenum format, glm::ivec2 size);
    static Texture make_3d(std::string_view label, GLenum format, glm::ivec3 size);
    /// With several samples in each texel, as many as asked for or a few more.
    static Texture make_2d_samples(std::string_view label, GLenum format, glm::ivec2 size, int samples);
    /// Pictures of one size on top of each other; z counts them.
    static Texture make_2d_array(std::string_view label, GLenum format, glm::ivec3 size);

    glm::ivec3 size() const { return size_; }
    GLenum format() const { return format_; }

    void upload(PixelFormat pixels, const void* data);
    /// Uploads slices [first, first + count) of a 3-D texture.
    void upload_slices(int first, int count, PixelFormat pixels, const void* data);
    void download(PixelFormat pixels, std::size_t bytes, void* data) const;

    void set_nearest();
    void set_repeat();
    /// Fills all levels below the first and samples between them.
    void make_smaller_levels();
    void bind(GLuint unit) const { glBindTextureUnit(unit, name()); }

  private:
    Texture(GLenum target, std::string_view label, GLenum format, glm::ivec3 size, int levels = 1, int samples = 1);
    GLenum target_ = 0;
    GLenum format_ = 0;
    glm::ivec3 size_{0};
};

/// A framebuffer that draws into textures, attached at construction; `depth` may be null.
class Framebuffer : public Object<FramebufferTraits> {
  public:
    Framebuffer() = default;
    Framebuffer(std::string_view label, std::initializer_list<const Texture*> colors, const Texture* depth = nullptr);
    /// A layer of an array, or a picture of its own where `layer` is negative.
    struct Layer {
        const Texture* texture = nullptr;
        int layer = -1;
    };
    Framebuffer(std::string_view label, std::initializer_list<Layer> colors, Layer depth);
    glm::ivec2 size() const { return size_; }
    /// Binds for drawing and sets the viewport to all of it.
    void bind() const;

  private:
    void attach(GLenum place, Layer layer);
    void finish(std::string_view label, GLenum colors) const;
    glm::ivec2 size_{0};
};

}  // namespace bruma::gl
