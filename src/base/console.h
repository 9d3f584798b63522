#pragma once
#include <fmt/core.h>

#include <span>
#include <string_view>
#include <utility>

namespace bruma {

/// To be called once, before any file is opened. Standard streams that are closed are opened on nothing, since the next
/// file would get their number and then the words that are meant for them; and writing to a pipe whose reader is gone
/// becomes an error of that writing instead of the end of the program.
void prepare_standard_streams();

/// Whether standard output can be written at all: it is closed otherwise.
bool has_standard_output();

/// Writes all bytes to an open descriptor, waiting where it is not ready; false, with errno, when it takes no more.
bool write_all(int descriptor, std::span<const std::byte> bytes);

/// Writes to standard error. Never fails: words that nobody can take are dropped. May be called from any thread.
void say_text(std::string_view text);
template <class... Args>
void say(fmt::format_string<Args...> format, Args&&... args) {
    say_text(fmt::format(format, std::forward<Args>(args)...));
}

/// Writes to standard output what a verb was asked for. Never fails, so that the work is done to its end; that it did
/// not arrive is told by `require_answer_told`.
void answer_text(std::string_view text);
template <class... Args>
void answer(fmt::format_string<Args...> format, Args&&... args) {
    answer_text(fmt::format(format, std::forward<Args>(args)...));
}

/// Throws MachineError when standard output took less than `answer` wrote, being full or broken. Where it is closed, or
/// its reader is gone, nobody asks for the rest, and nothing is thrown.
void require_answer_told();

}  // namespace bruma
