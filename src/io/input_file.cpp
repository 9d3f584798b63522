#include "io/input_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <mutex>
#include <set>

#include "base/error.h"

namespace bruma::io {
namespace {

struct ReadFiles {
    std::mutex mutex;
    std::set<std::filesystem::path> paths;
};

ReadFiles& read_files() {
    static ReadFiles files;
    return files;
}

int open_regular(const std::filesystem::path& path, std::int64_t& size) {
    // Without waiting: opening a pipe would otherwise hang until someone writes to it.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) {
        const int cause = errno;
        throw InputError(cause == ENOENT ? fmt::format("{}: no such file; is the path right?", path.string())
                                         : fmt::format("{}: cannot be opened ({}); is it yours to read?", path.string(),
                                                       std::strerror(cause)));
    }
    struct stat facts {};
    std::string fault;
    if (::fstat(descriptor, &facts) != 0) {
        fault = fmt::format("cannot be examined ({})", std::strerror(errno));
    } else if (S_ISDIR(facts.st_mode)) {
        fault = "is a folder; name a file inside it";
    } else if (!S_ISREG(facts.st_mode)) {
        fault = "is a device or a pipe; name a regular file";
    } else if (facts.st_size == 0) {
        fault = "is empty; was it copied to its end?";
    }
    if (!fault.empty()) {
        ::close(descriptor);
        throw InputError(fmt::format("{}: {}", path.string(), fault));
    }
    size = facts.st_size;
    return descriptor;
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path) : path_(path), descriptor_(open_regular(path, size_)) {
    announce_input(path);
}

InputFile::~InputFile() {
    ::close(descriptor_);
}

void InputFile::read(std::int64_t offset, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t got = ::pread(descriptor_, bytes.data(), bytes.size(), offset);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got < 0) {
            throw InputError(
                fmt::format("{}: cannot be read at byte {} ({})", path_.string(), offset, std::strerror(errno)));
        }
        if (got == 0) {
            throw InputError(fmt::format("{}: ends at byte {}, {} bytes early; is it still being written?",
                                         path_.string(), offset, bytes.size()));
        }
        offset += got;
        bytes = bytes.subspan(std::size_t(got));
    }
}

std::string read_text_file(const std::filesystem::path& path, std::int64_t most) {
    const InputFile file(path);
    if (file.size() > most) {
        throw InputError(fmt::format("{}: {} bytes, but a file of this kind has at most {}; is it the right file?",
                                     path.string(), file.size(), most));
    }
    std::string text(std::size_t(file.size()), '\0');
    file.read(0, std::as_writable_bytes(std::span(text.data(), text.size())));
    return text;
}

std::vector<std::filesystem::path> files_read() {
    ReadFiles& files = read_files();
    const std::lock_guard lock(files.mutex);
    return {files.paths.begin(), files.paths.end()};
}

void announce_input(const std::filesystem::path& path) {
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(path, error);
    ReadFiles& files = read_files();
    const std::lock_guard lock(files.mutex);
    files.paths.insert(error ? path : absolute);
}

}  // namespace bruma::io
