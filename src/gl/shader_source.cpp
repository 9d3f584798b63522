#include "gl/shader_source.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "base/error.h"

namespace bruma::gl {
namespace {

void append_file(ShaderSource& source, const std::filesystem::path& root, const std::filesystem::path& file,
                 const Defines* defines, const std::string& included_from) {
    std::ifstream in(root / file);
    if (!in) {
        throw InputError(fmt::format("{}: this shader file cannot be read{}; is --shaders right?",
                                     (root / file).string(), included_from));
    }
    const std::size_t index = source.files.size();
    source.files.push_back(root / file);
    if (!defines) {
        source.text += fmt::format("#line 1 {}\n", index);
    }
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        if (defines && line.starts_with("#version")) {
            source.text += line + "\n";
            for (const auto& [name, value] : *defines) {
                source.text += fmt::format("#define {} {}\n", name, value);
            }
            source.text += fmt::format("#line {} {}\n", number + 1, index);
            continue;
        }
        if (!line.starts_with("#include")) {
            source.text += line + "\n";
            continue;
        }
        const std::size_t open = line.find('"');
        const std::size_t close = line.rfind('"');
        if (open == std::string::npos || close <= open) {
            throw InputError(
                fmt::format("{}:{}: #include wants a path in double quotes", (root / file).string(), number));
        }
        const std::filesystem::path wanted = line.substr(open + 1, close - open - 1);
        if (std::find(source.files.begin(), source.files.end(), root / wanted) == source.files.end()) {
            append_file(source, root, wanted, nullptr,
                        fmt::format(", included at {}:{}", (root / file).string(), number));
            source.text += fmt::format("#line {} {}\n", number + 1, index);
        } else {
            source.text += "\n";
        }
    }
}

}  // namespace

ShaderSource read_shader(const std::filesystem::path& root, const std::string& file, const Defines& defines) {
    ShaderSource source;
    append_file(source, root, file, &defines, "");
    return source;
}

namespace {

/// Reads a whole number at `at` and moves past it; -1 when there is none.
long read_number(const std::string& text, std::size_t& at) {
    long number = -1;
    for (; at < text.size() && text[at] >= '0' && text[at] <= '9' && number < 1'000'000; ++at) {
        number = std::max(number, 0L) * 10 + (text[at] - '0');
    }
    return number;
}

}  // namespace

std::string map_compile_log(const std::string& log, const std::vector<std::filesystem::path>& files) {
    std::istringstream in(log);
    std::string out, line;
    while (std::getline(in, line)) {
        // Mesa writes "2:14(5): error", NVIDIA "2(14) : error": source number first, then the line.
        std::size_t at = 0;
        const long source = read_number(line, at);
        if (source >= 0 && source < long(files.size()) && at < line.size() && (line[at] == ':' || line[at] == '(')) {
            const bool in_brackets = line[at++] == '(';
            const long number = read_number(line, at);
            if (number >= 0) {
                at += in_brackets && at < line.size() && line[at] == ')' ? 1 : 0;
                line = fmt::format("{}:{}{}", files[std::size_t(source)].string(), number, line.substr(at));
            }
        }
        out += line + "\n";
    }
    return out;
}

}  // namespace bruma::gl
