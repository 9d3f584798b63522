#include "io/file_content.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

namespace bruma::io {
namespace {

using nlohmann::json;

constexpr std::size_t head_bytes = 4096;

std::string head_of(std::ifstream& file) {
    std::string head(head_bytes, '\0');
    file.read(head.data(), std::streamsize(head.size()));
    head.resize(std::size_t(file.gcount()));
    return head;
}

/// Only the top of the document is kept, so that no depth of nesting costs anything.
FileContent content_of_json(std::ifstream& file) {
    file.clear();
    file.seekg(0);
    const auto top_only = [](int depth, json::parse_event_t, json&) { return depth <= 1; };
    const json document = json::parse(file, top_only, false);
    const auto has = [&](const char* key) { return document.is_object() && document.contains(key); };
    if (has("bruma_scene")) {
        return FileContent::scene;
    }
    if (has("bruma_transfer_function")) {
        return FileContent::transfer_function;
    }
    if (has("bench") && has("machine")) {
        return FileContent::bench_record;
    }
    return has("driver") && has("passes") ? FileContent::statistics : FileContent::other;
}

/// A bench's table begins with the names of its columns, errors among them.
bool is_bench_header(std::string_view line) {
    const bool only_names = std::all_of(line.begin(), line.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == ',';
    });
    const auto has = [&](std::string_view name) { return line.find(name) != std::string_view::npos; };
    return only_names && std::count(line.begin(), line.end(), ',') >= 6 && (has(",rmse") || has(",deviation_ours"));
}

}  // namespace

std::string_view content_words(FileContent content) {
    static constexpr std::array<std::string_view, 13> words{"a scene",
                                                            "a transfer function",
                                                            "a PNG picture",
                                                            "a Radiance HDR picture",
                                                            "an OpenEXR picture",
                                                            "statistics of a frame",
                                                            "a drawing of the frame graph",
                                                            "an expanded shader",
                                                            "a bench's table",
                                                            "a bench's numbers",
                                                            "a bench's page",
                                                            "nothing",
                                                            "something else"};
    return words[std::size_t(content)];
}

FileContent content_of(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) {
        return FileContent::other;  // opening a pipe would wait for its writer
    }
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        return FileContent::other;
    }
    const std::string head = head_of(file);
    const auto begins = [&](std::string_view mark) { return head.starts_with(mark); };
    if (head.empty()) {
        return FileContent::nothing;
    }
    if (begins("\x89PNG\r\n\x1a\n")) {
        return FileContent::png;
    }
    if (begins("#?RADIANCE\n") || begins("#?RGBE\n")) {
        return FileContent::hdr;
    }
    if (begins("\x76\x2f\x31\x01")) {
        return FileContent::exr;
    }
    if (begins("digraph bruma {")) {
        return FileContent::graph;
    }
    // An include is replaced by a #line that counts on from the first text; people do not write such lines.
    if (begins("#version") && head.find("\n#line ") != std::string::npos) {
        return FileContent::shader;
    }
    if (head.find("<title>Bruma: ") != std::string::npos) {
        return FileContent::bench_page;
    }
    if (is_bench_header(std::string_view(head).substr(0, head.find('\n')))) {
        return FileContent::bench_table;
    }
    const std::size_t first = head.find_first_not_of(" \t\r\n");
    constexpr std::uintmax_t most_json_bytes = 256 << 20;
    if (first != std::string::npos && head[first] == '{' &&
        std::filesystem::file_size(path, error) <= most_json_bytes) {
        return content_of_json(file);
    }
    return FileContent::other;
}

}  // namespace bruma::io
