#include "io/picture/jpeg_segments.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "io/picture/byte_reader.h"
#include "io/picture/raster_picture.h"

namespace bruma::io {
namespace {

struct JpegComponent {
    int id, quantisation;
};

class SegmentWalk {
  public:
    explicit SegmentWalk(std::string_view bytes) : reader_(bytes), bytes_(bytes) {}

    JpegFrame run() {
        reader_.skip(2);
        for (bool ended = false; !ended;) {
            const int marker = next_marker();
            if (marker == 0xD9) {
                ended = true;
            } else if (marker != 0x01) {
                segment(marker);
            }
        }
        if (!has_scan_) {
            throw BrokenPicture{"a JPEG without pixels"};
        }
        return *frame_;
    }

  private:
    /// Any number of 0xFF, then the marker.
    int next_marker() {
        if (reader_.u8() != 0xFF) {
            throw BrokenPicture{fmt::format("byte {} of a JPEG begins no segment", reader_.at() - 1)};
        }
        int marker = reader_.u8();
        while (marker == 0xFF) {
            marker = reader_.u8();
        }
        return marker;
    }

    void segment(int marker) {
        const std::size_t length = reader_.be16();
        ByteReader content(reader_.take(std::max<std::size_t>(length, 2) - 2));
        if (length < 2) {
            throw BrokenPicture{"a JPEG with a segment shorter than its own length"};
        }
        if (marker == 0xC4) {
            huffman_tables(content);
        } else if (marker == 0xDB) {
            quantisation_tables(content);
        } else if (marker == 0xDA) {
            scan(content);
            skip_entropy_coded();
        } else if (marker >= 0xC0 && marker <= 0xCF && marker != 0xC8) {
            frame(marker, content);
        } else if (marker == 0xDC) {
            throw UnreadPicture{"it is a JPEG that tells its height last"};
        }
    }

    void huffman_tables(ByteReader& content) {
        while (content.left() > 0) {
            const int which = content.u8();
            if ((which >> 4) > 1 || (which & 15) > 3) {
                throw BrokenPicture{fmt::format("a JPEG with a code table {:#x}", which)};
            }
            int codes = 0;
            for (int n = 0; n < 16; ++n) {
                codes += content.u8();
            }
            // Eight bits a sample need 176; the decoder takes the 256th of one for none.
            if (codes > 255) {
                throw BrokenPicture{fmt::format("a JPEG with a table of {} codes", codes)};
            }
            content.skip(std::size_t(codes));
            tables_[which >> 4][which & 15] = true;
        }
    }

    void quantisation_tables(ByteReader& content) {
        while (content.left() > 0) {
            const int which = content.u8();
            if ((which >> 4) > 1 || (which & 15) > 3) {
                throw BrokenPicture{fmt::format("a JPEG with a quantisation table {:#x}", which)};
            }
            content.skip(which >> 4 == 0 ? 64 : 128);
            quantisations_[which & 15] = true;
        }
    }

    void frame(int marker, ByteReader& content) {
        if (marker > 0xC2) {
            throw UnreadPicture{"it is a JPEG of a rare sort (lossless, hierarchical or arithmetic)"};
        }
        if (frame_) {
            throw BrokenPicture{"a JPEG with two frames"};
        }
        if (const int bits = content.u8(); bits != 8) {
            throw UnreadPicture{fmt::format("it is a JPEG of {} bits", bits)};
        }
        is_progressive_ = marker == 0xC2;
        JpegFrame frame;
        frame.height = content.be16();
        frame.width = content.be16();
        const int components = content.u8();
        for (int n = 0; n < components; ++n) {
            const int id = content.u8();
            content.skip(1);
            components_.push_back({id, content.u8() & 3});
        }
        frame_ = frame;
    }

    void scan(ByteReader& content) {
        const int count = content.u8();
        std::vector<std::pair<int, int>> selectors;  // component's id, its tables
        for (int n = 0; n < count; ++n) {
            const int id = content.u8();
            selectors.emplace_back(id, content.u8());
        }
        const int first = content.u8();
        const int last = content.u8();
        const int refines = content.u8() >> 4;
        const bool needs_dc = first == 0 && (!is_progressive_ || refines == 0);
        const bool needs_ac = is_progressive_ ? first > 0 : true;
        if (!frame_ || first > last || last > 63) {
            throw BrokenPicture{"a JPEG with a scan before its frame, or of no coefficients"};
        }
        for (const auto& [id, tables] : selectors) {
            const auto component = std::find_if(components_.begin(), components_.end(),
                                                [id = id](const JpegComponent& each) { return each.id == id; });
            const bool are_told = component != components_.end() && quantisations_[component->quantisation] &&
                                  (!needs_dc || tables_[0][tables >> 4 & 3]) && (!needs_ac || tables_[1][tables & 3]);
            if (!are_told) {
                throw BrokenPicture{"a JPEG with a scan whose tables are missing"};
            }
        }
        has_scan_ = true;
    }

    /// To the next marker that is no restart: inside coded data a 0xFF is followed by a zero.
    void skip_entropy_coded() {
        while (true) {
            const std::size_t found = bytes_.find('\xff', reader_.at());
            if (found == std::string_view::npos) {
                throw BytesMissing{bytes_.size(), 2};
            }
            reader_.go_to(found + 1);
            const int next = reader_.u8();
            if (next != 0 && next != 0xFF && (next < 0xD0 || next > 0xD7)) {
                reader_.go_to(found);
                return;
            }
            if (next == 0xFF) {
                reader_.go_to(found + 1);
            }
        }
    }

    ByteReader reader_;
    std::string_view bytes_;
    std::optional<JpegFrame> frame_;
    std::vector<JpegComponent> components_;
    std::array<std::array<bool, 4>, 2> tables_{};
    std::array<bool, 4> quantisations_{};
    bool is_progressive_ = false;
    bool has_scan_ = false;
};

}  // namespace

JpegFrame check_jpeg_segments(std::string_view bytes) {
    return SegmentWalk(bytes).run();
}

}  // namespace bruma::io
