#include "io/atomic_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "base/error.h"

namespace bruma::io {
namespace {

namespace fs = std::filesystem;

fs::path temporary_beside(const fs::path& path) {
    fs::path temporary = path;
    temporary += fmt::format(".{}.part", ::getpid());
    return temporary;
}

[[noreturn]] void throw_unwritable(const fs::path& path, const char* what, int cause) {
    throw InputError(fmt::format("{}: cannot {} ({}); is the folder there and writable?", path.string(), what,
                                 std::strerror(cause)));
}

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    const fs::path temporary = temporary_beside(path);
    const auto fail = [&](const char* what) {
        const int cause = errno;
        std::error_code ignored;
        fs::remove(temporary, ignored);
        throw_unwritable(path, what, cause);
    };
    std::ofstream file(temporary, std::ios::binary);
    if (!file) {
        fail("be written");
    }
    file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    file.close();
    if (!file) {
        fail("be written to its end");
    }
    std::error_code error;
    fs::rename(temporary, path, error);
    if (error) {
        errno = error.value();
        fail("be put in place");
    }
}

void write_file_atomically(const std::filesystem::path& path, const std::string& text) {
    write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

void require_writable(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) {
        throw InputError(fmt::format("{}: is a folder; name a file inside it", path.string()));
    }
    const fs::path temporary = temporary_beside(path);
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) {
        throw_unwritable(path, "be written", errno);
    }
    ::close(descriptor);
    fs::remove(temporary, ignored);
}

void require_writable_folder(const fs::path& folder) {
    std::error_code error;
    // What is there already decides whether the rest can be made.
    fs::path there = fs::absolute(folder, error).lexically_normal();
    while (!fs::exists(there, error) && there.has_relative_path()) {
        there = there.parent_path();
    }
    if (!fs::is_directory(there, error)) {
        throw InputError(fmt::format("{}: {} is no folder; results cannot be written there", folder.string(),
                                     there == folder ? "this" : there.string()));
    }
    try {
        require_writable(there / "probe");
    } catch (const InputError&) {
        throw InputError(fmt::format("{}: nothing can be written in {}; name a folder that is yours to write",
                                     folder.string(), there.string()));
    }
}

}  // namespace bruma::io
