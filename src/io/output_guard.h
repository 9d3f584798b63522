#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "io/file_content.h"

namespace bruma::io {

/// What is at the place where a file is to be written.
enum class OutputStanding {
    free,          ///< nothing, an empty file, a device or a pipe
    same_kind,     ///< a file of the kind that is to be written: may be replaced
    another_kind,  ///< a file of another kind: replaced only when the user says so
    input          ///< a file that this program has read: never replaced
};

struct OutputVerdict {
    OutputStanding standing = OutputStanding::free;
    /// For another_kind and input: one sentence for the user without a next step, as in
    /// "scan.raw: holds something else than a scene". Empty for the others.
    std::string sentence;
};

/// Judges writing `content` to `path`; links of both sorts lead to the file that they mean. `inputs` are what must not
/// be lost, as files are after everything was read; one that is no longer there plays no part. A scene, or a transfer
/// function, may replace one that was read, since it was taken over whole.
OutputVerdict judge_output(const std::filesystem::path& path, FileContent content,
                           const std::vector<std::filesystem::path>& inputs);
/// The same against all files that this program has read so far (`files_read`).
OutputVerdict judge_output(const std::filesystem::path& path, FileContent content);

/// All outputs of one command. Each is judged when it is added, before anything is computed for it, and once more by
/// `check` when all inputs have been read. Throws InputError that names the option.
class OutputGuard {
  public:
    /// `force`: files of another kind may be replaced; inputs and other outputs still may not.
    explicit OutputGuard(bool force) : force_(force) {}

    /// Also refuses what is another output already and what cannot be written. "-" is standard output, which
    /// must be open.
    void add(const std::string& option, const std::filesystem::path& path, FileContent content);
    /// Pictures of one sequence, whose names are different from one another.
    void add_sequence(const std::string& option, const std::vector<std::filesystem::path>& paths, FileContent content);
    /// Judges all again; to be called when the inputs are read, before the expensive part.
    void check() const;

  private:
    struct Output {
        std::string option;
        std::filesystem::path path;
        FileContent content;
    };
    void judge(const Output& output) const;

    bool force_;
    std::vector<Output> outputs_;
};

}  // namespace bruma::io
