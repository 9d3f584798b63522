#include "app/panels/scene_panel.h"

#include <fmt/core.h>
#include <imgui/imgui.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "app/panels/clouds/clouds_panel.h"
#include "app/panels/fields_panel.h"
#include "app/panels/mesh/mesh_inside.h"
#include "app/panels/theme.h"
#include "app/panels/volume/volume_lighting.h"
#include "base/error.h"

namespace bruma::app {
namespace {

std::string kind_words(const scene::Node& node) {
    if (const auto* volume = std::get_if<scene::Volume>(&node.content); volume && *volume->grid) {
        const scene::VolumeGrid& grid = **volume->grid;
        return fmt::format("{} x {} x {} {}", grid.size.x, grid.size.y, grid.size.z,
                           scene::enum_words<scene::VoxelType>()[std::size_t(grid.type)]);
    }
    if (const auto* mesh = std::get_if<scene::Mesh>(&node.content); mesh && *mesh->triangles) {
        return fmt::format("{} triangles", (*mesh->triangles)->triangles.size());
    }
    if (const auto* clouds = std::get_if<scene::Clouds>(&node.content)) {
        return fmt::format("clouds, {:g} to {:g} m", clouds->layer->bottom_m, clouds->layer->top_m);
    }
    return "group";
}

void show_row(PanelContext& context, const std::string& name, int depth) {
    scene::Node& node = context.scene.nodes.at(name);
    ImGui::PushID(name.c_str());
    ImGui::Checkbox("##visible", &node.visible);
    context.places.note_last("visible-" + name);
    tooltip("whether it and what hangs on it are shown");
    ImGui::SameLine(0.0F, 8.0F + 14.0F * float(depth));
    if (ImGui::Selectable(name.c_str(), context.selected == name, ImGuiSelectableFlags_AllowItemOverlap)) {
        context.selected = name;
    }
    context.places.note_last("node-" + name);
    const std::string words = kind_words(node);
    ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(words.c_str()).x);
    ImGui::TextDisabled("%s", words.c_str());
    ImGui::PopID();
}

/// All nodes below their parents. Without recursion: chains of parents may be of any length.
void show_tree(PanelContext& context) {
    constexpr int deepest_indent = 8;
    std::map<std::string, std::vector<std::string>> children;
    for (const auto& [name, node] : context.scene.nodes) {
        children[node.parent].push_back(name);
    }
    std::vector<std::pair<std::string, int>> waiting;
    const auto wait_for_children_of = [&](const std::string& parent, int depth) {
        if (const auto found = children.find(parent); found != children.end()) {
            for (auto child = found->second.rbegin(); child != found->second.rend(); ++child) {
                waiting.emplace_back(*child, depth);
            }
        }
    };
    wait_for_children_of("", 0);
    while (!waiting.empty()) {
        const auto [name, depth] = std::move(waiting.back());
        waiting.pop_back();
        show_row(context, name, std::min(depth, deepest_indent));
        wait_for_children_of(name, depth + 1);
    }
}

/// Takes a node away; what hangs on it stays where it is, one level up.
void remove_node(scene::Scene& scene, const std::string& name) {
    const std::string parent = scene.nodes.at(name).parent;
    for (auto& [other, node] : scene.nodes) {
        if (node.parent == name) {
            node.parent = parent;
        }
    }
    scene.nodes.erase(name);
}

/// A button that lights a scattering volume by a sun, with the reason, where only headlights shine.
void suggest_sun(PanelContext& context, const scene::Volume& volume) {
    if (!lacks_sun(context.scene, volume)) {
        return;
    }
    ImGui::PushStyleColor(ImGuiCol_Text, theme::warning);
    ImGui::TextWrapped("A headlight casts no visible shadow, and its light is swept anew whenever the camera moves.");
    ImGui::PopStyleColor();
    const bool pressed = ImGui::Button("Add a sun");
    context.places.note_last("add-sun");
    tooltip("a light from afar, over your left shoulder; headlights go off; Ctrl+Z takes it back");
    if (pressed) {
        add_sun(context.scene);
    }
}

void show_volume_optics(PanelContext& context, scene::Volume& volume) {
    const auto note = [&](const Field& field) { context.places.note_last("field-" + std::string(field.name)); };
    edit_tracked(
        volume.optics, [](const Field& field) { return field.name == "lighting"; }, note);
    ImGui::PushStyleColor(ImGuiCol_Text, theme::faint);
    ImGui::TextWrapped("%s", light_left_out(context.scene, volume).c_str());
    ImGui::PopStyleColor();
    suggest_sun(context, volume);
    const scene::VolumeOptics& optics = *volume.optics;
    edit_tracked(
        volume.optics,
        [&](const Field& field) {
            return field.name != "lighting" && !is_about_surfaces(field.name) &&
                   optics_field_matters(optics, field.name);
        },
        note);
    const auto is_shown_surface_field = [&](const Field& field) {
        return is_about_surfaces(field.name) && optics_field_matters(optics, field.name);
    };
    if (optics_field_matters(optics, "specular") && ImGui::TreeNodeEx("Surfaces", ImGuiTreeNodeFlags_DefaultOpen)) {
        edit_tracked(volume.optics, is_shown_surface_field, note);
        ImGui::TreePop();
    }
    if (light_volume_field_matters(volume, "resolution") &&
        ImGui::TreeNodeEx("Grid of light", ImGuiTreeNodeFlags_DefaultOpen)) {
        edit_tracked(
            volume.light_volume, [&](const Field& field) { return light_volume_field_matters(volume, field.name); },
            note);
        ImGui::TreePop();
    }
}

/// Widgets for a light of its present kind; intensities have the unit of that kind.
void show_light(PanelContext& context, scene::Light& light) {
    const auto note = [&](const Field& field) { context.places.note_last("light-" + std::string(field.name)); };
    const scene::Light before = light;
    edit_fields(
        light, [](const Field& field) { return field.name == "kind"; }, note);
    light = with_same_effect(context.scene, before, light);
    if (light.kind == scene::LightKind::directional || light.kind == scene::LightKind::spot) {
        edit_direction(light.direction_world);
        context.places.note_last("light-elevation");
    }
    edit_fields(
        light,
        [](const Field& field) {
            return field.name != "kind" && field.name != "direction" && field.name != "intensity" && field.name != "on";
        },
        note);
    visit_fields(light, [&](Field field, auto& part) {
        if (field.name == "intensity") {
            const bool from_point = scene::has_position(light);
            field.unit = from_point ? "W/sr" : "W/m2";
            // Sources near small things are weak.
            field.panel_min = from_point ? 1e-4 : field.panel_min;
            edit_value(field, part);
            note(field);
        }
    });
}

bool is_of_place_or_time(const Field& field) {
    return field.sentence.starts_with("place:") || field.sentence.starts_with("time:");
}

/// Not on the 31st of February.
bool is_sound(const scene::Sun& sun) {
    try {
        scene::check(sun, "");
    } catch (const InputError&) {
        return false;
    }
    return true;
}

}  // namespace

