#pragma once
#include <GL/glew.h>

#include <string_view>
#include <utility>

namespace bruma::gl {

/// An OpenGL name as a value: made in the constructor, deleted in the destructor, movable, never copied; empty after
/// a move. `Traits` says how a name is made, deleted and labelled. A label is obligatory: it stands in every driver
/// message about the object.
template <class Traits>
class Object {
  public:
    Object() = default;  ///< an empty object, on purpose
    explicit Object(std::string_view label) : name_(Traits::create()) {
        glObjectLabel(Traits::identifier, name_, GLsizei(label.size()), label.data());
    }
    Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        // Swap: the old name is deleted by `other`, also on self-move.
        std::swap(name_, other.name_);
        return *this;
    }
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;
    ~Object() {
        if (name_ != 0) {
            Traits::destroy(name_);
        }
    }
    GLuint name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

  protected:
    /// Takes over a name made elsewhere (textures need their target at creation).
    Object(GLuint name, std::string_view label) : name_(name) {
        glObjectLabel(Traits::identifier, name_, GLsizei(label.size()), label.data());
    }

  private:
    GLuint name_ = 0;
};

struct BufferTraits {
    static constexpr GLenum identifier = GL_BUFFER;
    static GLuint create() {
        GLuint name = 0;
        glCreateBuffers(1, &name);
        return name;
    }
    static void destroy(GLuint name) { glDeleteBuffers(1, &name); }
};
struct VertexArrayTraits {
    static constexpr GLenum identifier = GL_VERTEX_ARRAY;
    static GLuint create() {
        GLuint name = 0;
        glCreateVertexArrays(1, &name);
        return name;
    }
    static void destroy(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct FramebufferTraits {
    static constexpr GLenum identifier = GL_FRAMEBUFFER;
    static GLuint create() {
        GLuint name = 0;
        glCreateFramebuffers(1, &name);
        return name;
    }
    static void destroy(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct TextureTraits {
    static constexpr GLenum identifier = GL_TEXTURE;
    static void destroy(GLuint name) { glDeleteTextures(1, &name); }
};
struct ProgramTraits {
    static constexpr GLenum identifier = GL_PROGRAM;
    static GLuint create() { return glCreateProgram(); }
    static void destroy(GLuint name) { glDeleteProgram(name); }
};
using VertexArray = Object<VertexArrayTraits>;

}  // namespace bruma::gl
