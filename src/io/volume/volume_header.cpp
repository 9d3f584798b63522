#include "io/volume/volume_header.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/log.h"
#include "io/input_file.h"
#include "io/volume/volume_header_text.h"

namespace bruma::io {
namespace {

std::string first_bytes(const std::filesystem::path& path, std::int64_t most) {
    const InputFile file(path);
    std::string text(std::size_t(std::min(most, file.size())), '\0');
    file.read(0, std::as_writable_bytes(std::span(text.data(), text.size())));
    return text;
}

bool begins_as_nrrd(std::string_view text) {
    return text.starts_with("NRRD000");
}

/// MetaImage has no magic number: one of its first lines says what it is.
bool begins_as_metaimage(std::string_view text) {
    for (int line = 0; line < 8 && !text.empty(); ++line) {
        const std::string_view words = cut_line(text);
        const std::string_view key = trimmed(words.substr(0, words.find('=')));
        if (words.find('=') == std::string_view::npos) {
            return false;
        }
        if (key == "NDims" || (key == "ObjectType" && trimmed(words.substr(words.find('=') + 1)) == "Image")) {
            return true;
        }
    }
    return false;
}

bool has_header_ending(const std::filesystem::path& path) {
    const std::string ending = lower_case(path.extension().string());
    return ending == ".mhd" || ending == ".nhdr";
}

/// Headers of the folder, those of the file's own name first.
std::vector<std::filesystem::path> headers_around(const std::filesystem::path& raw_path) {
    constexpr std::size_t most = 200;
    std::vector<std::filesystem::path> others;
    std::vector<std::filesystem::path> own;
    std::error_code ignored;
    const std::filesystem::path folder = raw_path.has_parent_path() ? raw_path.parent_path() : ".";
    for (std::filesystem::directory_iterator at(folder, ignored), end; at != end && others.size() < most;
         at.increment(ignored)) {
        if (has_header_ending(at->path())) {
            const std::filesystem::path stem = at->path().stem();
            (stem == raw_path.stem() || stem == raw_path.filename() ? own : others).push_back(at->path());
        }
    }
    std::sort(own.begin(), own.end());
    std::sort(others.begin(), others.end());
    own.insert(own.end(), others.begin(), others.end());
    return own;
}

bool names(const std::filesystem::path& header, const std::filesystem::path& raw_path) {
    // Only the file's name decides whether a header, which may be broken otherwise, is about this file.
    std::string text;
    try {
        text = first_bytes(header, longest_volume_header);
    } catch (const InputError&) {
        return false;
    }
    std::string_view left = text;
    while (!left.empty()) {
        const std::string_view line = cut_line(left);
        const std::size_t mark = line.find_first_of("=:");
        const std::string key = lower_case(trimmed(line.substr(0, std::min(mark, line.size()))));
        if (mark != std::string_view::npos && (key == "elementdatafile" || key == "data file" || key == "datafile")) {
            std::error_code ignored;
            return std::filesystem::equivalent(data_path(header, trimmed(line.substr(mark + 1))), raw_path, ignored);
        }
    }
    return false;
}

}  // namespace

std::string_view cut_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
}

std::string lower_case(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

std::vector<std::string> split_words(std::string_view text) {
    std::vector<std::string> words;
    for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
        const std::size_t end = std::min(text.size(), text.find_first_of(" \t"));
        words.emplace_back(text.substr(0, end));
        text.remove_prefix(end);
    }
    return words;
}

std::vector<double> numbers_of(std::string_view words, const std::filesystem::path& path, std::string_view field) {
    std::vector<double> numbers;
    for (const std::string& word : split_words(words)) {
        double& number = numbers.emplace_back();
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (error != std::errc() || end != word.data() + word.size()) {
            throw InputError(
                fmt::format("{}: {}: '{}' is no number; is the header whole?", path.string(), field, word));
        }
    }
    return numbers;
}

std::vector<int> sizes_of(std::string_view words, const std::filesystem::path& path, std::string_view field) {
    std::vector<int> sizes;
    for (const double number : numbers_of(words, path, field)) {
        if (!(number >= 1.0 && number <= double(1 << 30)) || number != std::floor(number)) {
            throw InputError(fmt::format("{}: {}: {} is no number of samples; each must be 1 to {}", path.string(),
                                         field, number, 1 << 30));
        }
        sizes.push_back(int(number));
    }
    return sizes;
}

glm::ivec3 three_edges(const std::vector<int>& edges, const std::filesystem::path& path,
                       std::vector<std::size_t>& kept) {
    kept.clear();
    for (std::size_t n = 0; n < edges.size(); ++n) {
        kept.push_back(n);
    }
    for (std::size_t n = kept.size(); n-- > 0 && kept.size() > 3;) {
        if (edges[kept[n]] == 1) {
            kept.erase(kept.begin() + std::ptrdiff_t(n));
        }
    }
    if (kept.size() > 3 || kept.empty()) {
        throw InputError(fmt::format(
            "{}: has {} dimensions, but volumes of one number a sample and three dimensions are read; write one "
            "component or moment of it to a file of its own",
            path.string(), edges.size()));
    }
    glm::ivec3 size(1);
    for (std::size_t n = 0; n < kept.size(); ++n) {
        size[int(n)] = edges[kept[n]];
    }
    return size;
}

std::filesystem::path data_path(const std::filesystem::path& header, std::string_view given) {
    std::string name(given);
    std::error_code ignored;
    if (!std::filesystem::exists(header.parent_path() / name, ignored)) {
        std::replace(name.begin(), name.end(), '\\', '/');
    }
    return header.parent_path() / name;
}

bool is_volume_header(const std::filesystem::path& path) {
    try {
        const std::string text = first_bytes(path, 4096);
        return begins_as_nrrd(text) || begins_as_metaimage(text);
    } catch (const InputError&) {
        return false;
    }
}

VolumeHeader read_volume_header(const std::filesystem::path& path) {
    const std::string text = first_bytes(path, longest_volume_header);
    return begins_as_nrrd(text) ? parse_nrrd(path, text) : parse_metaimage(path, text);
}

std::optional<VolumeHeader> header_beside(const std::filesystem::path& raw_path) {
    std::optional<VolumeHeader> found;
    for (const std::filesystem::path& path : headers_around(raw_path)) {
        if (!names(path, raw_path) || !is_volume_header(path)) {
            continue;
        }
        const VolumeHeader header = read_volume_header(path);
        const std::filesystem::path stem = path.stem();
        if (stem == raw_path.stem() || stem == raw_path.filename()) {
            return header;
        }
        if (found && !(found->says == header.says)) {
            log_note("{}: {} and {} both name it and say different things, so neither is used", raw_path.string(),
                     found->path.filename().string(), path.filename().string());
            return std::nullopt;
        }
        found = header;
    }
    return found;
}

}  // namespace bruma::io
