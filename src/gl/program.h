#pragma once
#include <glm/glm.hpp>
#include <initializer_list>
#include <string>
#include <unordered_map>

#include "gl/object.h"
#include "gl/shader_source.h"

namespace bruma::gl {

/// Compiles one shader and throws it away, for what the driver says of it. Throws InputError like Program.
void compile_alone(const std::filesystem::path& root, const std::string& file, const Defines& defines);

/// A linked program. Uniforms are set by name; a name that the linker dropped because nothing reads it is ignored.
class Program : public Object<ProgramTraits> {
  public:
    Program() = default;
    /// Compiles and links the files (stage by ending: .vert, .frag, .comp, .geom) found under `root`. Throws
    /// InputError with the driver's log, places given as file:line.
    Program(const std::filesystem::path& root, std::initializer_list<std::string> files, const Defines& defines);

    void use() const { glUseProgram(name()); }
    void set(const char* uniform, int value) { glProgramUniform1i(name(), at(uniform), value); }
    void set(const char* uniform, unsigned value) { glProgramUniform1ui(name(), at(uniform), value); }
    void set(const char* uniform, float value) { glProgramUniform1f(name(), at(uniform), value); }
    void set(const char* uniform, glm::vec2 v) { glProgramUniform2f(name(), at(uniform), v.x, v.y); }
    void set(const char* uniform, glm::vec3 v) { glProgramUniform3f(name(), at(uniform), v.x, v.y, v.z); }
    void set(const char* uniform, glm::vec4 v) { glProgramUniform4f(name(), at(uniform), v.x, v.y, v.z, v.w); }
    void set(const char* uniform, glm::ivec2 v) { glProgramUniform2i(name(), at(uniform), v.x, v.y); }
    void set(const char* uniform, glm::ivec3 v) { glProgramUniform3i(name(), at(uniform), v.x, v.y, v.z); }
    void set(const char* uniform, glm::ivec4 v) { glProgramUniform4i(name(), at(uniform), v.x, v.y, v.z, v.w); }
    void set(const char* uniform, const glm::mat3& m) {
        glProgramUniformMatrix3fv(name(), at(uniform), 1, GL_FALSE, &m[0][0]);
    }
    void set(const char* uniform, const glm::mat4& m) {
        glProgramUniformMatrix4fv(name(), at(uniform), 1, GL_FALSE, &m[0][0]);
    }
    /// `uniform[index]`, or a member of a struct array when `member` is given (with its dot).
    template <class T>
    void set_at(const std::string& array, int index, const std::string& member, T value) {
        set((array + "[" + std::to_string(index) + "]" + member).c_str(), value);
    }

  private:
    GLint at(const char* uniform);
    std::unordered_map<std::string, GLint> locations_;
};

}  // namespace bruma::gl
