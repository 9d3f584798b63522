#include "base/log.h"

#include <deque>
#include <mutex>

#include "base/console.h"

namespace bruma {
namespace {

struct Log {
    std::mutex mutex;
    std::deque<LogLine> lines;
    LogLevel shown_from = LogLevel::note;
};

Log& the_log() {
    static Log log;
    return log;
}

const char* prefix(LogLevel level) {
    switch (level) {
        case LogLevel::warning:
            return "warning: ";
        case LogLevel::error:
            return "error: ";
        default:
            return "";
    }
}

}  // namespace

void log_line(LogLevel level, std::string_view line) {
    Log& log = the_log();
    const std::lock_guard lock(log.mutex);
    if (level >= log.shown_from) {
        say("{}{}\n", prefix(level), line);
    }
    log.lines.push_back({level, std::string(line)});
    if (log.lines.size() > 1000) {
        log.lines.pop_front();
    }
}

void set_log_level(LogLevel level) {
    Log& log = the_log();
    const std::lock_guard lock(log.mutex);
    log.shown_from = level;
}

std::vector<LogLine> logged_lines() {
    Log& log = the_log();
    const std::lock_guard lock(log.mutex);
    return {log.lines.begin(), log.lines.end()};
}

}  // namespace bruma
