#include "app/viewer/workbench.h"

#include <fmt/core.h>
#include <imgui/imgui.h>

#include <algorithm>
#include <cmath>

#include "app/panels/number_boxes.h"
#include "app/panels/side_panel.h"
#include "app/panels/statistics_panel.h"
#include "app/panels/theme.h"
#include "app/scene_arguments.h"
#include "base/error.h"
#include "base/log.h"
#include "io/picture/weather_file.h"

namespace bruma::app {

Workbench::Workbench(const ViewRequest& request, gl::ShaderLibrary& shaders, std::function<void()> wake)
    : request_(request), shaders_(shaders), wake_(std::move(wake)), view_(shaders, request.samples) {
    facts_.driver = context::driver_info();
    for (const std::filesystem::path& folder : preset_folders()) {
        const std::vector<io::Preset> found = io::list_presets(folder);
        facts_.presets.insert(facts_.presets.end(), found.begin(), found.end());
    }
    home_->kept = document_stamp(scene_);
    history_.restart(scene_, home_);
}

void Workbench::frame(glm::ivec2 pixels, double now) {
    play(now - now_);
    now_ = now;
    ++frames_;
    places_.clear();
    const ImGuiIO& io = ImGui::GetIO();
    area_ = pixels;
    const scene::Scene before = scene_;
    if (const std::string refused = take_decimal_commas(); !refused.empty()) {
        notice(refused);
    }
    show_panels();
    try {
        scene::check(scene_);
        io::load_missing_weather(scene_, &before);
    } catch (const InputError& fault) {
        // What no picture can be made of is not taken; the panel shows the old value again.
        scene_ = before;
        notice(fault.what());
    }
    show_over_picture();
    dialogs_.show(places_);
    ask_for_layout();
    obey_keys();
    move_camera();
    history_.observe(scene_, home_, ImGui::IsAnyMouseDown() || ImGui::IsAnyItemActive());

    if (view_.update(scene_, area_, now, ImGui::IsAnyMouseDown())) {
        facts_.samples.reset();
    }
    facts_.view = view_.view();
    facts_.area = area_;
    facts_.refined = view_.is_refined();
    facts_.paths = view_.path_standing();
    facts_.path_samples = view_.path_samples();
    facts_.last_ms = view_.last_ms();
    facts_.moving_ms = view_.moving_ms();
    facts_.frames = frames_;
    facts_.renders = view_.renders();
    facts_.passes = view_.report();
    facts_.can_undo = history_.can_undo();
    facts_.can_redo = history_.can_redo();
    facts_.playing = playing_;
    show_status();

    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, int(io.DisplaySize.x * io.DisplayFramebufferScale.x),
               int(io.DisplaySize.y * io.DisplayFramebufferScale.y));
    glClearColor(0.02F, 0.02F, 0.022F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    view_.draw(*scene_.display, area_);
}

void Workbench::show_panels() {
    PanelRequests requests;
    if (panels_shown_) {
        PanelContext context{scene_, selected_, places_, requests, facts_};
        const float width = show_side_panel(context, transfer_function_panel_);
        area_.x = std::max(0, area_.x - int(std::ceil(width * ImGui::GetIO().DisplayFramebufferScale.x)));
    }
    const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
    places_.note("picture", {0.0F, 0.0F}, {float(area_.x) / scale.x, float(area_.y) / scale.y});
    playing_ = requests.play.value_or(playing_);
    obey(requests);
}

void Workbench::play(double elapsed_s) {
    if (!playing_) {
        return;
    }
    scene_.time.edit([&](scene::Timeline& timeline) {
        const double length = timeline.end_s - timeline.start_s;
        timeline.now_s += elapsed_s * timeline.speed;
        if (timeline.now_s > timeline.end_s) {
            playing_ = timeline.loop && length > 0.0;
            timeline.now_s =
                playing_ ? timeline.start_s + std::fmod(timeline.now_s - timeline.start_s, length) : timeline.end_s;
        }
    });
}

std::string Workbench::words_under_cursor() const {
    const ImGuiIO& io = ImGui::GetIO();
    const bool has_volumes = !scene::shown_volumes(scene_).empty();
    if (io.WantCaptureMouse || area_.x < 1 || area_.y < 1 || !has_volumes || !view_.fault().empty() ||
        render::is_path_traced(scene_)) {  // its opacity is a share of a few paths
        return "";
    }
    const glm::dvec2 pixel(io.MousePos.x * io.DisplayFramebufferScale.x, io.MousePos.y * io.DisplayFramebufferScale.y);
    const double opacity = view_.opacity_at(pixel / glm::dvec2(area_)).value_or(0.0);
    if (!(opacity > 0.0)) {
        return "";
    }
    return optical_depth_words(opacity, *scene_.rendering);
}

void Workbench::show_status() {
    const float em = ImGui::GetFontSize();
    const float height = float(area_.y) / ImGui::GetIO().DisplayFramebufferScale.y;
    const std::string status = scene_.nodes.empty() ? "Ctrl+O opens a file, or drop one here; H shows all keys"
                               : now_ < notice_until_
                                   ? notice_
                                   : fmt::format("{:.0f} ms, {}    H: keys", facts_.last_ms, quality_words(facts_));
    const auto write = [&](const std::string& words, float lines_up) {
        const ImVec2 at{0.9F * em, height - (1.8F + 1.3F * lines_up) * em};
        ImDrawList* canvas = ImGui::GetBackgroundDrawList();
        canvas->AddText({at.x + 1.0F, at.y + 1.0F}, IM_COL32(0, 0, 0, 200), words.c_str());
        canvas->AddText(at, IM_COL32(190, 196, 204, 230), words.c_str());
    };
    const std::string under_cursor = words_under_cursor();
    write(status, 0.0F);
    write(under_cursor, 1.0F);
    const std::string& nothing_seen = view_.why_nothing_is_seen();
    show_nothing_seen(nothing_seen);
    shown_status_ = status + "\n" + under_cursor + "\n" + nothing_seen;
}

void Workbench::show_nothing_seen(const std::string& why) const {
    if (why.empty()) {
        return;
    }
    const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
    const float em = ImGui::GetFontSize();
    const ImVec2 middle{0.5F * float(area_.x) / scale.x, 0.4F * float(area_.y) / scale.y};
    const float width = std::min(34.0F * em, 1.7F * middle.x);
    const ImVec2 size = ImGui::CalcTextSize(why.c_str(), nullptr, false, width);
    const ImVec2 low{middle.x - 0.5F * size.x, middle.y - 0.5F * size.y};
    ImDrawList* canvas = ImGui::GetBackgroundDrawList();
    canvas->AddRectFilled({low.x - em, low.y - 0.7F * em}, {low.x + size.x + em, low.y + size.y + 0.7F * em},
                          IM_COL32(16, 18, 22, 225), 5.0F);
    canvas->AddText(ImGui::GetFont(), em, low, IM_COL32(235, 205, 140, 255), why.c_str(), nullptr, width);
}

void Workbench::show_over_picture() {
    const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
    const ImVec2 size{float(area_.x) / scale.x, float(area_.y) / scale.y};
    const std::string& fault = shader_fault_.empty() ? view_.fault() : shader_fault_;
    if (!fault.empty()) {
        ImGui::SetNextWindowPos({0.0F, 0.0F});
        ImGui::SetNextWindowSize({size.x, 0.0F});
        ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0.30F, 0.07F, 0.07F, 0.93F));
        ImGui::Begin("fault", nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoFocusOnAppearing |
                         ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNav);
        ImGui::TextWrapped("%s", fault.c_str());
        places_.note_last("fault");
        ImGui::End();
        ImGui::PopStyleColor();
    }
    if (loader_.busy()) {
        const BackgroundLoader::Standing standing = loader_.standing();
        if (show_loading(standing.title, standing.what, standing.share, places_)) {
            loader_.cancel();
        }
    }
    show_help(help_shown_);
}

void Workbench::notice(const std::string& words) {
    notice_ = words;
    notice_until_ = now_ + 6.0;
    log_note("{}", words);
}

std::string Workbench::shown_fault() const {
    const std::string& banner = shader_fault_.empty() ? view_.fault() : shader_fault_;
    return banner.empty() ? dialogs_.words() : banner;
}

std::optional<double> Workbench::next_frame_at() const {
    if (playing_) {
        return now_;
    }
    std::optional<double> at = view_.refine_at();
    if (notice_until_ > now_) {
        at = std::min(at.value_or(notice_until_), notice_until_);
    }
    return at;
}

void Workbench::attempt(const std::string& title, const std::function<void()>& act) {
    try {
        act();
    } catch (const Error& fault) {
        log_error("{}", fault.what());
        dialogs_.tell(title, fault.what());
    }
}

}  // namespace bruma::app
