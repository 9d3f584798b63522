#include "io/atomic_file.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "base/error.h"

namespace bruma::io {

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    std::filesystem::path temporary = path;
    temporary += fmt::format(".{}.part", ::getpid());
    const auto fail = [&](const char* what) {
        const int cause = errno;
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw InputError(fmt::format("{}: cannot {} ({}); is the folder there and writable?", path.string(), what,
                                     std::strerror(cause)));
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
    std::filesystem::rename(temporary, path, error);
    if (error) {
        errno = error.value();
        fail("be put in place");
    }
}

void write_file_atomically(const std::filesystem::path& path, const std::string& text) {
    write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace bruma::io
