#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "app/verbs/verbs.h"
#include "base/error.h"
#include "base/installation.h"
#include "gl/shader_source.h"
#include "io/atomic_file.h"

namespace bruma::app {
namespace {

/// Every combination of the switches that the passes use.
std::vector<gl::Defines> variants_of(const std::string& file) {
    if (file == "background.frag") {
        return {{}, {{"OPAQUE", ""}}};
    }
    if (file == "mesh.frag") {
        return {{{"DIRECTIONAL_LIGHTS", "1"}, {"POINT_LIGHTS", "1"}}};
    }
    if (file == "path_trace.comp") {
        std::vector<gl::Defines> variants;
        for (const char* const lights : {"0", "2", "5"}) {
            variants.push_back({{"VOLUMES", "1"}, {"LIGHTS", lights}});
            variants.push_back({{"VOLUMES", "2"}, {"LIGHTS", lights}, {"GLOW", ""}});
        }
        return variants;
    }
    if (file != "volume_march.frag") {
        return {{}};
    }
    std::vector<gl::Defines> variants;
    for (int bits = 0; bits < 256; ++bits) {
        if ((bits & 2) && (bits & 64)) {
            continue;  // refinement belongs to pre-integration
        }
        gl::Defines defines{{"VOLUMES", bits & 1 ? "2" : "1"}};
        const auto add = [&](int bit, const char* name) {
            if (bits & bit) {
                defines[name] = "";
            }
        };
        add(2, "SAMPLE_AT_MIDPOINTS");
        add(64, "REFINE");
        add(4, "LEAP");
        add(8, "STOP_EARLY");
        add(16, "COUNT");
        add(128, "OPAQUE");
        if (bits & 32) {
            defines["LIT"] = "";
            defines["GLOW"] = "";
            defines["HIGHLIGHTS"] = "";
            defines["DIRECTIONAL_LIGHTS"] = "1";
            defines["POINT_LIGHTS"] = "1";
        }
        variants.push_back(defines);
    }
    return variants;
}

int expand(const std::string& folder) {
    const std::filesystem::path root = installed_folder("shaders");
    io::require_writable_folder(folder);
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(root)) {
        if (!entry.is_regular_file()) {
            continue;
        }
        const std::string file = entry.path().filename().string();
        int number = 0;
        for (const gl::Defines& defines : variants_of(file)) {
            const std::string name =
                fmt::format("{}_{}{}", entry.path().stem().string(), number++, entry.path().extension().string());
            io::write_file_atomically(std::filesystem::path(folder) / name, gl::read_shader(root, file, defines).text);
            ++count;
        }
    }
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
