#include "app/panels/statistics_panel.h"

#include <fmt/core.h>
#include <imgui/imgui.h>

#include <algorithm>

#include "app/panels/fields_panel.h"
#include "app/panels/theme.h"
#include "base/log.h"

namespace bruma::app {
namespace {

void show_passes(const render::RunReport& passes) {
    if (!ImGui::BeginTable("passes", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
        return;
    }
    ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthStretch, 0.42F);
    ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthStretch, 0.14F);
    ImGui::TableSetupColumn("why", ImGuiTableColumnFlags_WidthStretch, 0.44F);
    ImGui::TableHeadersRow();
    for (const render::PassReport& pass : passes) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextColored(pass.ran ? theme::accent : theme::faint, "%s", pass.name.c_str());
        tooltip(pass.sentence + (pass.note.empty() ? "" : "\n" + pass.note));
        ImGui::TableNextColumn();
        if (pass.ran) {
            ImGui::Text("%.1f", pass.gpu_ms >= 0.0 ? pass.gpu_ms : pass.cpu_ms);
        }
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", pass.reason.c_str());
        tooltip(pass.reason);
    }
    ImGui::EndTable();
}

}  // namespace

std::string quality_words(const ViewerFacts& facts) {
    if (facts.paths && facts.view.pixels == facts.area) {
        std::string words = fmt::format("{} of {} paths", facts.paths->samples, facts.path_samples);
        if (facts.paths->standard_error) {
            words += fmt::format(", error {:.2g}", *facts.paths->standard_error);
        }
        return words;
    }
    if (facts.refined) {
        return "refined";
    }
    const double scale = double(facts.view.pixels.x) / std::max(1, facts.area.x);
    std::string words = fmt::format("moving, {:.0f} % of the pixels along each edge", 100.0 * scale);
    if (facts.view.step_scale > 1.0) {
        words += fmt::format(", step x {:.1f}", facts.view.step_scale);
    }
    return words;
}

void show_statistics(PanelContext& context) {
    const ViewerFacts& facts = context.facts;
    ImGui::Text("%.1f ms", facts.last_ms);
    ImGui::SameLine();
    ImGui::TextDisabled("%d x %d, %s", facts.view.pixels.x, facts.view.pixels.y, quality_words(facts).c_str());
    ImGui::TextDisabled("%.1f ms while moving; %d pictures, %d frames of the window", facts.moving_ms, facts.renders,
                        facts.frames);
    show_passes(facts.passes);
    if (ImGui::Button("Count samples")) {
        context.requests.count_samples = true;
    }
    tooltip("draws the picture once more and counts what the march looks up");
    if (facts.samples) {
        ImGui::SameLine();
        ImGui::Text("%.1f per pixel", facts.samples->samples_per_pixel);
        ImGui::TextDisabled("%.2f M samples, %.2f M emptiness queries", 1e-6 * double(facts.samples->samples),
                            1e-6 * double(facts.samples->emptiness_queries));
    }
    ImGui::TextDisabled("%s", facts.driver.renderer.c_str());
    tooltip(facts.driver.vendor + ", " + facts.driver.version);
}

void show_messages() {
    const std::vector<LogLine> lines = logged_lines();
    ImGui::BeginChild("messages", {0.0F, 7.5F * ImGui::GetTextLineHeightWithSpacing()}, false);
    ImGui::PushTextWrapPos(0.0F);
    for (const LogLine& line : lines) {
        const ImVec4 color = line.level == LogLevel::error     ? theme::error
                             : line.level == LogLevel::warning ? theme::warning
                                                               : theme::faint;
        ImGui::PushStyleColor(ImGuiCol_Text, color);
        ImGui::TextUnformatted(line.text.c_str());
        ImGui::PopStyleColor();
    }
    ImGui::PopTextWrapPos();
    if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY() - 1.0F) {
        ImGui::SetScrollHereY(1.0F);
    }
    ImGui::EndChild();
}

}  // namespace bruma::app
