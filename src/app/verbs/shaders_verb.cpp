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

using Variants = std::vector<gl::Defines>;

Variants path_trace_variants() {
    Variants variants;
    for (const char* const lights : {"0", "2", "5"}) {
        variants.push_back({{"VOLUMES", "1"}, {"LIGHTS", lights}});
        variants.push_back({{"VOLUMES", "2"}, {"LIGHTS", lights}, {"GLOW", ""}});
    }
    return variants;
}

/// What light adds to the march: for surfaces, for scattering media, for both at once.
Variants lit_variants() {
    const gl::Defines common{
        {"LIT", ""}, {"GLOW", ""}, {"HIGHLIGHTS", ""}, {"DIRECTIONAL_LIGHTS", "1"}, {"POINT_LIGHTS", "1"}};
    const Variants kinds{{{"REFLECT", ""}},
                         {{"SCATTER", ""}, {"NEAR_STEPS", "0"}},
                         {{"SCATTER", ""}, {"NEAR_STEPS", "2"}, {"DIFFUSE_LIGHT", ""}},
                         {{"SCATTER", ""}, {"NEAR_STEPS", "2"}, {"DIFFUSE_LIGHT", ""}, {"SURFACES", ""}},
                         {{"SCATTER", ""}, {"NEAR_STEPS", "2"}, {"REFLECT", ""}}};
    Variants variants;
    for (gl::Defines defines : kinds) {
        defines.insert(common.begin(), common.end());
        variants.push_back(defines);
    }
    return variants;
}

Variants march_variants() {
    Variants lights = lit_variants();
    lights.insert(lights.begin(), gl::Defines{});
    Variants variants;
    for (const gl::Defines& light : lights) {
        for (int bits = 0; bits < 128; ++bits) {
            if ((bits & 2) && (bits & 32)) {
                continue;  // refinement belongs to pre-integration
            }
            gl::Defines defines = light;
            defines["VOLUMES"] = bits & 1 ? "2" : "1";
            const auto add = [&](int bit, const char* name) {
                if (bits & bit) {
                    defines[name] = "";
                }
            };
            add(2, "SAMPLE_AT_MIDPOINTS");
            add(4, "LEAP");
            add(8, "STOP_EARLY");
            add(16, "COUNT");
            add(32, "REFINE");
            add(64, "OPAQUE");
            variants.push_back(defines);
        }
    }
    // The sky stands in for what is behind, whatever the march does.
    variants.push_back({{"VOLUMES", "1"}, {"SKY", ""}});
    variants.push_back({{"VOLUMES", "2"}, {"SKY", ""}, {"OPAQUE", ""}});
    return variants;
}

Variants light_variants(const std::string& file) {
    Variants variants;
    for (const bool from_point : {false, true}) {
        gl::Defines defines;
        if (from_point) {
            defines["FROM_POINT"] = "";
        }
        const auto add = [&](const gl::Defines& more) {
            gl::Defines all = defines;
            all.insert(more.begin(), more.end());
            variants.push_back(all);
        };
        const gl::Defines white{{"BORDER_LIGHT", "vec3(1.0)"}};
        if (file == "light_sweep.comp") {
            for (const char* const width : {"WHOLE_SLICES", "ONE_SLICE"}) {
                for (const char* const empty : {"LEAP", "WALK"}) {
                    add({{width, ""}, {empty, ""}});
                    add({{width, ""}, {empty, ""}, {"DIFFUSE", ""}, {"BORDER_LIGHT", "vec3(0.0)"}});
                    add({{width, ""}, {empty, ""}, {"PAPER", ""}, *white.begin()});
                }
            }
        } else if (file == "light_combine.comp") {
            add({{"CHANNELS", "1"}, {"FORMAT", "r16f"}});
            add({{"CHANNELS", "4"}, {"FORMAT", "rgba32f"}, {"ALSO_DIRECT", "r32f"}, *white.begin()});
        } else {
            add({{"VOLUMES", "1"}, {"SAMPLE_AT_MIDPOINTS", ""}, {"LEAP", ""}, {"STOP_EARLY", ""}, {"FORMAT", "r16f"}});
        }
    }
    return variants;
}