void show_nodes(PanelContext& context) {
    if (context.scene.nodes.empty()) {
        ImGui::TextDisabled("Nothing here yet. Drop a file on the window,\nor open one with Ctrl+O.");
        return;
    }
    show_tree(context);
}

void show_selected_node(PanelContext& context) {
    const auto found = context.scene.nodes.find(context.selected);
    if (found == context.scene.nodes.end()) {
        return;
    }
    scene::Node& node = found->second;
    ImGui::PushID(context.selected.c_str());
    if (auto* volume = std::get_if<scene::Volume>(&node.content)) {
        show_volume_optics(context, *volume);
        if (ImGui::TreeNode("Clip box")) {
            edit_tracked(volume->clip);
            if (ImGui::SmallButton("Show all of it")) {
                volume->clip.set({});
            }
            ImGui::TreePop();
        }
    }
    if (auto* mesh = std::get_if<scene::Mesh>(&node.content)) {
        edit_tracked(mesh->surface);
        if (mesh->surface->shading == scene::MeshShading::translucent && *mesh->triangles) {
            ImGui::PushStyleColor(ImGuiCol_Text, theme::faint);
            ImGui::TextWrapped("%s", light_inside_words(context.scene, context.selected, *mesh).c_str());
            ImGui::PopStyleColor();
            if (ImGui::TreeNodeEx("Light inside", ImGuiTreeNodeFlags_DefaultOpen)) {
                edit_tracked(mesh->subsurface);
                ImGui::TreePop();
            }
        }
    }
    if (auto* clouds = std::get_if<scene::Clouds>(&node.content)) {
        show_clouds(context, *clouds);
    }
    if (!std::holds_alternative<scene::Clouds>(node.content) && ImGui::TreeNode("Place")) {
        edit_tracked(node.transform);
        if (ImGui::SmallButton("Back to the origin")) {
            node.transform.set({});
        }
        ImGui::TreePop();
    }
    ImGui::PopID();
    const bool remove = ImGui::Button("Remove from the scene");
    context.places.note_last("remove-node");
    tooltip("Ctrl+Z brings it back");
    if (remove) {
        remove_node(context.scene, context.selected);
        context.selected.clear();
    }
}

