#include "app/panels/clouds/clouds_panel.h"

#include <imgui/imgui.h>

#include <string>

#include "app/panels/fields_panel.h"
#include "render/clouds/cloud_shadows.h"

namespace bruma::app {
namespace {

/// A tree node with all fields of a part.
template <class Part>
void show_part(PanelContext& context, const char* title, Tracked<Part>& part, bool open) {
    const bool shown = ImGui::TreeNodeEx(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    context.places.note_last(std::string("clouds-") + title);
    if (shown) {
        edit_tracked(
            part, [](const Field&) { return true; },
            [&](const Field& field) { context.places.note_last("field-" + std::string(field.name)); });
        ImGui::TreePop();
    }
}

void show_presets(PanelContext& context, scene::Clouds& clouds) {
    const auto names = scene::enum_words<scene::CloudType>();
    if (ImGui::BeginCombo("preset", "choose")) {
        for (std::size_t n = 0; n < names.size(); ++n) {
            if (ImGui::Selectable(std::string(names[n]).c_str())) {
                const scene::Clouds preset = scene::preset_clouds(scene::CloudType(n));
                clouds.layer.set(*preset.layer);
                clouds.optics.set(*preset.optics);
                clouds.weather.set(*preset.weather);
            }
        }
        ImGui::EndCombo();
    }
    context.places.note_last("clouds-preset");
    tooltip("layer, weather and light of a genus of clouds");
}

}  // namespace

void show_clouds(PanelContext& context, scene::Clouds& clouds) {
    if (const std::string sentence = render::shadows_left_out(scene::shown_clouds(context.scene)); !sentence.empty()) {
        ImGui::TextWrapped("%s", sentence.c_str());
    }
    show_presets(context, clouds);
    show_part(context, "Layer", clouds.layer, true);
    show_part(context, "Weather", clouds.weather, false);
    show_part(context, "Lighting", clouds.optics, false);
    show_part(context, "Techniques", clouds.march, false);
}

void show_animation(PanelContext& context) {
    const bool playing = context.facts.playing;
    if (ImGui::Button(playing ? "Pause" : "Play")) {
        context.requests.play = !playing;
    }
    context.places.note_last("button-play");
    ImGui::SameLine();
    if (ImGui::Button("To the start")) {
        context.scene.time.edit([](scene::Timeline& timeline) { timeline.now_s = timeline.start_s; });
    }
    context.places.note_last("button-start");
    scene::Timeline timeline = *context.scene.time;
    double now = timeline.now_s;
    if (ImGui::SliderScalar("time", ImGuiDataType_Double, &now, &timeline.start_s, &timeline.end_s, "%.1f s")) {
        timeline.now_s = now;
        context.scene.time.set(timeline);
    }
    context.places.note_last("field-time");
    edit_tracked(context.scene.time, [](const Field& field) { return field.name != "now"; });
}

}  // namespace bruma::app
