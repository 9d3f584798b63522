#include "io/atomic_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <utility>

#include "base/console.h"
#include "base/error.h"

namespace bruma::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void throw_unwritable(const fs::path& path, const char* what, int cause) {
    const char* next = cause == ENAMETOOLONG ? "choose a shorter name"
                       : cause == ENOSPC     ? "make room or choose another place"
                       : cause == EPIPE      ? "who reads it is gone"
                                             : "is the folder there and writable?";
    throw InputError(fmt::format("{}: cannot {} ({}); {}", path.string(), what, std::strerror(cause), next));
}

/// An open file that is closed at the end.
class Descriptor {
  public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    int number() const { return number_; }
    bool is_open() const { return number_ >= 0; }
    /// False, with errno, when not all that was written arrived.
    bool close() { return !is_open() || ::close(std::exchange(number_, -1)) == 0; }

  private:
    int number_;
};

/// The number N of /proc/PID/fd/N, to which /dev/stdout and /dev/fd/N lead, when it is open in this process.
std::optional<int> own_descriptor(const fs::path& target) {
    if (target.parent_path() != fmt::format("/proc/{}/fd", ::getpid())) {
        return std::nullopt;
    }
    const std::string name = target.filename().string();
    int number = -1;
    std::from_chars(name.data(), name.data() + name.size(), number);
    return number >= 0 ? std::optional(number) : std::nullopt;
}

/// Where output goes: the file behind all links, and what is there.
struct Place {
    fs::path target;
    std::optional<struct stat> facts;

    bool is_stream() const {
        return own_descriptor(target) || (facts && (S_ISCHR(facts->st_mode) || S_ISFIFO(facts->st_mode)));
    }
};

/// Throws InputError for what cannot be written, as far as that is known without trying.
Place place_of(const fs::path& path) {
    Place place{output_target(path), std::nullopt};
    struct stat facts {};
    if (::stat(place.target.c_str(), &facts) != 0) {
        if (errno == ENOENT) {
            return place;
        }
        throw_unwritable(path, "be written", errno);
    }
    place.facts = facts;
    if (S_ISDIR(facts.st_mode)) {
        throw InputError(fmt::format("{}: is a folder; name a file inside it", path.string()));
    }
    if (!S_ISREG(facts.st_mode) && !place.is_stream()) {
        throw InputError(fmt::format("{}: is a disk or a socket; name a file", path.string()));
    }
    // Root may write anything, but a file without permission to write was meant to stay.
    constexpr mode_t anyone_writes = S_IWUSR | S_IWGRP | S_IWOTH;
    const bool is_permitted =
        (facts.st_mode & anyone_writes) != 0 && ::faccessat(AT_FDCWD, place.target.c_str(), W_OK, AT_EACCESS) == 0;
    const std::optional<int> own = own_descriptor(place.target);
    if (own && (::fcntl(*own, F_GETFL) & O_ACCMODE) == O_RDONLY) {
        throw InputError(fmt::format("{}: is open for reading only, or closed; name a file", path.string()));
    }
    if (!is_permitted && !own) {
        throw InputError(
            fmt::format("{}: is read-only; name another file or give it permission to be written", path.string()));
    }
    return place;
}

/// A new file in the folder of `target`. Its name is short, so that the target's may be as long as files are named.
std::pair<fs::path, int> open_temporary(const fs::path& target) {
    static std::atomic<unsigned> count{0};
    fs::path path;
    int descriptor = -1;
    do {
        path = target.parent_path() / fmt::format(".bruma-{}-{}.part", ::getpid(), count++);
        descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor < 0 && errno == EEXIST);
    return {path, descriptor};
}

/// Causes for which a file that is there may still be written in place: its folder takes no new files, or the file is
/// mounted on its own.
bool is_folders_fault(int cause) {
    return cause == EACCES || cause == EPERM || cause == EROFS || cause == EBUSY || cause == EXDEV;
}

void write_stream(const fs::path& path, const fs::path& target, std::span<const std::byte> bytes) {
    const std::optional<int> own = own_descriptor(target);
    // A new descriptor of a redirected file would begin at its start.
    Descriptor stream(own ? ::fcntl(*own, F_DUPFD_CLOEXEC, 0) : ::open(target.c_str(), O_WRONLY | O_CLOEXEC));
    if (!stream.is_open()) {
        throw_unwritable(path, "be written", errno);
    }
    if (!write_all(stream.number(), bytes) || !stream.close()) {
        throw_unwritable(path, "be written to its end", errno);
    }
}

