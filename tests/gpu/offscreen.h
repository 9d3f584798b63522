#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "context/context.h"
#include "gl/shader_library.h"

namespace bruma::render {

/// The one context of the test program, opened when the first test asks for it and closed behind the last one.
class Offscreen : public testing::Environment {
  public:
    void TearDown() override;

    /// Opens the context; returns why there is none, or an empty text.
    static std::string open();
    /// Programs compiled so far, shared by all tests.
    static gl::ShaderLibrary& shaders();
};

}  // namespace bruma::render
