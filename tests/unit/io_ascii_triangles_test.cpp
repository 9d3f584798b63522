#include "io/mesh/ascii_triangles.h"

#include <gtest/gtest.h>

#include "io_temporary_folder.h"

namespace bruma::io {
namespace {

TEST(AsciiTriangles, CountsTrianglesAndTheirBox) {
    const TemporaryFolder folder;
    const auto file = folder.write("a.raw", "# a comment\n\n0 0 9 1 0 0 0 1 0\r\n-1e1 +2 .5\t1 0 0  0 0 7 # behind\n");
    const auto found = read_ascii_triangles(file);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->count, 2);
    EXPECT_EQ(found->low, glm::dvec3(-10, 0, 0));
    EXPECT_EQ(found->high, glm::dvec3(1, 2, 9));
    EXPECT_EQ(found->first_bad_line, 0);
}

TEST(AsciiTriangles, NamesTheFirstBadLine) {
    const TemporaryFolder folder;
    const auto found = read_ascii_triangles(folder.write("a.raw", "0 0 0 1 0 0 0 1 0\n1 2 3\n0 0 0 1 0 nan 0 1 0\n"));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->count, 1);
    EXPECT_EQ(found->first_bad_line, 2);
    EXPECT_EQ(found->first_bad_text, "1 2 3");
}

TEST(AsciiTriangles, CountsAcrossPieces) {
    const TemporaryFolder folder;
    std::string text;
    for (int n = 0; n < 100000; ++n) {
        text += "0 0 0 1.25 0 0 0 1 " + std::to_string(n) + "\n";
    }
    const auto found = read_ascii_triangles(folder.write("a.raw", text));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->count, 100000);
    EXPECT_EQ(found->high.z, 99999.0);
    EXPECT_EQ(found->first_bad_line, 0);
}

TEST(AsciiTriangles, LeavesEverythingElseAlone) {
    const TemporaryFolder folder;
    EXPECT_FALSE(read_ascii_triangles(folder.write("a.raw", std::string(100000, '0'))));
    EXPECT_FALSE(read_ascii_triangles(folder.write("b.raw", "1 2 3 4 5 6 7 8\n")));
    EXPECT_FALSE(read_ascii_triangles(folder.write("c.raw", "1 2 3 4 5 6 7 8 9 10\n")));
    EXPECT_FALSE(read_ascii_triangles(folder.write("d.raw", "# only a comment\n")));
    EXPECT_FALSE(read_ascii_triangles(folder.write("e.raw", std::string("1 2 3 4 5 6 7 8 9\n\0", 19))));
}

}  // namespace
}  // namespace bruma::io
