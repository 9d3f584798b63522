#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <regex>
#include <set>
#include <stdexcept>
#include <vector>

#include "app/scene_arguments.h"
#include "app/verbs/shader_variants.h"
#include "app/verbs/verbs.h"
#include "base/console.h"
#include "base/error.h"
#include "base/installation.h"
#include "context/context.h"
#include "gl/program.h"
#include "gl/shader_source.h"
#include "io/atomic_file.h"
#include "io/input_file.h"
#include "io/output_guard.h"

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

/// Every file that is a stage by itself, below the folder of shaders, as the library of shaders names it.
std::vector<std::filesystem::path> stages(const std::filesystem::path& root) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
        if (entry.is_regular_file() && entry.path().extension() != ".glsl") {
            files.push_back(std::filesystem::relative(entry.path(), root));
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// Calls `act` with the file and the switches of every variant of every shader.
void for_all(const std::function<void(const std::string&, const gl::Defines&)>& act) {
    for (const std::filesystem::path& file : stages(installed_folder("shaders"))) {
        for (const gl::Defines& defines : shader_variants(file.string())) {
            act(file.string(), defines);
        }
    }
}

std::string words_of(const std::string& file, const gl::Defines& defines) {
    std::string words = file;
    for (const auto& [name, value] : defines) {
        words.append(" ").append(name).append(value.empty() ? "" : "=").append(value);
    }
    return words;
}

/// Compiles every shader, without linking, and names those of which the driver has something to say.
int compile_all() {
    const auto context = context::open_offscreen(context::Kind::automatic);
    int count = 0;
    int faulty = 0;
    for_all([&](const std::string& file, const gl::Defines& defines) {
        const int before = context::driver_error_count();
        gl::compile_alone(installed_folder("shaders"), file, defines);
        ++count;
        if (context::driver_error_count() != before) {
            ++faulty;
            answer("{}\n", words_of(file, defines));
        }
    });
    answer("{} shaders compiled, {} of them with warnings\n", count, faulty);
    return int(faulty == 0 ? ExitCode::done : ExitCode::answer_is_no);
}

/// A whole shader, ready to be written.
struct ExpandedShader {
    std::filesystem::path path;
    std::string text;
};

int expand(const std::string& folder, bool force) {
    const std::filesystem::path root = installed_folder("shaders");
    io::require_writable_folder(folder);
    std::vector<ExpandedShader> expanded;
    std::set<std::string> asked_anywhere, defined_anywhere;
    for (const std::filesystem::path& path : stages(root)) {
        const std::string file = path.string();
        int number = 0;
        std::set<std::string> defined_here;
        for (const gl::Defines& defines : shader_variants(file)) {
            const std::string name = fmt::format("{}_{}{}", path.stem().string(), number++, path.extension().string());
            const gl::ShaderSource source = gl::read_shader(root, file, defines);
            std::for_each(source.files.begin(), source.files.end(), io::announce_input);
            asked_anywhere.merge(asked(source.text));
            defined_here.merge(defined(source.text));
            expanded.push_back({std::filesystem::path(folder) / name, source.text});
        }
        // What it includes may have parts for others.
        require_all(file, asked(contents(root / path)), defined_here);
        defined_anywhere.merge(defined_here);
    }
    require_all(root.string(), asked_anywhere, defined_anywhere);
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    io::OutputGuard outputs(force);
    for (const ExpandedShader& shader : expanded) {
        outputs.add("--expand", shader.path, io::FileContent::shader);
    }
    for (const ExpandedShader& shader : expanded) {
        io::write_file_atomically(shader.path, shader.text);
    }
    answer("{} shaders written to {}\n", expanded.size(), folder);
    return int(ExitCode::done);
}

}  // namespace

Verb declare_shaders(CLI::App& app) {
    auto folder = std::make_shared<std::string>();
    auto compile = std::make_shared<bool>(false);
    auto force = std::make_shared<bool>(false);
    auto* ways = app.add_option_group("way");
    ways->add_option("--expand", *folder,
                     "folder to write every shader to, includes and switches in place, for validators");
    ways->add_flag("--compile", *compile, "compile every shader with this machine's driver; 1 if it warns of any");
    ways->require_option(1);
    declare_force(app, *force);
    return [folder, compile, force] { return *compile ? compile_all() : expand(*folder, *force); };
}

}  // namespace bruma::app
