#pragma once
#include <span>

#include "gl/object.h"

namespace bruma::gl {

/// A buffer of fixed size, filled once or again.
class Buffer : public Object<BufferTraits> {
  public:
    Buffer() = default;
    template <class T>
    Buffer(std::string_view label, std::span<const T> contents) : Object(label), bytes_(contents.size_bytes()) {
        glNamedBufferStorage(name(), GLsizeiptr(bytes_), contents.data(), GL_DYNAMIC_STORAGE_BIT);
    }
    /// Contents undefined; only shaders write it.
    Buffer(std::string_view label, std::size_t bytes) : Object(label), bytes_(bytes) {
        glNamedBufferStorage(name(), GLsizeiptr(bytes_), nullptr, 0);
    }
    void bind_storage(GLuint binding) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name()); }
    template <class T>
    void fill(std::span<const T> contents) {
        glNamedBufferSubData(name(), 0, GLsizeiptr(contents.size_bytes()), contents.data());
    }
    template <class T>
    void read(std::span<T> contents) const {
        glGetNamedBufferSubData(name(), 0, GLsizeiptr(contents.size_bytes()), contents.data());
    }
    std::size_t bytes() const { return bytes_; }

  private:
    std::size_t bytes_ = 0;
};

}  // namespace bruma::gl
