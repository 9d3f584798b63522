#include "io/output_guard.h"

#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <optional>

#include "base/console.h"
#include "base/error.h"
#include "io/atomic_file.h"
#include "io/input_file.h"

namespace bruma::io {
namespace {

namespace fs = std::filesystem;

using Facts = struct stat;

/// What a path, or "-", leads to; nothing where nothing is.
std::optional<Facts> facts_of(const fs::path& path) {
    Facts facts{};
    const bool there = path == "-" ? ::fstat(STDOUT_FILENO, &facts) == 0 : ::stat(path.c_str(), &facts) == 0;
    return there ? std::optional(facts) : std::nullopt;
}

/// Names do not tell: links, other spellings of a folder and file systems without case all lead to one file.
bool is_same_file(const Facts& a, const Facts& b) {
    return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

bool is_input(const Facts& facts, const std::vector<fs::path>& inputs) {
    return std::any_of(inputs.begin(), inputs.end(), [&](const fs::path& input) {
        const std::optional<Facts> read = facts_of(input);
        return read && is_same_file(*read, facts);
    });
}

/// Whether both would end up in one file. What takes all and keeps nothing, as /dev/null does, may be named twice.
bool is_same_output(const fs::path& a, const fs::path& b) {
    const std::optional<Facts> there_a = facts_of(a);
    const std::optional<Facts> there_b = facts_of(b);
    if (there_a && there_b) {
        return is_same_file(*there_a, *there_b) && !S_ISCHR(there_a->st_mode);
    }
    return !there_a && !there_b && output_target(a) == output_target(b);
}

}  // namespace

OutputVerdict judge_output(const fs::path& path, FileContent content, const std::vector<fs::path>& inputs) {
    const std::optional<Facts> facts = facts_of(path);
    if (!facts || !S_ISREG(facts->st_mode)) {
        return {};
    }
    // What is appended to, as a redirected standard output, loses nothing.
    const FileContent found = path == "-" || is_stream(path) ? FileContent::nothing : content_of(path);
    const bool is_taken_whole = content == FileContent::scene || content == FileContent::transfer_function;
    if (!(is_taken_whole && found == content) && is_input(*facts, inputs)) {
        return {OutputStanding::input, fmt::format("{}: is one of the files that were read, which {} may not replace",
                                                   path.string(), content_words(content))};
    }
    if (found == FileContent::nothing) {
        return {};
    }
    if (found == content) {
        return {OutputStanding::same_kind, ""};
    }
    const std::string holds = found == FileContent::other
                                  ? fmt::format("something else than {}", content_words(content))
                                  : fmt::format("{}, not {}", content_words(found), content_words(content));
    return {OutputStanding::another_kind, fmt::format("{}: holds {}", path.string(), holds)};
}

OutputVerdict judge_output(const fs::path& path, FileContent content) {
    return judge_output(path, content, files_read());
}

void OutputGuard::add(const std::string& option, const fs::path& path, FileContent content) {
    for (const Output& other : outputs_) {
        if (is_same_output(path, other.path)) {
            throw InputError(
                fmt::format("{} {}: is the file of {} too; name another one", option, path.string(), other.option));
        }
    }
    outputs_.push_back({option, path, content});
    judge(outputs_.back());
    if (path != "-") {
        require_writable(path);
    } else if (!has_standard_output()) {
        throw InputError(fmt::format("{} -: standard output is closed; name a file", option));
    }
}

void OutputGuard::add_sequence(const std::string& option, const std::vector<fs::path>& paths, FileContent content) {
    for (const fs::path& path : paths) {
        outputs_.push_back({option, path, content});
        judge(outputs_.back());
        // New names are alike but for their length, and the last is the longest.
        if (facts_of(path) || path == paths.back()) {
            require_writable(path);
        }
    }
}

void OutputGuard::check() const {
    for (const Output& output : outputs_) {
        judge(output);
    }
}

void OutputGuard::judge(const Output& output) const {
    const OutputVerdict verdict = judge_output(output.path, output.content);
    if (verdict.standing == OutputStanding::input) {
        throw InputError(fmt::format("{} {}; name another file", output.option, verdict.sentence));
    }
    if (verdict.standing == OutputStanding::another_kind && !force_) {
        throw InputError(
            fmt::format("{} {}; name another file, or add --force to replace it", output.option, verdict.sentence));
    }
}

}  // namespace bruma::io
