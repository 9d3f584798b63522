#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "io/picture/exr_unpacking.h"
#include "io/picture/raster_picture.h"

// Compression PIZ of OpenEXR, as its "Technical Introduction" and file layout describe it: samples are numbers of 16
// bits (wider ones are two), replaced by their ranks among those that occur, transformed by a wavelet and coded.
namespace bruma::io {
namespace {

constexpr std::size_t value_count = 65536;
constexpr std::size_t longest_code = 58;

/// Bits of a text, the uppermost of each byte first.
class PizBits {
  public:
    PizBits(std::string_view bytes, std::uint64_t count) : bytes_(bytes), count_(count) {
        if (count > 8 * std::uint64_t(bytes.size())) {
            throw BytesMissing{bytes.size(), std::size_t(count / 8) - bytes.size() + 1};
        }
    }
    unsigned next() {
        if (at_ == count_) {
            throw BrokenPicture{"a chunk's code ends early"};
        }
        const unsigned byte = std::uint8_t(bytes_[at_ / 8]);
        return byte >> (7 - at_++ % 8) & 1U;
    }
    unsigned next(int count) {
        unsigned value = 0;
        for (int n = 0; n < count; ++n) {
            value = value << 1 | next();
        }
        return value;
    }
    std::size_t whole_bytes_used() const { return std::size_t((at_ + 7) / 8); }

  private:
    std::string_view bytes_;
    std::uint64_t count_;
    std::uint64_t at_ = 0;
};

/// A Huffman code told by the lengths of its words: the longest words are the smallest numbers, and words of one length
/// count up with their symbols.
class PizCode {
  public:
    explicit PizCode(const std::vector<std::uint8_t>& lengths) {
        for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol) {
            if (lengths[symbol] > 0) {
                of_length_[lengths[symbol]].symbols.push_back(std::uint32_t(symbol));
            }
        }
        std::uint64_t word = 0;
        for (std::size_t length = longest_code; length > 0; --length) {
            of_length_[length].first = word;
            word = (word + of_length_[length].symbols.size()) >> 1;
        }
    }
    std::uint32_t next(PizBits& bits) const {
        std::uint64_t word = 0;
        for (std::size_t length = 1; length <= longest_code; ++length) {
            word = word << 1 | bits.next();
            const Words& words = of_length_[length];
            if (word >= words.first && word - words.first < words.symbols.size()) {
                return words.symbols[std::size_t(word - words.first)];
            }
        }
        throw BrokenPicture{"a chunk's code has an unknown word"};
    }

