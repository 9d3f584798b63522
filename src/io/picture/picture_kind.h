#pragma once
#include <string>
#include <string_view>

namespace bruma::io {

/// Sorts of picture files by their content; the name of a file says nothing.
enum class PictureKind { unknown, png, jpeg, bmp, tga, netpbm, radiance, open_exr, foreign };

/// The sort of picture that the bytes of a file begin as. A TGA has no mark and is taken for one when nothing else fits
/// and its header holds together.
PictureKind picture_kind(std::string_view bytes);

/// What a file is that picture_kind calls foreign, as in "a GIF picture"; "a file of an unknown kind" otherwise.
std::string foreign_kind(std::string_view bytes);

}  // namespace bruma::io
