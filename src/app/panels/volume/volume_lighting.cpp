#include "app/panels/volume/volume_lighting.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

namespace bruma::app {
namespace {

using scene::LightKind;
using scene::SweepMode;
using scene::VolumeLighting;

template <std::size_t N>
bool any_of(const std::array<std::string_view, N>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whether light is computed ahead, from each light through a grid.
bool has_light_grid(VolumeLighting lighting) {
    return lighting == VolumeLighting::light_volume || lighting == VolumeLighting::shadow_rays;
}

/// Phase functions are shares of 4 pi: this irradiance makes the light that a white medium scatters once as bright
/// as 1.
constexpr double sun_irradiance = 4.0 * std::numbers::pi;

}  // namespace

bool is_about_surfaces(std::string_view field) {
    return any_of(std::array<std::string_view, 8>{"highlight", "ambient", "diffuse", "specular", "shininess",
                                                  "two_sided", "gradient_soft_from", "gradient_soft_to"},
                  field);
}

bool optics_field_matters(const scene::VolumeOptics& optics, std::string_view field) {
    const VolumeLighting lighting = optics.lighting;
    const bool swept = has_light_grid(lighting);
    if (field == "albedo" || field == "g") {
        return scene::scatters(lighting);
    }
    if (field == "surfaces") {
        return swept;
    }
    if (field == "ambient") {
        return lighting == VolumeLighting::gradient;
    }
    return !is_about_surfaces(field) || lighting == VolumeLighting::gradient || (swept && optics.surfaces);
}

bool light_volume_field_matters(const scene::Volume& volume, std::string_view field) {
    if (volume.optics->lighting == VolumeLighting::shadow_rays) {
        return any_of(std::array<std::string_view, 3>{"resolution", "precision", "near_steps"}, field);
    }
    if (volume.optics->lighting != VolumeLighting::light_volume) {
        return false;
    }
    const bool paper = volume.light_volume->mode == SweepMode::paper;
    if (field == "cone_angle" || field == "soft_shadows") {
        return paper;
    }
    if (field == "spread") {
        return !paper && volume.light_volume->diffuse;
    }
    return field != "diffuse" || !paper;
}

std::string light_left_out(const scene::Scene& scene, const scene::Volume& volume) {
    const VolumeLighting lighting = volume.optics->lighting;
    const scene::LightVolumeSettings& settings = *volume.light_volume;
    std::vector<std::string_view> parts;
    if (lighting == VolumeLighting::none) {
        return "No light falls on it: its colours shine as they are.";
    }
    if (lighting == VolumeLighting::path_traced) {
        return "Nothing is left out; grain fades while the picture stands still.";
    }
    if (lighting == VolumeLighting::gradient) {
        parts.emplace_back("all shadows and all scattering");
    } else if (lighting == VolumeLighting::shadow_rays || (settings.mode == SweepMode::physical && !settings.diffuse)) {
        parts.emplace_back("light scattered more than once (in bright media that is more than half of it)");
    } else {
        parts.emplace_back("light that turns back or sideways when scattered again");
    }
    if (scene::scatters(lighting) && scene::shown_volumes(scene).size() > 1) {
        parts.emplace_back("shadows of other volumes");
    }
    if (scene.environment->radiance != glm::dvec3(0.0)) {
        parts.emplace_back("light of the environment");
    }
    std::string sentence = "Left out: ";
    for (std::size_t n = 0; n < parts.size(); ++n) {
        sentence += n == 0 ? "" : n + 1 == parts.size() ? " and " : ", ";
        sentence += parts[n];
    }
    const bool paper = lighting == VolumeLighting::light_volume && settings.mode == SweepMode::paper;
    return sentence + (paper ? ". Energy is not kept: a look, no measurement." : ".");
}

bool lacks_sun(const scene::Scene& scene, const scene::Volume& volume) {
    return has_light_grid(volume.optics->lighting) &&
           std::none_of(scene.lights.begin(), scene.lights.end(), [](const auto& entry) {
               return scene::shines(*entry.second) && entry.second->kind != LightKind::headlight;
           });
}

std::string free_light_name(const scene::Scene& scene, std::string_view word) {
    for (int n = 1;; ++n) {
        std::string name = fmt::format("{}_{}", word, n);
        if (!scene.lights.contains(name)) {
            return name;
        }
    }
}

std::string add_sun(scene::Scene& scene) {
    for (auto& [name, light] : scene.lights) {
        light.edit([](scene::Light& edited) { edited.on = edited.on && edited.kind != LightKind::headlight; });
    }
    const scene::CameraFrame view = scene::camera_frame(scene.camera ? **scene.camera : scene::Camera{});
    std::string name = scene.lights.contains("sun") ? free_light_name(scene, "sun") : "sun";
    scene.lights[name] = scene::Light{
        .direction_world = glm::normalize(-0.75 * view.right_world + 0.7 * view.up_world + 0.35 * view.back_world),
        .intensity = sun_irradiance};
    return name;
}

scene::Light with_same_effect(const scene::Scene& scene, const scene::Light& before, scene::Light after) {
    if (scene::has_position(before) == scene::has_position(after)) {
        return after;
    }
    const scene::Bounds bounds = scene::world_bounds(scene);
    const glm::dvec3 middle = 0.5 * (bounds.low + bounds.high);
    if (scene::has_position(after)) {
        const glm::dvec3 toward = before.kind == LightKind::headlight && scene.camera
                                      ? scene::camera_frame(**scene.camera).back_world
                                      : glm::normalize(before.direction_world);
        const double distance = glm::length(bounds.high - bounds.low);
        after.direction_world = toward;
        after.position_world = middle + distance * toward;
        after.intensity = before.intensity * distance * distance;
        return after;
    }
    const glm::dvec3 way = before.position_world - middle;
    const double distance = glm::length(way);
    if (distance > 0.0) {
        after.direction_world = way / distance;
        after.intensity = before.intensity / (distance * distance);
    }
    return after;
}

}  // namespace bruma::app
