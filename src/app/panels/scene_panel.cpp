#include "app/panels/scene_panel.h"

#include <fmt/core.h>
#include <imgui/imgui.h>

#include <vector>

#include "app/panels/fields_panel.h"
#include "app/panels/theme.h"

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
    return "group";
}

std::vector<std::string> children_of(const scene::Scene& scene, const std::string& parent) {
    std::vector<std::string> names;
    for (const auto& [name, node] : scene.nodes) {
        if (node.parent == parent) {
            names.push_back(name);
        }
    }
    return names;
}

void show_branch(PanelContext& context, const std::string& parent, int depth) {
    for (const std::string& name : children_of(context.scene, parent)) {
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
        show_branch(context, name, depth + 1);
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

std::string free_name(const std::map<std::string, Tracked<scene::Light>>& lights) {
    for (int n = 1;; ++n) {
        std::string name = fmt::format("light_{}", n);
        if (!lights.contains(name)) {
            return name;
        }
    }
}

}  // namespace

void show_nodes(PanelContext& context) {
    if (context.scene.nodes.empty()) {
        ImGui::TextDisabled("Nothing here yet. Drop a file on the window,\nor open one with Ctrl+O.");
        return;
    }
    show_branch(context, "", 0);
}

void show_selected_node(PanelContext& context) {
    const auto found = context.scene.nodes.find(context.selected);
    if (found == context.scene.nodes.end()) {
        return;
    }
    scene::Node& node = found->second;
    ImGui::PushID(context.selected.c_str());
    if (auto* volume = std::get_if<scene::Volume>(&node.content)) {
        const bool lit = volume->optics->lighting != scene::VolumeLighting::none;
        edit_tracked(volume->optics, [&](const Field& field) {
            return lit || field.name == "lighting" || field.name == "density_scale";
        });
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
    }
    if (ImGui::TreeNode("Place")) {
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
        if (ImGui::TreeNode(name.c_str())) {
            edit_fields(copy, [](const Field& field) { return field.name != "on"; });
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
        context.scene.lights.emplace(free_name(context.scene.lights), scene::Light{});
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

void show_surroundings(PanelContext& context) {
    edit_tracked(context.scene.background);
    if (context.scene.camera && ImGui::TreeNode("Camera")) {
        edit_tracked(*context.scene.camera);
        if (ImGui::SmallButton("Show everything (F)")) {
            context.requests.fit = true;
        }
        ImGui::TreePop();
    }
}

}  // namespace bruma::app
