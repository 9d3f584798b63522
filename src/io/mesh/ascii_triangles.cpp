#include "io/mesh/ascii_triangles.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include "io/blanks.h"
#include "io/input_file.h"

namespace bruma::io {
namespace {

bool is_text(std::string_view bytes) {
    return std::all_of(bytes.begin(), bytes.end(), [](char c) {
        return (c >= ' ' && c <= '~') || c == '\t' || c == '\r' || c == '\n' || (static_cast<unsigned char>(c) >= 128);
    });
}

/// What may stand between the numbers of a line.
constexpr std::string_view separators = " \t\r,;";

/// A line without its comment.
std::string_view content_of(std::string_view line) {
    return trimmed(line.substr(0, line.find('#')), separators);
}

/// The nine finite numbers of a line, or nothing.
std::optional<std::array<double, 9>> nine_numbers(std::string_view line) {
    std::array<double, 9> numbers{};
    const char* at = line.data();
    const char* const end = at + line.size();
    for (double& number : numbers) {
        while (at != end && is_blank(*at, separators)) {
            ++at;
        }
        if (at != end && *at == '+') {
            ++at;
        }
        const auto [after, error] = std::from_chars(at, end, number);
        if (error != std::errc() || !std::isfinite(number) || (after != end && !is_blank(*after, separators))) {
            return std::nullopt;
        }
        at = after;
    }
    while (at != end && is_blank(*at, separators)) {
        ++at;
    }
    return at == end ? std::optional(numbers) : std::nullopt;
}

class TriangleReader {
  public:
    /// Takes one line; false when the file turns out not to hold triangles.
    bool take(std::string_view line) {
        ++line_number_;
        const std::string_view content = content_of(line);
        if (content.empty()) {
            return true;
        }
        const auto numbers = nine_numbers(content);
        if (numbers) {
            add(*numbers);
        } else if (found_.count == 0) {
            return false;
        } else if (found_.first_bad_line == 0) {
            found_.first_bad_line = line_number_;
            found_.first_bad_text = content.substr(0, 60);
        }
        return true;
    }
    AsciiTriangles& found() { return found_; }

  private:
    void add(const std::array<double, 9>& n) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const glm::dvec3 p(n[3 * corner], n[3 * corner + 1], n[3 * corner + 2]);
            const bool first = found_.count == 0 && corner == 0;
            found_.low = first ? p : glm::min(found_.low, p);
            found_.high = first ? p : glm::max(found_.high, p);
            found_.corners.push_back(p);
        }
        ++found_.count;
    }

    AsciiTriangles found_;
    std::int64_t line_number_ = 0;
};

}  // namespace

std::optional<AsciiTriangles> read_ascii_triangles(const std::filesystem::path& path, const Progress& progress) {
    constexpr std::int64_t chunk_bytes = 1 << 20;
    constexpr std::size_t longest_line = 4096;  // nine numbers need at most some 250
    const InputFile file(path);
    TriangleReader reader;
    std::string rest;
    for (std::int64_t offset = 0; offset < file.size();) {
        // A small first piece, so that a volume of many gigabytes is told apart after four kilobytes.
        const std::int64_t length = std::min(offset == 0 ? 4096 : chunk_bytes, file.size() - offset);
        const std::size_t before = rest.size();
        rest.resize(before + std::size_t(length));
        file.read(offset, std::as_writable_bytes(std::span(rest.data() + before, std::size_t(length))));
        offset += length;
        if (progress && reader.found().count > 0) {
            progress(double(offset) / double(file.size()), "reading " + path.filename().string());
        }
        if (offset <= 4096 && !is_text(rest)) {
            return std::nullopt;
        }
        std::size_t from = 0;
        for (std::size_t end = rest.find('\n'); end != std::string::npos; end = rest.find('\n', from)) {
            if (!reader.take(std::string_view(rest).substr(from, end - from))) {
                return std::nullopt;
            }
            from = end + 1;
        }
        rest.erase(0, from);
        if (rest.size() > longest_line) {
            if (reader.found().count == 0) {
                return std::nullopt;
            }
            rest.resize(longest_line);
        }
    }
    if (!rest.empty() && !reader.take(rest)) {
        return std::nullopt;
    }
    return reader.found().count > 0 ? std::optional(std::move(reader.found())) : std::nullopt;
}

bool holds_ascii_triangles(const std::filesystem::path& path) {
    const InputFile file(path);
    std::string head(std::size_t(std::min<std::int64_t>(4096, file.size())), '\0');
    file.read(0, std::as_writable_bytes(std::span(head.data(), head.size())));
    if (!is_text(head)) {
        return false;
    }
    TriangleReader reader;
    for (std::size_t from = 0; from < head.size();) {
        const std::size_t end = head.find('\n', from);
        if (end == std::string::npos && std::int64_t(head.size()) < file.size()) {
            break;  // the line goes on behind the head
        }
        if (!reader.take(std::string_view(head).substr(from, end - from))) {
            return false;
        }
        if (reader.found().count > 0) {
            return true;
        }
        from = end == std::string::npos ? head.size() : end + 1;
    }
    // Nothing but comments so far: a rare file, read to its end.
    return std::int64_t(head.size()) < file.size() && read_ascii_triangles(path).has_value();
}

}  // namespace bruma::io