  private:
    struct Words {
        std::uint64_t first = 0;
        std::vector<std::uint32_t> symbols;
    };
    std::array<Words, longest_code + 1> of_length_;
};

/// Lengths of the words of symbols `first` to `last`, six bits each; the largest lengths stand for runs of none.
std::vector<std::uint8_t> read_lengths(PizBits& bits, std::size_t first, std::size_t last) {
    std::vector<std::uint8_t> lengths(last + 1, 0);
    for (std::size_t symbol = first; symbol <= last;) {
        const unsigned told = bits.next(6);
        if (told <= longest_code) {
            lengths[symbol++] = std::uint8_t(told);
            continue;
        }
        const std::size_t run = told == 63 ? bits.next(8) + 6U : told - 59U + 2U;
        if (run > last + 1 - symbol) {
            throw BrokenPicture{"a chunk's code leaves its table"};
        }
        symbol += run;
    }
    return lengths;
}

void decode_values(std::string_view packed, std::vector<std::uint16_t>& values) {
    ByteReader reader(packed);
    const std::uint32_t first = reader.le32();
    const std::uint32_t last = reader.le32();  // its word tells a run of the value before
    reader.skip(4);
    const std::uint32_t bit_count = reader.le32();
    reader.skip(4);
    if (first > last || last > value_count) {
        throw BrokenPicture{"a chunk's code is for no numbers"};
    }
    const std::string_view rest = packed.substr(reader.at());
    PizBits table(rest, 8 * std::uint64_t(rest.size()));
    const PizCode code(read_lengths(table, first, last));
    PizBits bits(rest.substr(table.whole_bytes_used()), bit_count);
    for (std::size_t at = 0; at < values.size();) {
        const std::uint32_t symbol = code.next(bits);
        if (symbol != last) {
            values[at++] = std::uint16_t(symbol);
            continue;
        }
        const std::size_t run = bits.next(8);
        if (at == 0 || run > values.size() - at) {
            throw BrokenPicture{"a chunk's run leaves it"};
        }
        std::fill_n(values.begin() + std::ptrdiff_t(at), run, values[at - 1]);
        at += run;
    }
}

struct PizPair {
    std::uint16_t a, b;
};

/// Mean and difference back to two values, where all are below 2^14 ...
PizPair undo_narrow(std::uint16_t mean, std::uint16_t difference) {
    const int d = std::int16_t(difference);
    const int a = std::int16_t(mean) + (d & 1) + (d >> 1);
    return {std::uint16_t(a), std::uint16_t(a - d)};
}
/// ... and where they need all 16 bits: sums wrap around.
PizPair undo_wide(std::uint16_t mean, std::uint16_t difference) {
    const unsigned b = (unsigned(mean) - (difference >> 1U)) & 0xFFFFU;
    return {std::uint16_t(difference + b - 0x8000U), std::uint16_t(b)};
}

/// A picture of one component within its samples.
struct PizPlane {
    std::uint16_t* values;
    std::size_t width, height, stride;  ///< values from one to the next along x
    std::uint16_t& at(std::size_t x, std::size_t y) const { return values[(y * width + x) * stride]; }
};

template <class Undo>
void undo_wavelet(const PizPlane& plane, Undo undo) {
    const auto pair = [&](std::uint16_t& a, std::uint16_t& b) {
        const PizPair both = undo(a, b);
        a = both.a;
        b = both.b;
    };
    std::size_t step = 1;
    while (2 * step <= std::min(plane.width, plane.height)) {
        step *= 2;
    }
    for (step /= 2; step >= 1; step /= 2) {
        std::size_t y = 0;
        for (; y + 2 * step <= plane.height; y += 2 * step) {
            std::size_t x = 0;
            for (; x + 2 * step <= plane.width; x += 2 * step) {
                pair(plane.at(x, y), plane.at(x, y + step));
                pair(plane.at(x + step, y), plane.at(x + step, y + step));
                pair(plane.at(x, y), plane.at(x + step, y));
                pair(plane.at(x, y + step), plane.at(x + step, y + step));
            }
            if ((plane.width & step) != 0) {
                pair(plane.at(x, y), plane.at(x, y + step));
            }
        }
        if ((plane.height & step) != 0) {
            for (std::size_t x = 0; x + 2 * step <= plane.width; x += 2 * step) {
                pair(plane.at(x, y), plane.at(x + step, y));
            }
        }
    }
}

/// The values that occur, told by a bit each; 0 always does.
std::vector<std::uint16_t> read_values(ByteReader& reader) {
    constexpr std::size_t bitmap_bytes = value_count / 8;
    std::vector<std::uint8_t> bitmap(bitmap_bytes, 0);
    const std::size_t first = reader.le16();
    const std::size_t last = reader.le16();
    if (last >= bitmap_bytes) {
        throw BrokenPicture{"a chunk's table of values is too long"};
    }
    if (first <= last) {
        const std::string_view bytes = reader.take(last - first + 1);
        std::copy(bytes.begin(), bytes.end(), bitmap.begin() + std::ptrdiff_t(first));
    }
    bitmap[0] |= 1;
    std::vector<std::uint16_t> values;
    for (std::size_t value = 0; value < value_count; ++value) {
        if ((bitmap[value / 8] >> value % 8 & 1) != 0) {
            values.push_back(std::uint16_t(value));
        }
    }
    return values;
}

}  // namespace

void unpack_exr_piz(const ExrHeader& header, std::string_view packed, std::size_t width, std::size_t rows,
                    std::span<std::byte> into) {
    ByteReader reader(packed);
    const std::vector<std::uint16_t> occurring = read_values(reader);
    const std::string_view coded = reader.take(reader.le32());
    std::vector<std::uint16_t> values(into.size() / 2, 0);
    decode_values(coded, values);
    std::size_t begin = 0;
    for (const ExrChannel& channel : header.channels) {
        const std::size_t parts = bytes_of(channel.sample) / 2;
        for (std::size_t part = 0; part < parts; ++part) {
            const PizPlane plane{values.data() + begin + part, width, rows, parts};
            occurring.size() - 1 < (1U << 14) ? undo_wavelet(plane, undo_narrow) : undo_wavelet(plane, undo_wide);
        }
        begin += parts * width * rows;
    }
    std::size_t at = 0;
    for (std::size_t row = 0; row < rows; ++row) {
        begin = 0;
        for (const ExrChannel& channel : header.channels) {
            const std::size_t parts = bytes_of(channel.sample) / 2;
            for (std::size_t n = 0; n < parts * width; ++n) {
                const std::size_t rank = values[begin + row * parts * width + n];
                const unsigned value = rank < occurring.size() ? occurring[rank] : 0;
                into[at++] = std::byte(value & 255U);
                into[at++] = std::byte(value >> 8U);
            }
            begin += parts * width * rows;
        }
    }
}

}  // namespace bruma::io
