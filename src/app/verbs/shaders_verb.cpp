#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <regex>
#include <set>
#include <stdexcept>

#include "app/verbs/shader_variants.h"
#include "app/verbs/verbs.h"
#include "base/error.h"
#include "base/installation.h"
#include "gl/shader_source.h"
#include "io/atomic_file.h"

namespace bruma::app {
namespace {

std::set<std::string> found_in(const std::string& text, const std::regex& pattern) {
    std::set<std::string> names;
    for (std::sregex_iterator at(text.begin(), text.end(), pattern); at != std::sregex_iterator(); ++at) {
        names.insert((*at)[1]);
    }
    return names;
}

/// The switches that a text asks for.
std::set<std::string> asked(const std::string& text) {
    static const std::regex directive(R"(#\s*ifn?def\s+(\w+))"), question(R"(defined\s*\(\s*(\w+))");
    std::set<std::string> names = found_in(text, directive);
    names.merge(found_in(text, question));
    return names;
}

std::set<std::string> defined(const std::string& text) {
    static const std::regex directive(R"(#\s*define\s+(\w+))");
    return found_in(text, directive);
}

/// Throws when a part of a shader is in none of its variants, so that no validator would read it.
void require_all(const std::string& where, const std::set<std::string>& asked, const std::set<std::string>& defined) {
    for (const std::string& name : asked) {
        if (!defined.contains(name)) {
            throw std::logic_error(fmt::format(
                "{} asks for {}, which none of its variants defines; add it to shader_variants.cpp", where, name));
        }
    }
}

std::string contents(const std::filesystem::path& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

int expand(const std::string& folder) {
    const std::filesystem::path root = installed_folder("shaders");
    io::require_writable_folder(folder);
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    int count = 0;
    std::set<std::string> asked_anywhere, defined_anywhere;
    for (const auto& entry : std::filesystem::directory_iterator(root)) {
        if (!entry.is_regular_file()) {
            continue;
        }
        const std::string file = entry.path().filename().string();
        int number = 0;
        std::set<std::string> defined_here;
        for (const gl::Defines& defines : shader_variants(file)) {
            const std::string name =
                fmt::format("{}_{}{}", entry.path().stem().string(), number++, entry.path().extension().string());
            const std::string text = gl::read_shader(root, file, defines).text;
            asked_anywhere.merge(asked(text));
            defined_here.merge(defined(text));
            io::write_file_atomically(std::filesystem::path(folder) / name, text);
            ++count;
        }
        // What it includes may have parts for others.
        require_all(file, asked(contents(entry.path())), defined_here);
        defined_anywhere.merge(defined_here);
    }
    require_all(root.string(), asked_anywhere, defined_anywhere);
    fmt::print("{} shaders written to {}\n", count, folder);
    return int(ExitCode::done);
}

}  // namespace

Verb declare_shaders(CLI::App& app) {
    auto folder = std::make_shared<std::string>();
    app.add_option("--expand", *folder,
                   "folder to write every shader to, includes and switches in place, for validators")
        ->required();
    return [folder] { return expand(*folder); };
}

}  // namespace bruma::app
