#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace bruma::io {

/// Thrown by ByteReader for bytes that are not there; whoever knows the file's name turns it into a sentence.
struct BytesMissing {
    std::size_t at;     ///< where the bytes end
    std::size_t early;  ///< how many more were asked for
};

/// Walks over bytes in memory and never past their end: every read either gives what is there or throws BytesMissing.
class ByteReader {
  public:
    explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

    std::string_view all() const { return bytes_; }
    std::size_t at() const { return at_; }
    std::size_t left() const { return bytes_.size() - at_; }

    /// Moves to a place from the beginning on; the end itself is one.
    void go_to(std::size_t place) {
        if (place > bytes_.size()) {
            throw BytesMissing{bytes_.size(), place - bytes_.size()};
        }
        at_ = place;
    }
    std::string_view take(std::size_t count) {
        if (count > left()) {
            throw BytesMissing{bytes_.size(), count - left()};
        }
        at_ += count;
        return bytes_.substr(at_ - count, count);
    }
    void skip(std::size_t count) { take(count); }
    std::uint8_t u8() { return std::uint8_t(take(1)[0]); }

    std::uint16_t le16() { return std::uint16_t(little(2)); }
    std::uint32_t le32() { return std::uint32_t(little(4)); }
    std::uint64_t le64() { return little(8); }
    std::int32_t signed_le32() { return std::int32_t(le32()); }
    std::uint16_t be16() { return std::uint16_t(big(2)); }
    std::uint32_t be32() { return std::uint32_t(big(4)); }

  private:
    std::uint64_t little(std::size_t count) {
        const std::string_view bytes = take(count);
        std::uint64_t value = 0;
        for (std::size_t n = count; n-- > 0;) {
            value = value << 8 | std::uint8_t(bytes[n]);
        }
        return value;
    }
    std::uint64_t big(std::size_t count) {
        const std::string_view bytes = take(count);
        std::uint64_t value = 0;
        for (const char byte : bytes) {
            value = value << 8 | std::uint8_t(byte);
        }
        return value;
    }

    std::string_view bytes_;
    std::size_t at_ = 0;
};

}  // namespace bruma::io
