#pragma once
#include <filesystem>
#include <string_view>

namespace bruma::io {

/// What a file holds, as far as it can be something that Bruma writes.
enum class FileContent {
    scene,              ///< a scene as JSON
    transfer_function,  ///< a transfer function as JSON
    png,
    hdr,
    exr,
    statistics,    ///< JSON of `render --stats`
    graph,         ///< Graphviz text of `render --graph`
    shader,        ///< a whole shader of `shaders --expand`
    bench_table,   ///< CSV of a bench
    bench_record,  ///< JSON of a bench
    bench_page,    ///< HTML of a bench
    nothing,       ///< an empty file
    other          ///< anything else, and what cannot be read
};

/// The kind in words that follow an article: "a scene", "a PNG picture".
std::string_view content_words(FileContent content);

/// What an existing regular file holds, told from its bytes and never from its name. Does not throw: a file that is
/// missing or cannot be read holds something else.
FileContent content_of(const std::filesystem::path& path);

}  // namespace bruma::io
