#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

#include "io/foreign_format.h"

namespace bruma::io {

/// Formats whose header is followed by plain samples: NIfTI-1, Analyze 7.5, NumPy's .npy and MRC. The way out are then
/// the options with which the file itself is read. `head` are the file's first bytes (1024 tell all), `length` is that
/// of the whole file.
std::optional<ForeignFormat> described_volume(std::string_view head, std::int64_t length);

}  // namespace bruma::io