void show_lights(PanelContext& context) {
    std::string removed;
    for (auto& [name, light] : context.scene.lights) {
        ImGui::PushID(name.c_str());
        scene::Light copy = *light;
        ImGui::Checkbox("##on", &copy.on);
        tooltip("whether it shines");
        ImGui::SameLine();
        const bool is_open = ImGui::TreeNode(name.c_str());
        context.places.note_last("light-" + name);
        if (is_open) {
            show_light(context, copy);
            if (ImGui::SmallButton("Remove this light")) {
                removed = name;
            }
            ImGui::TreePop();
        }
        light.set(copy);
        ImGui::PopID();
    }
    if (!removed.empty()) {
        context.scene.lights.erase(removed);
    }
    if (ImGui::Button("Add a light")) {
        context.scene.lights.emplace(free_light_name(context.scene, "light"), scene::Light{});
    }
    bool any_lit = false;
    for (const auto& [name, node] : context.scene.nodes) {
        const auto* volume = std::get_if<scene::Volume>(&node.content);
        any_lit = any_lit || std::holds_alternative<scene::Mesh>(node.content) ||
                  (volume != nullptr && volume->optics->lighting != scene::VolumeLighting::none);
    }
    if (!any_lit && !context.scene.nodes.empty()) {
        ImGui::TextColored(theme::faint, "No node is lit: choose its lighting first.");
    }
}

void show_sky(PanelContext& context) {
    std::optional<scene::Outdoors>& outdoors = context.scene.outdoors;
    bool wanted = outdoors.has_value();
    ImGui::Checkbox("sun, sky and ground", &wanted);
    context.places.note_last("sky-on");
    tooltip("the ground is y = 0; the sun and the sky light meshes and volumes");
    if (wanted != outdoors.has_value()) {
        outdoors = wanted ? std::make_optional<scene::Outdoors>() : std::nullopt;
    }
    if (!outdoors) {
        return;
    }
    const auto note = [&](const Field& field) { context.places.note_last("sky-" + std::string(field.name)); };
    const auto all = [](const Field&) { return true; };
    const bool by_place = outdoors->sun->placement == scene::SunPlacement::place_and_time;
    edit_tracked(outdoors->sky, all, note);
    ImGui::Separator();
    scene::Sun sun = *outdoors->sun;
    edit_fields(
        sun, [by_place](const Field& field) { return by_place || !is_of_place_or_time(field); }, note);
    if (is_sound(sun)) {
        outdoors->sun.set(sun);
    }
    if (by_place) {
        const auto at = scene::sun_angles(sun.latitude_deg, sun.longitude_deg, sun.date, sun.hour_utc);
        ImGui::TextDisabled("elevation %.2f deg, azimuth %.2f deg", at.elevation_deg, at.azimuth_deg);
    }
    if (ImGui::TreeNode("Air and ground")) {
        edit_tracked(outdoors->atmosphere, all, note);
        if (ImGui::SmallButton("As on Earth")) {
            outdoors->atmosphere.set({});
        }
        ImGui::TreePop();
    }
}

void show_display(PanelContext& context) {
    edit_tracked(context.scene.display);
    const bool pressed = ImGui::Button("Expose");
    context.places.note_last("button-expose");
    tooltip("E: the exposure that suits this picture. Media that scatter light to all sides send little of it here.");
    context.requests.expose |= pressed;
}

void show_surroundings(PanelContext& context) {
    edit_tracked(context.scene.background);
    edit_tracked(context.scene.environment);
    if (context.scene.camera && ImGui::TreeNode("Camera")) {
        edit_tracked(*context.scene.camera);
        if (ImGui::SmallButton("Show everything (F)")) {
            context.requests.fit = true;
        }
        ImGui::TreePop();
    }
}

}  // namespace bruma::app
