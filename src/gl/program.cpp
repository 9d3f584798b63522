#include "gl/program.h"

#include <fmt/core.h>

#include <vector>

#include "base/error.h"

namespace bruma::gl {
namespace {

GLenum stage_of(const std::string& file) {
    if (file.ends_with(".vert")) {
        return GL_VERTEX_SHADER;
    }
    if (file.ends_with(".frag")) {
        return GL_FRAGMENT_SHADER;
    }
    if (file.ends_with(".geom")) {
        return GL_GEOMETRY_SHADER;
    }
    if (file.ends_with(".comp")) {
        return GL_COMPUTE_SHADER;
    }
    throw InputError(file + ": a shader's name must end in .vert, .frag, .geom or .comp");
}

GLuint compile(const std::filesystem::path& root, const std::string& file, const Defines& defines) {
    const ShaderSource source = read_shader(root, file, defines);
    const GLuint shader = glCreateShader(stage_of(file));
    const char* text = source.text.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (!compiled) {
        std::string log(16384, '\0');
        GLsizei length = 0;
        glGetShaderInfoLog(shader, GLsizei(log.size()), &length, log.data());
        log.resize(std::size_t(length));
        glDeleteShader(shader);
        throw InputError(fmt::format("the shader {} does not compile:\n{}", file, map_compile_log(log, source.files)));
    }
    return shader;
}

}  // namespace

void compile_alone(const std::filesystem::path& root, const std::string& file, const Defines& defines) {
    glDeleteShader(compile(root, file, defines));
}

Program::Program(const std::filesystem::path& root, std::initializer_list<std::string> files, const Defines& defines)
    : Object(*files.begin()) {
    std::vector<GLuint> shaders;
    const auto release = [&] {
        for (const GLuint shader : shaders) {
            glDetachShader(name(), shader);
            glDeleteShader(shader);
        }
        shaders.clear();
    };
    try {
        for (const std::string& file : files) {
            shaders.push_back(compile(root, file, defines));
            glAttachShader(name(), shaders.back());
        }
    } catch (...) {
        release();
        throw;
    }
    glLinkProgram(name());
    release();
    GLint linked = 0;
    glGetProgramiv(name(), GL_LINK_STATUS, &linked);
    if (!linked) {
        std::string log(16384, '\0');
        GLsizei length = 0;
        glGetProgramInfoLog(name(), GLsizei(log.size()), &length, log.data());
        log.resize(std::size_t(length));
        throw InputError(fmt::format("the shader {} does not link:\n{}", *files.begin(), log));
    }
}

GLint Program::at(const char* uniform) {
    const auto found = locations_.find(uniform);
    if (found != locations_.end()) {
        return found->second;
    }
    return locations_[uniform] = glGetUniformLocation(name(), uniform);
}

}  // namespace bruma::gl
