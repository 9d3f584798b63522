#pragma once
#include <cstdint>

#include "gl/object.h"

namespace bruma::gl {

struct QueryTraits {
    static constexpr GLenum identifier = GL_QUERY;
    static void destroy(GLuint name) { glDeleteQueries(1, &name); }
};

/// Counts what is drawn between `begin` and `end`.
class Query : public Object<QueryTraits> {
  public:
    Query(std::string_view label, GLenum target) : Object(create(target), label), target_(target) {}
    void begin() const { glBeginQuery(target_, name()); }
    /// Waits for the result.
    std::uint32_t end() const {
        glEndQuery(target_);
        std::uint32_t count = 0;
        glGetQueryObjectuiv(name(), GL_QUERY_RESULT, &count);
        return count;
    }

  private:
    static GLuint create(GLenum target) {
        GLuint name = 0;
        glCreateQueries(target, 1, &name);
        return name;
    }
    GLenum target_;
};

}  // namespace bruma::gl
