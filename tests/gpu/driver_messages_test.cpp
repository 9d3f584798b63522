// Closed form: what the driver tells of faults is counted, so that tests fail; a shader that does not compile is not.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "gl/program.h"
#include "offscreen.h"

namespace bruma::render {
namespace {

class DriverMessages : public testing::Test {
  protected:
    void SetUp() override {
        if (const std::string why = Offscreen::open(); !why.empty()) {
            GTEST_SKIP() << "no context to draw with: " << why;
        }
        before_ = context::driver_error_count();
    }
    void TearDown() override { context::forget_driver_errors(count()); }
    int count() const { return context::driver_error_count() - before_; }

    /// Compiles a compute shader; its text is made unlike any other, so that no cache holds it.
    static void compile(const std::string& body) {
        const std::filesystem::path folder = testing::TempDir();
        std::ofstream(folder / "planted.comp")
            << "#version 450 core\n// " << std::filesystem::file_time_type::clock::now().time_since_epoch().count()
            << "\n"
            << body;
        gl::compile_alone(folder, "planted.comp", {});
    }

  private:
    int before_ = 0;
};

TEST_F(DriverMessages, AFaultyCallIsCounted) {
    glBindTexture(GL_TEXTURE_2D, 123456);
    EXPECT_EQ(count(), 1);
    while (glGetError() != GL_NO_ERROR) {
    }
}

TEST_F(DriverMessages, AVariableReadBeforeItIsWrittenIsCounted) {
    if (!context::driver_info().software) {
        GTEST_SKIP() << "drivers need not warn";
    }
    compile(
        "layout(local_size_x = 1) in;\nlayout(r32f) uniform image2D a;\n"
        "void main() { float b; imageStore(a, ivec2(0), vec4(b)); }\n");
    EXPECT_EQ(count(), 1);
}

TEST_F(DriverMessages, AShaderThatDoesNotCompileThrowsAndIsNot) {
    EXPECT_THROW(compile("no GLSL"), InputError);
    EXPECT_EQ(count(), 0);
}

}  // namespace
}  // namespace bruma::render
