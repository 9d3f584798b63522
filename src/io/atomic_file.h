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

}  // namespace bruma::io
