#include "app/panels/volume/transfer_function_panel.h"

#include "app/panels/fields_panel.h"
#include "app/panels/theme.h"
#include "scene/builtin/builtin.h"

namespace bruma::app {
namespace {

void choose_preset(PanelContext& context) {
    ImGui::SetNextItemWidth(9.5F * ImGui::GetFontSize());
    if (ImGui::BeginCombo("##preset", "preset ...", ImGuiComboFlags_HeightLarge)) {
        for (const io::Preset& preset : context.facts.presets) {
            if (ImGui::Selectable(preset.name.c_str())) {
                context.requests.transfer_function_file = preset.path.string();
            }
            context.places.note_last("preset-" + preset.name);
        }
        ImGui::EndCombo();
    }
    context.places.note_last("tf-presets");
}

void edit_window_numbers(scene::TransferFunction& tf, std::array<double, 2> window) {
    double level = 0.5 * (window[0] + window[1]);
    double width = window[1] - window[0];
    const double speed = std::max(1e-6, std::abs(width)) * 0.004;
    const float third = (ImGui::GetContentRegionAvail().x - 2.0F * ImGui::GetStyle().ItemSpacing.x) / 3.0F;
    ImGui::SetNextItemWidth(third);
    bool changed =
        ImGui::DragScalar("##window", ImGuiDataType_Double, &width, float(speed), nullptr, nullptr, "window %.5g");
    tooltip("width of the range of data values that the curves are stretched over");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(third);
    changed |= ImGui::DragScalar("##level", ImGuiDataType_Double, &level, float(speed), nullptr, nullptr, "level %.5g");
    tooltip("middle of that range");
    ImGui::SameLine();
    if (ImGui::Button("All data", {third, 0.0F})) {
        tf.window.reset();
    } else if (changed && width > 0.0) {
        tf.window = {level - 0.5 * width, level + 0.5 * width};
    }
}

}  // namespace

std::string edited_volume(const scene::Scene& scene, const std::string& selected) {
    std::string first;
    for (const auto& [name, node] : scene.nodes) {
        if (std::holds_alternative<scene::Volume>(node.content)) {
            if (name == selected) {
                return name;
            }
            first = first.empty() ? name : first;
        }
    }
    return first;
}

void TransferFunctionPanel::show(PanelContext& context) {
    const std::string name = edited_volume(context.scene, context.selected);
    if (name != node_) {
        node_ = name;
        editor_.forget();
    }
    if (name.empty()) {
        ImGui::TextDisabled("There is no volume yet.");
        return;
    }
    auto& volume = std::get<scene::Volume>(context.scene.nodes.at(name).content);
    scene::TransferFunction tf = *volume.transfer_function;
    ImGui::PushID(name.c_str());
    choose_preset(context);
    ImGui::SameLine();
    const bool suggest = ImGui::Button("Suggest");
    context.places.note_last("tf-suggest");
    tooltip("from the histogram of the data");
    ImGui::SameLine();
    context.requests.load_transfer_function |= ImGui::Button("Load");
    ImGui::SameLine();
    context.requests.save_transfer_function |= ImGui::Button("Save");
    context.places.note_last("tf-save");
    if (suggest) {
        tf = scene::suggested_transfer_function(**volume.grid);
    }
    const std::array<double, 2> window = scene::effective_window(volume);
    editor_.show(tf, window, *volume.grid, context.places);
    edit_window_numbers(tf, window);
    edit_fields(tf, [](const Field& field) { return field.name == "reference_length"; });
    volume.transfer_function.set(std::move(tf));
    edit_tracked(volume.optics, [](const Field& field) { return field.name == "density_scale"; });
    ImGui::PopID();
}

}  // namespace bruma::app
