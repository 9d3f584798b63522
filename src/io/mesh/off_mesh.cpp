#include "io/mesh/off_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/memory.h"
#include "io/input_file.h"

namespace bruma::io {
namespace {

/// Lines that hold something, and the numbers in them.
class OffLines {
  public:
    OffLines(std::string_view text, const std::filesystem::path& path, const Progress& progress)
        : text_(text), path_(path), progress_(progress) {}

    /// Goes on to the next line with content; false at the end of the text.
    bool next() {
        while (at_ < text_.size()) {
            const std::size_t end = std::min(text_.find_first_of("\n\r", at_), text_.size());
            line_ = text_.substr(at_, end - at_);
            line_ = line_.substr(0, line_.find('#'));
            at_ = text_.substr(end, 2) == "\r\n" ? end + 2 : end + 1;
            ++number_;
            if (progress_ && number_ % 65536 == 0) {
                progress_(double(at_) / double(text_.size()), "reading " + path_.filename().string());
            }
            skip_blanks();
            if (!line_.empty()) {
                return true;
            }
        }
        return false;
    }
    void require_next(std::string_view expected) {
        if (!next()) {
            ++number_;
            fail(fmt::format("the file ends here, expected {}; was it copied to its end?", expected));
        }
    }

    /// A word of letters and digits at the head of the line, if it begins with a letter.
    std::string word() {
        std::size_t length = 0;
        while (length < line_.size() && std::isalnum(static_cast<unsigned char>(line_[length])) != 0) {
            ++length;
        }
        if (length == 0 || std::isalpha(static_cast<unsigned char>(line_[0])) == 0) {
            return {};
        }
        std::string found(line_.substr(0, length));
        line_.remove_prefix(length);
        skip_blanks();
        return found;
    }
    bool is_used_up() const { return line_.empty(); }
    std::size_t line_number() const { return number_; }

    template <class Number>
    std::optional<Number> number() {
        Number value{};
        const char* const end = line_.data() + line_.size();
        const auto [after, error] = std::from_chars(line_.data(), end, value);
        if (error != std::errc() || (after != end && *after != ' ' && *after != '\t')) {
            return std::nullopt;
        }
        line_.remove_prefix(std::size_t(after - line_.data()));
        skip_blanks();
        return value;
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(fmt::format("{}: line {}: {}", path_.string(), number_, what));
    }

  private:
    void skip_blanks() { line_.remove_prefix(std::min(line_.find_first_not_of(" \t"), line_.size())); }

    std::string_view text_, line_;
    const std::filesystem::path& path_;
    const Progress& progress_;
    std::size_t at_ = 0;
    std::size_t number_ = 0;
};

struct Counts {
    std::int64_t vertices = 0, faces = 0;
};

Counts read_head(OffLines& lines, std::size_t bytes) {
    lines.require_next("the word OFF");
    const std::string word = lines.word();
    if (!word.empty() && (!word.ends_with("OFF") || word.find_first_not_of("STCN") != word.size() - 3)) {
        lines.fail(fmt::format("found '{}', expected OFF, or COFF or NOFF for three dimensions", word));
    }
    if (lines.is_used_up()) {
        lines.require_next("the numbers of vertices and faces");
    }
    const auto vertices = lines.number<std::int64_t>();
    const auto faces = vertices ? lines.number<std::int64_t>() : std::nullopt;
    if (!faces) {
        lines.fail(lines.word() == "BINARY" ? "binary OFF is not read; convert it to text"
                                            : "expected the numbers of vertices, faces and edges");
    }
    // Each takes a line of at least two bytes: a number beyond that would only ask for memory.
    if (*vertices < 0 || *faces < 0 || std::uint64_t(*vertices) + std::uint64_t(*faces) > bytes) {
        lines.fail(fmt::format("{} vertices and {} faces, but the whole file has {} bytes", *vertices, *faces, bytes));
    }
    return {*vertices, *faces};
}

}  // namespace

scene::LoadedMesh load_off_mesh(const std::filesystem::path& path, const scene::MeshSource& source,
                                const Progress& progress) {
    const std::string text = read_text_file(path, std::int64_t(available_memory() / 10));
    OffLines lines(text, path, progress);
    const Counts counts = read_head(lines, text.size());
    scene::MeshParts parts;
    parts.name = path.stem().string();
    parts.where = path.string();
    parts.positions.reserve(std::size_t(counts.vertices));
    for (std::int64_t n = 0; n < counts.vertices; ++n) {
        lines.require_next(fmt::format("vertex {} of {}", n + 1, counts.vertices));
        glm::dvec3 position(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            const auto number = lines.number<double>();
            if (!number) {
                lines.fail(fmt::format("expected the three numbers of vertex {} of {}", n + 1, counts.vertices));
            }
            position[axis] = *number;
        }
        parts.positions.push_back(position);
    }
    std::vector<scene::FaceCorner> face;
    for (std::int64_t n = 0; n < counts.faces; ++n) {
        lines.require_next(fmt::format("face {} of {}", n + 1, counts.faces));
        const auto corners = lines.number<std::int32_t>();
        face.clear();
        while (corners && std::int64_t(face.size()) < *corners) {
            const auto index = lines.number<std::int32_t>();
            if (!index) {
                break;
            }
            face.push_back({*index, -1, -1});
        }
        if (!corners || *corners < 0 || std::int64_t(face.size()) < *corners) {
            lines.fail(fmt::format("expected face {} of {}: its number of corners, then as many indices", n + 1,
                                   counts.faces));
        }
        const auto verdict = parts.add_face(face, 0);
        if (verdict != scene::MeshParts::Verdict::good && parts.first_left_out.empty()) {
            parts.first_left_out = fmt::format("line {}", lines.line_number());
        }
    }
    return scene::make_mesh(parts, source, scene::commented_unit_mm(std::string_view(text).substr(0, 4096)));
}

}  // namespace bruma::io
