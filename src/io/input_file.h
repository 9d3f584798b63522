#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace bruma::io {

/// A regular file open for reading. Opening and reading throw InputError with one sentence that says whether it is
/// missing, a folder, unreadable or empty.
class InputFile {
  public:
    explicit InputFile(const std::filesystem::path& path);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::int64_t size() const { return size_; }  ///< bytes, at least 1

    /// Fills `bytes` from `offset` on; throws InputError when the file ends before that.
    void read(std::int64_t offset, std::span<std::byte> bytes) const;

  private:
    std::filesystem::path path_;
    std::int64_t size_ = 0;  // before the descriptor: opening fills it in
    int descriptor_ = -1;
};

/// A whole file of at most `most` bytes; longer ones are refused with both numbers.
std::string read_text_file(const std::filesystem::path& path, std::int64_t most);

/// The absolute paths of all files that this program has opened for reading or announced, sorted: what no output may
/// replace. All reading goes through InputFile, so that no kind of input is forgotten, textures of material
/// libraries included. May be called from any thread.
std::vector<std::filesystem::path> files_read();
/// Counts a file among `files_read` before it is read, so that outputs are judged before anything is loaded.
void announce_input(const std::filesystem::path& path);

}  // namespace bruma::io
