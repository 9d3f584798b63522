#include "base/console.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace bruma {
namespace {

std::atomic<int> answer_fault{0};  // errno of the first failure; 0: none

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

}  // namespace

void prepare_standard_streams() {
    ::signal(SIGPIPE, SIG_IGN);
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF) {
            // In the wrong direction, so that using it still fails. The lowest free number is given, which is this one.
            ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
        }
    }
}

bool has_standard_output() {
    const int flags = ::fcntl(STDOUT_FILENO, F_GETFL);
    return flags >= 0 && (flags & O_ACCMODE) != O_RDONLY;
}

bool write_all(int descriptor, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written >= 0) {
            bytes = bytes.subspan(std::size_t(written));
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            pollfd ready{descriptor, POLLOUT, 0};
            ::poll(&ready, 1, -1);
        } else if (errno != EINTR) {
            return false;
        }
    }
    return true;
}

void say_text(std::string_view text) {
    write_all(STDERR_FILENO, bytes_of(text));
}

void answer_text(std::string_view text) {
    if (answer_fault == 0 && !write_all(STDOUT_FILENO, bytes_of(text))) {
        answer_fault = errno;
    }
}

void require_answer_told() {
    const int cause = answer_fault;
    if (cause != 0 && cause != EBADF && cause != EPIPE) {
        throw MachineError(
            fmt::format("standard output: not all of the answer could be written ({}); send it to a place with room",
                        std::strerror(cause)));
    }
}

}  // namespace bruma
