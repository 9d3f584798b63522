#pragma once
#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace bruma::io {

/// Writes a file under a temporary name beside `path` and renames it when complete, so that a reader never sees half
/// a file and a failure leaves what was there before. Throws InputError naming the path and the cause.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file_atomically(const std::filesystem::path& path, const std::string& text);

/// Whether `write_file_atomically` could write there now: puts an empty file beside `path` and takes it away again.
/// Throws the InputError that the writing would end in, before anything is computed for it.
void require_writable(const std::filesystem::path& path);
/// The same for a folder that is made later if it is not there yet; makes none.
void require_writable_folder(const std::filesystem::path& folder);

}  // namespace bruma::io
