#pragma once
#include <fmt/core.h>

#include <string>
#include <string_view>
#include <vector>

namespace bruma {

enum class LogLevel { detail, note, warning, error };

/// Writes one line to standard error (details only when asked for) and keeps it for the viewer's message list.
/// May be called from any thread.
void log_line(LogLevel level, std::string_view line);

/// Shows lines of this level and above on standard error; the default is `note`.
void set_log_level(LogLevel level);

struct LogLine {
    LogLevel level;
    std::string text;
};
/// All lines so far, oldest first; at most the newest 1000.
std::vector<LogLine> logged_lines();

template <class... Args>
void log_note(fmt::format_string<Args...> format, Args&&... args) {
    log_line(LogLevel::note, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void log_detail(fmt::format_string<Args...> format, Args&&... args) {
    log_line(LogLevel::detail, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void log_warning(fmt::format_string<Args...> format, Args&&... args) {
    log_line(LogLevel::warning, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void log_error(fmt::format_string<Args...> format, Args&&... args) {
    log_line(LogLevel::error, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace bruma
