#include "io/atomic_file.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <future>
#include <nlohmann/json.hpp>

#include "io/json/json_text.h"
#include "io/picture/picture_file.h"
#include "io_temporary_folder.h"

namespace bruma::io {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

mode_t mode_of(const fs::path& path) {
    struct stat facts {};
    ::stat(path.c_str(), &facts);
    return facts.st_mode & 07777U;
}

void write(const fs::path& path, const std::string& text = "new") {
    require_writable(path);
    write_file_atomically(path, text);
}

TEST(AtomicFile, FollowsLinksAndLeavesThem) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "far");
    fs::create_symlink("far/real.txt", folder / "one");
    fs::create_symlink("one", folder / "two");
    write(folder / "two");  // its end is not there yet
    EXPECT_TRUE(fs::is_symlink(folder / "one") && fs::is_symlink(folder / "two"));
    EXPECT_EQ(text_of(folder / "far/real.txt"), "new");
    write(folder / "two", "newer");
    EXPECT_TRUE(fs::is_symlink(folder / "two"));
    EXPECT_EQ(text_of(folder / "far/real.txt"), "newer");
    EXPECT_EQ(output_target(folder / "two"), fs::canonical(folder / "far/real.txt"));
    EXPECT_EQ(folder.file_count(), 3U);
}

TEST(AtomicFile, RefusesLinksThatGoRound) {
    const TemporaryFolder folder;
    fs::create_symlink("b", folder / "a");
    fs::create_symlink("a", folder / "b");
    EXPECT_TRUE(contains(refusal([&] { require_writable(folder / "a"); }), "circle"));
    EXPECT_TRUE(contains(refusal([&] { write_file_atomically(folder / "a", std::string("x")); }), "circle"));
}

TEST(AtomicFile, KeepsPermissionsAndFollowsTheUmask) {
    const TemporaryFolder folder;
    const fs::path file = folder.write("a.txt", "old");
    for (const mode_t mode : {0600U, 0644U, 0660U, 0755U}) {
        ::chmod(file.c_str(), mode);
        write(file);
        EXPECT_EQ(mode_of(file), mode);
    }
    const mode_t before = ::umask(027);
    write(folder / "fresh.txt");
    ::umask(before);
    EXPECT_EQ(mode_of(folder / "fresh.txt"), 0640U);
}

TEST(AtomicFile, RefusesWhatIsReadOnly) {
    const TemporaryFolder folder;
    const fs::path file = folder.write("a.txt", "old");
    ::chmod(file.c_str(), 0444);
    fs::create_symlink("a.txt", folder / "link");
    for (const fs::path& path : {file, folder / "link"}) {
        EXPECT_TRUE(contains(refusal([&] { require_writable(path); }), "read-only"));
        EXPECT_TRUE(contains(refusal([&] { write_file_atomically(path, std::string("x")); }), "read-only"));
    }
    EXPECT_EQ(text_of(file), "old");
}

TEST(AtomicFile, HandsBytesToDevicesAndPipes) {
    const TemporaryFolder folder;
    const fs::path pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_TRUE(is_stream(pipe));
    EXPECT_EQ(picture_format(pipe.string()), PictureFormat::png);
    require_writable(pipe);  // does not wait for a reader
    auto reader = std::async(std::launch::async, [&] { return text_of(pipe); });
    write_file_atomically(pipe, std::string(100'000, 'x'));
    EXPECT_EQ(reader.get(), std::string(100'000, 'x'));
    EXPECT_TRUE(fs::is_fifo(pipe));
    EXPECT_EQ(folder.file_count(), 1U);
    fs::create_symlink("/dev/full", folder / "full");
    EXPECT_TRUE(contains(refusal([&] { write_file_atomically(folder / "full", std::string("x")); }), "space"));
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(AtomicFile, AppendsToItsOwnOpenFiles) {
    const TemporaryFolder folder;
    const int descriptor = ::open((folder / "a.txt").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
    ASSERT_EQ(::write(descriptor, "head ", 5), 5);
    write(fs::path("/dev/fd") / std::to_string(descriptor), "body");
    ASSERT_EQ(::write(descriptor, " foot", 5), 5);
    ::close(descriptor);
    EXPECT_EQ(text_of(folder / "a.txt"), "head body foot");
    const int reading = ::open((folder / "a.txt").c_str(), O_RDONLY | O_CLOEXEC);
    EXPECT_NE(refusal([&] { require_writable(fs::path("/dev/fd") / std::to_string(reading)); }), "");
    ::close(reading);
}

TEST(AtomicFile, RefusesSockets) {
    const TemporaryFolder folder;
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    (folder / "s").string().copy(address.sun_path, sizeof(address.sun_path) - 1);
    const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
    ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    EXPECT_NE(refusal([&] { require_writable(folder / "s"); }), "");
    ::close(socket);
}

TEST(AtomicFile, TakesTheLongestNames) {
    const TemporaryFolder folder;
    write(folder / std::string(255, 'n'));
    EXPECT_EQ(text_of(folder / std::string(255, 'n')), "new");
    EXPECT_TRUE(contains(refusal([&] { require_writable(folder / std::string(256, 'n')); }), "shorter"));
    EXPECT_EQ(folder.file_count(), 1U);
}

TEST(AtomicFile, WritesInPlaceWhereTheFolderTakesNoFiles) {
    if (::geteuid() == 0) {
        GTEST_SKIP() << "root may write into every folder";
    }
    const TemporaryFolder folder;
    fs::create_directory(folder / "fixed");
    const fs::path file = folder.write("fixed/a.txt", "something longer");
    ::chmod((folder / "fixed").c_str(), 0555);
    write(file);
    EXPECT_EQ(text_of(file), "new");
    EXPECT_NE(refusal([&] { require_writable(folder / "fixed/b.txt"); }), "");
    ::chmod((folder / "fixed").c_str(), 0755);
}

TEST(JsonText, NamesWhatIsNotUtf8) {
    const nlohmann::json document = {{"nodes", {{"a", {{"file", "v\xff.raw"}}}}}};
    const std::string sentence = refusal([&] { json_text(document); });
    EXPECT_TRUE(contains(sentence, "'v\xff.raw'") && contains(sentence, "UTF-8")) << sentence;
    EXPECT_FALSE(contains(sentence, "json.exception")) << sentence;
    EXPECT_TRUE(contains(refusal([&] { json_text({{"k\xff", 1}}); }), "'k\xff'"));
    // Reports tell it as well as they can.
    EXPECT_EQ(report_text({{"file", "v\xff.raw"}}, -1), "{\"file\":\"v\xEF\xBF\xBD.raw\"}");
}

}  // namespace
}  // namespace bruma::io
