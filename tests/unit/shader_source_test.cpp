// Shelf: closed form. What the expander of shader files makes of small files.
#include "gl/shader_source.h"

#include <gtest/gtest.h>

#include "io_temporary_folder.h"

namespace bruma::gl {
namespace {

using io::contains;
using io::refusal;
using io::TemporaryFolder;

TEST(ShaderSource, DefinitionsFollowTheVersionAndLinesStayTrue) {
    const TemporaryFolder folder;
    folder.write("a.frag", "#version 450 core\nvoid main() {}\n");
    const ShaderSource source = read_shader(folder.path(), "a.frag", {{"LIT", ""}, {"VOLUMES", "2"}});
    EXPECT_EQ(source.text, "#version 450 core\n#define LIT \n#define VOLUMES 2\n#line 2 0\nvoid main() {}\n");
    ASSERT_EQ(source.files.size(), 1U);
    EXPECT_EQ(source.files[0], folder / "a.frag");
}

TEST(ShaderSource, IncludesStandInPlaceWithTheirOwnLines) {
    const TemporaryFolder folder;
    folder.write("b.glsl", "float b;\n");
    folder.write("a.frag", "#version 450 core\n#include \"b.glsl\"\nfloat a;\n");
    const ShaderSource source = read_shader(folder.path(), "a.frag", {});
    EXPECT_EQ(source.text, "#version 450 core\n#line 2 0\n#line 1 1\nfloat b;\n#line 3 0\nfloat a;\n");
    ASSERT_EQ(source.files.size(), 2U);
    EXPECT_EQ(source.files[1], folder / "b.glsl");
}

TEST(ShaderSource, AFileIsIncludedOnceEvenInACircle) {
    const TemporaryFolder folder;
    folder.write("b.glsl", "#include \"c.glsl\"\nfloat b;\n");
    folder.write("c.glsl", "#include \"b.glsl\"\nfloat c;\n");
    folder.write("a.frag", "#version 450 core\n#include \"b.glsl\"\n#include \"c.glsl\"\n");
    const std::string text = read_shader(folder.path(), "a.frag", {}).text;
    EXPECT_EQ(text.find("float b;"), text.rfind("float b;"));
    EXPECT_EQ(text.find("float c;"), text.rfind("float c;"));
    EXPECT_LT(text.find("float c;"), text.find("float b;"));
}

TEST(ShaderSource, RefusalsNameFileAndLine) {
    const TemporaryFolder folder;
    folder.write("a.frag", "#version 450 core\n\n#include \"missing.glsl\"\n");
    folder.write("b.frag", "#version 450 core\n#include missing.glsl\n");
    const std::string missing = refusal([&] { read_shader(folder.path(), "a.frag", {}); });
    EXPECT_TRUE(contains(missing, "missing.glsl")) << missing;
    EXPECT_TRUE(contains(missing, "a.frag:3")) << missing;
    const std::string unquoted = refusal([&] { read_shader(folder.path(), "b.frag", {}); });
    EXPECT_TRUE(contains(unquoted, "b.frag:2")) << unquoted;
    const std::string none = refusal([&] { read_shader(folder.path(), "none.frag", {}); });
    EXPECT_TRUE(contains(none, "none.frag")) << none;
}

TEST(ShaderSource, CompileLogsSpeakOfFiles) {
    const std::vector<std::filesystem::path> files{"/s/a.frag", "/s/b.glsl"};
    EXPECT_EQ(map_compile_log("1:14(5): error: no\n", files), "/s/b.glsl:14(5): error: no\n");
    EXPECT_EQ(map_compile_log("0(7) : error C1: no\n", files), "/s/a.frag:7 : error C1: no\n");
    EXPECT_EQ(map_compile_log("9:14(5): error: no\n", files), "9:14(5): error: no\n") << "no such file: left alone";
    EXPECT_EQ(map_compile_log("linking failed\n", files), "linking failed\n");
}

}  // namespace
}  // namespace bruma::gl
