// Closed form: what people type for a path, and the path that they mean.
#include "app/viewer/typed_path.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace bruma::app {
namespace {

class TypedPath : public testing::Test {
  protected:
    void SetUp() override {
        const char* home = std::getenv("HOME");
        home_ = home != nullptr ? home : "";
        ::setenv("HOME", "/home/somebody", 1);
    }
    void TearDown() override { ::setenv("HOME", home_.c_str(), 1); }

  private:
    std::string home_;
};

TEST_F(TypedPath, OrdinaryOnesStay) {
    for (const char* path : {"", "scan.raw", "/a/b c.raw", "builtin:bucky", "a~b", "100%.raw", "a%20b.raw",
                             "http://a/b", "it's.raw", "../x"}) {
        EXPECT_EQ(typed_path(path), path);
    }
}

TEST_F(TypedPath, BlanksAndQuotesAroundGo) {
    EXPECT_EQ(typed_path("  scan.raw \r\n"), "scan.raw");
    EXPECT_EQ(typed_path("'/a/b c.raw'"), "/a/b c.raw");
    EXPECT_EQ(typed_path("\"/a/b c.raw\" "), "/a/b c.raw");
    EXPECT_EQ(typed_path("   "), "");
    EXPECT_EQ(typed_path("'"), "'");
}

TEST_F(TypedPath, HomeIsWhereHomeIs) {
    EXPECT_EQ(typed_path("~"), "/home/somebody");
    EXPECT_EQ(typed_path("~/a b.raw "), "/home/somebody/a b.raw");
    EXPECT_EQ(typed_path("~root/a.raw"), "/root/a.raw");
    EXPECT_EQ(typed_path("~nobody.knows/a.raw"), "~nobody.knows/a.raw");
    EXPECT_EQ(typed_path("~backup.raw"), "~backup.raw");
}

TEST_F(TypedPath, FileUrlsAreDecoded) {
    EXPECT_EQ(typed_path("file:///data/my%20scan%C3%A9.raw"), "/data/my scan\xC3\xA9.raw");
    EXPECT_EQ(typed_path("FILE://localhost/a.raw\n"), "/a.raw");
    EXPECT_EQ(typed_path("file:/a%2Fb"), "/a/b");
    // No digits behind the sign, a byte that ends names, another machine: left as they are.
    EXPECT_EQ(typed_path("file:///a%2"), "/a%2");
    EXPECT_EQ(typed_path("file:///a%zz%"), "/a%zz%");
    EXPECT_EQ(typed_path("file:///a%00b"), "/a%00b");
    EXPECT_EQ(typed_path("file://elsewhere/a.raw"), "file://elsewhere/a.raw");
    EXPECT_EQ(typed_path("file:a.raw"), "file:a.raw");
}

TEST_F(TypedPath, AFileOfExactlyThisNameIsMeant) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("typed_path_" + std::to_string(::getpid()));
    std::filesystem::create_directory(folder);
    const std::string odd = (folder / "ends in a blank ").string();
    std::ofstream(odd) << "x";
    EXPECT_EQ(typed_path(odd), odd);
    std::filesystem::remove_all(folder);
    EXPECT_EQ(typed_path(odd), odd.substr(0, odd.size() - 1));
}

}  // namespace
}  // namespace bruma::app
