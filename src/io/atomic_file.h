#pragma once
#include <filesystem>
#include <span>
#include <string>

namespace bruma::io {

/// Writes to what `path` means. A regular file is written under a temporary name in its folder and renamed when
/// complete, so that a reader never sees half a file and a failure leaves what was there before; it keeps its
/// permissions, and its owner where that may be. A symbolic link stays, and what it leads to is written. A character
/// device or a pipe takes the bytes as they come. A file without permission to write is refused, also for root, and so
/// are folders, disks and sockets. Where the folder takes no new file, but the file itself may be written, it is
/// overwritten in place, after room for all of it was reserved. A file of several names (hard links) parts from the
/// other names. Throws InputError naming the path and the cause.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& path, const std::string& text);

/// Whether `write_file_atomically` could write there now: puts an empty file beside `path` and takes it away again.
/// Throws the InputError that the writing would end in, before anything is computed for it.
void require_writable(const std::filesystem::path& path);
/// The same for a folder that is made later if it is not there yet; makes none.
void require_writable_folder(const std::filesystem::path& folder);

/// The absolute path of what `path` leads to through all symbolic links, whether it is there or not. Throws InputError
/// for links that go round in a circle.
std::filesystem::path output_target(const std::filesystem::path& path);
/// Whether `path` is there and takes bytes as they come: a character device or a pipe.
bool is_stream(const std::filesystem::path& path);

}  // namespace bruma::io
