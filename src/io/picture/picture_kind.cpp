#include "io/picture/picture_kind.h"

#include <algorithm>
#include <array>

#include "io/picture/tga_picture.h"

namespace bruma::io {
namespace {

using namespace std::string_view_literals;

struct KindMark {
    std::size_t at;
    std::string_view bytes;
    std::string_view means;
};

constexpr std::array foreign_marks{
    KindMark{0, "GIF8"sv, "a GIF picture"},
    KindMark{0, "8BPS"sv, "a Photoshop picture"},
    KindMark{0, "\x53\x80\xf6\x34"sv, "a Softimage PIC picture"},
    KindMark{0, "II*\0"sv, "a TIFF picture"},
    KindMark{0, "MM\0*"sv, "a TIFF picture"},
    KindMark{0, "II+\0"sv, "a BigTIFF picture"},
    KindMark{8, "WEBP"sv, "a WebP picture"},
    KindMark{0, "DDS "sv, "a DDS texture"},
    KindMark{1, "KTX "sv, "a KTX texture"},
    KindMark{0, "qoif"sv, "a QOI picture"},
    KindMark{0, "\0\0\1\0"sv, "an icon"},
    KindMark{4, "ftypavif"sv, "an AVIF picture"},
    KindMark{4, "ftyp"sv, "a HEIC picture or a film"},
    KindMark{4, "jP  "sv, "a JPEG 2000 picture"},
    KindMark{4, "JXL "sv, "a JPEG XL picture"},
    KindMark{0, "\xff\x0a"sv, "a JPEG XL picture"},
    KindMark{0, "%PDF"sv, "a PDF document"},
    KindMark{0, "<svg"sv, "an SVG drawing"},
    KindMark{0, "<?xml"sv, "an XML document"},
    KindMark{0, "\x1f\x8b"sv, "a gzip archive"},
    KindMark{0, "PK\3\4"sv, "a zip archive"},
    KindMark{0, "PF"sv, "a floating-point PFM picture"},
    KindMark{0, "Pf"sv, "a floating-point PFM picture"},
    KindMark{0, "P7"sv, "a Netpbm PAM picture"},
};

bool mark_holds_at(std::string_view bytes, std::size_t at, std::string_view mark) {
    return bytes.size() >= at && bytes.substr(at).starts_with(mark);
}

const KindMark* foreign_mark(std::string_view bytes) {
    const auto* found = std::find_if(foreign_marks.begin(), foreign_marks.end(),
                                     [&](const KindMark& mark) { return mark_holds_at(bytes, mark.at, mark.bytes); });
    return found == foreign_marks.end() ? nullptr : &*found;
}

/// "BM" alone begins texts as well: the size of the second header tells a bitmap.
bool is_bmp(std::string_view bytes) {
    constexpr std::array header_sizes{12, 40, 52, 56, 64, 108, 124};
    return bytes.starts_with("BM") && bytes.size() > 17 && bytes.substr(15, 3) == "\0\0\0"sv &&
           std::find(header_sizes.begin(), header_sizes.end(), int(std::uint8_t(bytes[14]))) != header_sizes.end();
}

bool is_netpbm(std::string_view bytes) {
    return bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6' &&
           " \t\r\n#"sv.find(bytes[2]) != std::string_view::npos;
}

}  // namespace

PictureKind picture_kind(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) {
        return PictureKind::png;
    }
    if (bytes.starts_with("\xff\xd8\xff"sv)) {
        return PictureKind::jpeg;
    }
    if (bytes.starts_with("#?RADIANCE"sv) || bytes.starts_with("#?RGBE"sv)) {
        return PictureKind::radiance;
    }
    if (bytes.starts_with("\x76\x2f\x31\x01"sv)) {
        return PictureKind::open_exr;
    }
    if (is_bmp(bytes)) {
        return PictureKind::bmp;
    }
    if (is_netpbm(bytes)) {
        return PictureKind::netpbm;
    }
    if (foreign_mark(bytes) != nullptr) {
        return PictureKind::foreign;
    }
    return looks_like_tga(bytes) ? PictureKind::tga : PictureKind::unknown;
}

std::string foreign_kind(std::string_view bytes) {
    const KindMark* mark = foreign_mark(bytes);
    return std::string(mark != nullptr ? mark->means : "a file of an unknown kind");
}

}  // namespace bruma::io
