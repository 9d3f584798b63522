#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <type_traits>

#include "app/verbs/verbs.h"
#include "base/console.h"
#include "scene/scene.h"

namespace bruma::app {
namespace {

/// A visitor of the table of parameters that prints each line of it.
struct Printer {
    std::string prefix;

    template <class Value>
    void operator()(const scene::Field& field, const Value&) const {
        std::string range;
        if constexpr (std::is_enum_v<Value>) {
            for (const std::string_view word : scene::enum_words<Value>()) {
                range += fmt::format("{}{}", range.empty() ? "" : "|", word);
            }
        } else if (std::isfinite(field.min) || std::isfinite(field.max)) {
            range = std::isfinite(field.max) ? fmt::format("{:g} to {:g}", field.min, field.max)
                                             : fmt::format("{:g} or more", field.min);
        }
        if (!field.unit.empty()) {
            range += fmt::format("{}{}", range.empty() ? "" : " ", field.unit);
        }
        answer("  {:42} {}{}\n", prefix + std::string(field.name), field.sentence,
               range.empty() ? "" : " [" + range + "]");
    }
};

template <class Part>
void print_part(const char* title, const std::string& prefix) {
    answer("{}\n", title);
    const Part part;
    scene::visit_fields(part, Printer{prefix});
}

}  // namespace

Verb declare_describe_parameters(CLI::App&) {
    return [] {
        answer(
            "Every parameter of a scene, by the path that --set and scene files use.\n"
            "In place of nodes.NAME, 'volume' addresses every volume, 'mesh' every mesh, 'clouds' every layer of "
            "clouds (clouds.preset=stratus sets all of it); in place of lights.NAME, "
            "'light'.\n\n");
        print_part<scene::Camera>("Camera", "camera.");
        print_part<scene::RenderSettings>("Rendering", "rendering.");
        print_part<scene::Display>("Display", "display.");
        print_part<scene::Background>("Background", "background.");
        print_part<scene::Sky>("Sky", "sky.");
        print_part<scene::Sun>("Sun", "sun.");
        print_part<scene::Atmosphere>("Air", "atmosphere.");
        print_part<scene::Environment>("Environment", "environment.");
        print_part<scene::Timeline>("Time", "time.");
        print_part<scene::Light>("Lights", "lights.NAME.");
        print_part<scene::Transform>("Nodes", "nodes.NAME.transform.");
        print_part<scene::VolumeOptics>("Volumes", "nodes.NAME.");
        print_part<scene::LightVolumeSettings>("", "nodes.NAME.light_volume.");
        print_part<scene::ClipBox>("", "nodes.NAME.clip.");
        print_part<scene::TransferFunction>("", "nodes.NAME.transfer_function.");
        print_part<scene::VolumeSource>("", "nodes.NAME.source.");
        print_part<scene::MeshSurface>("Meshes", "nodes.NAME.");
        print_part<scene::SubsurfaceSettings>("", "nodes.NAME.subsurface.");
        print_part<scene::MeshSource>("", "nodes.NAME.source.");
        print_part<scene::CloudLayer>("Clouds", "nodes.NAME.");
        print_part<scene::CloudOptics>("", "nodes.NAME.optics.");
        print_part<scene::CloudWeatherSource>("", "nodes.NAME.weather.");
        print_part<scene::CloudMarch>("", "nodes.NAME.march.");
        return 0;
    };
}

}  // namespace bruma::app
