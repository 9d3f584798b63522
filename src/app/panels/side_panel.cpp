#include "app/panels/side_panel.h"

#include <fmt/core.h>
#include <imgui/imgui.h>

#include <algorithm>
#include <filesystem>

#include "app/panels/clouds/clouds_panel.h"
#include "app/panels/fields_panel.h"
#include "app/panels/scene_panel.h"
#include "app/panels/statistics_panel.h"
#include "app/panels/theme.h"

namespace bruma::app {
namespace {

bool section(PanelContext& context, const char* title, bool open) {
    const bool shown = ImGui::CollapsingHeader(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    context.places.note_last(std::string("section-") + title);
    return shown;
}

void show_buttons(PanelContext& context) {
    PanelRequests& requests = context.requests;
    const auto button = [&](const char* label, const char* place, const char* words) {
        const bool pressed = ImGui::Button(label);
        context.places.note_last(place);
        tooltip(words);
        ImGui::SameLine(0.0F, 5.0F);
        return pressed;
    };
    requests.open_file |= button("Open", "button-open", "Ctrl+O; or drop files on the window");
    requests.save_scene |= button("Save", "button-save", "Ctrl+S: the scene as a .json file");
    requests.screenshot |= button("Picture", "button-picture", "P: the refined picture as a .png file");
    requests.fit |= button("Fit", "button-fit", "F: show everything");
    ImGui::BeginDisabled(!context.facts.can_undo);
    requests.undo |= button("Undo", "button-undo", "Ctrl+Z");
    ImGui::EndDisabled();
    requests.help |= button("?", "button-help", "H: keys and gestures");
    ImGui::NewLine();
}

void show_sections(PanelContext& context, TransferFunctionPanel& transfer_function) {
    if (section(context, "Scene", true)) {
        show_nodes(context);
    }
    if (section(context, "Transfer function", true)) {
        transfer_function.show(context);
    }
    if (context.scene.nodes.contains(context.selected) && section(context, "Selected node", false)) {
        show_selected_node(context);
    }
    if (!scene::shown_clouds(context.scene).empty() && section(context, "Animation", true)) {
        show_animation(context);
    }
    if (section(context, "Lights", false)) {
        show_lights(context);
    }
    if (section(context, "Sky", false)) {
        show_sky(context);
    }
    if (section(context, "Display", false)) {
        show_display(context);
    }
    if (section(context, "Background and camera", false)) {
        show_surroundings(context);
    }
    if (section(context, "Rendering", false)) {
        edit_tracked(
            context.scene.rendering, [](const Field&) { return true; },
            [&](const Field& field) { context.places.note_last("rendering-" + std::string(field.name)); });
    }
    if (section(context, "Statistics", false)) {
        show_statistics(context);
    }
    if (section(context, "Messages", false)) {
        show_messages();
    }
}

}  // namespace

float show_side_panel(PanelContext& context, TransferFunctionPanel& transfer_function) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({screen.x, 0.0F}, ImGuiCond_Always, {1.0F, 0.0F});
    ImGui::SetNextWindowSize({25.5F * em, screen.y}, ImGuiCond_Once);
    ImGui::SetNextWindowSizeConstraints({18.0F * em, screen.y}, {std::max(18.0F * em, 0.7F * screen.x), screen.y});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0F);
    ImGui::Begin("panels", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
    ImGui::PopStyleVar();
    const float width = ImGui::GetWindowWidth();
    show_buttons(context);
    ImGui::BeginChild("sections");
    show_sections(context, transfer_function);
    ImGui::EndChild();
    ImGui::End();
    return width;
}

}  // namespace bruma::app