/// Overwrites a file. A full disk is told before the first byte is lost.
void write_in_place(const fs::path& path, const Place& place, std::span<const std::byte> bytes) {
    Descriptor file(::open(place.target.c_str(), O_WRONLY | O_CLOEXEC));
    if (!file.is_open()) {
        throw_unwritable(path, "be written", errno);
    }
    const int no_room = bytes.empty() ? 0 : ::posix_fallocate(file.number(), 0, off_t(bytes.size()));
    if (no_room == ENOSPC || no_room == EFBIG) {
        const bool is_shrunk = ::ftruncate(file.number(), place.facts->st_size) == 0;
        throw_unwritable(path, is_shrunk ? "be written" : "be written, and has grown", no_room);
    }
    if (!write_all(file.number(), bytes) || ::ftruncate(file.number(), off_t(bytes.size())) != 0 || !file.close()) {
        throw_unwritable(path, "be written to its end", errno);
    }
}

/// Gives a new file the permissions of the one that it replaces, and its owner where that may be.
void make_alike(int descriptor, const struct stat& replaced) {
    // The owner first: a change of it takes set-user-ID away, which no file of another owner may have.
    const bool has_owner = ::fchown(descriptor, replaced.st_uid, replaced.st_gid) == 0;
    ::fchmod(descriptor, replaced.st_mode & (has_owner ? 07777U : 0777U));
}

}  // namespace

fs::path output_target(const fs::path& path) {
    constexpr int most_links = 40;  // as the kernel follows
    fs::path at = path;
    for (int links = 0; links <= most_links; ++links) {
        std::error_code error;
        const fs::path folder = fs::canonical(at.has_parent_path() ? at.parent_path() : fs::path("."), error);
        if (error) {
            return fs::absolute(at, error);  // a folder that is not there holds no links
        }
        at = folder / at.filename();
        const fs::path link = own_descriptor(at) ? fs::path() : fs::read_symlink(at, error);
        if (error || link.empty()) {
            return at;
        }
        at = link.is_absolute() ? link : folder / link;
    }
    throw InputError(fmt::format("{}: symbolic links that lead round in a circle; name a file", path.string()));
}

bool is_stream(const fs::path& path) {
    Place place{output_target(path), std::nullopt};
    struct stat facts {};
    if (::stat(place.target.c_str(), &facts) != 0) {
        return false;
    }
    place.facts = facts;
    return place.is_stream();
}

void write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
    const Place place = place_of(path);
    if (place.is_stream()) {
        return write_stream(path, place.target, bytes);
    }
    const auto [temporary, descriptor] = open_temporary(place.target);
    if (descriptor < 0) {
        if (place.facts && is_folders_fault(errno)) {
            return write_in_place(path, place, bytes);
        }
        throw_unwritable(path, "be written", errno);
    }
    Descriptor file(descriptor);
    if (place.facts) {
        make_alike(file.number(), *place.facts);
    }
    const bool is_whole = write_all(file.number(), bytes) && file.close();
    if (is_whole && ::rename(temporary.c_str(), place.target.c_str()) == 0) {
        return;
    }
    const int cause = errno;
    ::unlink(temporary.c_str());
    if (is_whole && place.facts && is_folders_fault(cause)) {
        return write_in_place(path, place, bytes);
    }
    throw_unwritable(path, is_whole ? "be put in place" : "be written to its end", cause);
}

void write_file_atomically(const fs::path& path, const std::string& text) {
    write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

void require_writable(const fs::path& path) {
    const Place place = place_of(path);
    if (place.is_stream()) {
        return;
    }
    const auto [temporary, descriptor] = open_temporary(place.target);
    if (descriptor >= 0) {
        ::close(descriptor);
        ::unlink(temporary.c_str());
    } else if (!place.facts || !is_folders_fault(errno)) {
        throw_unwritable(path, "be written", errno);
    }
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
    const auto [temporary, descriptor] = open_temporary(there / "results");
    if (descriptor < 0) {
        throw InputError(fmt::format("{}: nothing can be written in {}; name a folder that is yours to write",
                                     folder.string(), there.string()));
    }
    ::close(descriptor);
    ::unlink(temporary.c_str());
}

}  // namespace bruma::io
