#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/blanks.h"
#include "io/volume/volume_header.h"

namespace bruma::io {

/// Longest header that is read; what stands behind it are samples.
constexpr std::int64_t longest_volume_header = 1 << 18;

/// The text of a header, with samples behind it where the file holds both.
VolumeHeader parse_metaimage(const std::filesystem::path& path, std::string_view text);
VolumeHeader parse_nrrd(const std::filesystem::path& path, std::string_view text);

/// The first line of `text`, without its end; `text` goes on behind it.
std::string_view cut_line(std::string_view& text);
std::string lower_case(std::string_view text);
std::vector<std::string> split_words(std::string_view text);

/// All words as numbers. Throws InputError naming `path` and `field` when one is none.
std::vector<double> numbers_of(std::string_view words, const std::filesystem::path& path, std::string_view field);
/// As `numbers_of`, for sizes: whole numbers from 1 to 2^30.
std::vector<int> sizes_of(std::string_view words, const std::filesystem::path& path, std::string_view field);

/// Three edges from those of an image of any dimension: edges of one sample are dropped where there are more, and added
/// where there are fewer; `kept` becomes the dimensions that were taken. Throws InputError when more than three are
/// left.
glm::ivec3 three_edges(const std::vector<int>& edges, const std::filesystem::path& path,
                       std::vector<std::size_t>& kept);

/// The path that a header gives, beside the header unless it is absolute; '\' of other systems become '/'.
std::filesystem::path data_path(const std::filesystem::path& header, std::string_view given);

}  // namespace bruma::io
