#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace bruma::io {

/// The longest picture file that is read: decoders count bytes in an int.
constexpr std::int64_t most_picture_bytes = (std::int64_t(1) << 31) - 1;

/// A picture of whole numbers as it stands in a file, top row first, unpacked to red, green, blue and alpha. What the
/// file leaves out is filled in: grey is repeated, alpha is full.
struct RasterPicture {
    int width = 0, height = 0;    ///< pixels, at least 1
    int channels = 4;             ///< in the file: 1 grey, 2 grey and alpha, 3 colour, 4 colour and alpha
    int bits = 8;                 ///< of each sample: 8 or 16
    std::vector<std::byte> rgba;  ///< width * height * 4 samples; 16-bit ones in this machine's byte order

    std::size_t sample_count() const { return std::size_t(4) * width * height; }
};

/// Where a picture is wanted.
struct PictureDoor {
    std::string known;                                       ///< the tail of messages: "textures may be .png, ..."
    std::function<void(int width, int height)> accept_size;  ///< throws for sizes that are not; before any unpacking
};

/// Unpacks PNG, JPEG, BMP, TGA (with or without run lengths) and binary or text Netpbm, by content and whatever the
/// name; of an animated PNG its still picture. Every other kind, a size of zero, a file that ends early and one that is
/// too small for the size it tells are refused. Throws InputError.
RasterPicture decode_raster(const std::string& name, std::string_view bytes, const PictureDoor& door);

/// For decoders: makes room for a picture once its header is known. `fewest_bytes` is the least that the packed pixels
/// can take; `left` is what the file has for them. Throws BrokenPicture when that is too little.
void begin_raster(RasterPicture& picture, const PictureDoor& door, std::uint64_t fewest_bytes, std::uint64_t left);

/// Why a picture cannot be read, without name or tail: "a TGA that ends early". decode_raster makes a sentence of it.
struct BrokenPicture {
    std::string why;
};
/// What would be read but for a feature: "its pixels are packed in run lengths".
struct UnreadPicture {
    std::string why;
};

}  // namespace bruma::io
