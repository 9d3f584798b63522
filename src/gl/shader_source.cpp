#include "gl/shader_source.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <regex>
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
            throw InputError(fmt::format("{}:{}: #include wants a path in double quotes", (root / file).string(),
                                         number));
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

std::string map_compile_log(const std::string& log, const std::vector<std::filesystem::path>& files) {
    // Mesa writes "2:14(5): error", NVIDIA "2(14) : error": source number first, then the line.
    static const std::regex place(R"(^(\d+)[:(](\d+)\)?)");
    std::istringstream in(log);
    std::string out, line;
    while (std::getline(in, line)) {
        std::smatch match;
        if (std::regex_search(line, match, place)) {
            const std::size_t index = std::stoul(match[1]);
            if (index < files.size()) {
                line = fmt::format("{}:{}{}", files[index].string(), match[2].str(), match.suffix().str());
            }
        }
        out += line + "\n";
    }
    return out;
}

}  // namespace bruma::gl