Variants sky_variants() {
    Variants variants;
    for (const char* const model : {"", "PREETHAM", "LOOK"}) {
        for (int bits = 0; bits < 4; ++bits) {
            gl::Defines defines;
            for (const char* const name : {model, bits & 1 ? "MARCH" : "", bits & 2 ? "OPAQUE" : ""}) {
                if (*name != '\0') {
                    defines[name] = "";
                }
            }
            variants.push_back(defines);
        }
    }
    return variants;
}

Variants cloud_variants() {
    Variants variants;
    for (int bits = 0; bits < 256; ++bits) {
        gl::Defines defines;
        const auto add = [&](int bit, const char* name) {
            if (bits & bit) {
                defines[name] = "";
            }
        };
        add(1, "BOX");
        add(2, "OPAQUE");
        add(4, "CONE");
        add(8, "LEAP");
        add(8, "AIR");  // neither knows of the other
        add(16, "BIG_STEPS");
        add(32, "STOP_EARLY");
        add(64, "ADAPT");
        add(128, "COUNT");
        if (bits & 1) {
            defines["ARTISTIC"] = "";
        } else {
            defines["OCTAVES"] = "8";
            add(2, "HALVING");
        }
        variants.push_back(defines);
    }
    return variants;
}

/// Every combination of the switches that the passes use.
Variants variants_of(const std::string& file) {
    if (file == "background.frag") {
        return {{},
                {{"OPAQUE", ""}},
                {{"SKY", ""}},
                {{"CLOUDS", "1"}},
                {{"OPAQUE", ""}, {"CLOUDS", "3"}},
                {{"SKY", ""}, {"CLOUDS", "1"}}};
    }
    if (file == "sky.frag") {
        return sky_variants();
    }
    if (file == "mesh.frag") {
        const gl::Defines lights{{"DIRECTIONAL_LIGHTS", "1"}, {"POINT_LIGHTS", "1"}};
        Variants variants{{{"DEPTH_ONLY", ""}}, {{"THICKNESS", ""}}, lights};
        variants.push_back(lights);
        variants.back()["SKY_LIGHT"] = "";
        variants.push_back(lights);
        variants.back()["CLOUD_SHADOWS"] = "2";
        for (gl::Defines inside :
             Variants{{}, {{"SKY_LIGHT", ""}}, {{"FROM_POINTS", ""}}, {{"FROM_POINTS", ""}, {"CUBE_LAMPS", ""}}}) {
            inside.insert(lights.begin(), lights.end());
            inside["TRANSLUCENT"] = "";
            variants.push_back(inside);
            inside["SHADOWS"] = "";
            variants.push_back(inside);
        }
        return variants;
    }
    if (file == "radiosity.comp") {
        return {{}, {{"CUBE_LAMPS", ""}}, {{"STANDARD_DIPOLE", ""}}, {{"EXPONENTIAL_DISK", ""}}};
    }
    if (file == "path_trace.comp") {
        return path_trace_variants();
    }
    if (file == "volume_march.frag") {
        return march_variants();
    }
    if (file == "light_sweep.comp" || file == "light_combine.comp" || file == "light_rays.comp") {
        return light_variants(file);
    }
    if (file == "light_medium.comp") {
        return {{}, {{"ALBEDO", ""}}};
    }
    if (file == "cloud_noise.comp") {
        return {{{"TEXEL_FORMAT", "rgba8"}}, {{"TEXEL_FORMAT", "rgba32f"}}, {{"TEXEL_FORMAT", "r16"}, {"PACKED", ""}}};
    }
    if (file == "cloud_columns.comp" || file == "cloud_sun.comp") {
        return {{}, {{"OVERLAY", ""}, {"FOLLOWS_TOP", ""}, {"LINEAR_COVERAGE", ""}, {"PACKED", ""}}};
    }
    if (file == "cloud_march.frag") {
        return cloud_variants();
    }
    return {{}};
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
