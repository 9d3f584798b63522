#include "app/viewer/scene_view.h"

#include <algorithm>
#include <chrono>

#include "base/error.h"
#include "base/log.h"
#include "scene/unseen.h"

namespace bruma::app {
namespace {

/// Whether what a pass costs follows the pixels and the steps.
bool is_march(const std::string& pass) {
    return pass == "march" || pass == "path trace" || pass.ends_with(": cloud_march");
}

bool takes_clouds_from_last(const scene::Scene& scene) {
    const std::vector<std::string> shown = scene::shown_clouds(scene);
    return !shown.empty() && std::all_of(shown.begin(), shown.end(), [&](const std::string& name) {
        return std::get<scene::Clouds>(scene.nodes.at(name).content).march->reprojection !=
               scene::CloudReprojection::never;
    });
}

}  // namespace

bool SceneView::update(const scene::Scene& scene, glm::ivec2 area, double now, bool hand_down) {
    hand_down_ = hand_down;
    if (!scene.camera || area.x < 1 || area.y < 1) {
        why_nothing_is_seen_.clear();
        return false;
    }
    const bool rendered = bring_up_to_date(scene, area, now);
    if (rendered && refined_) {
        why_nothing_is_seen_ =
            coverage_.covers_any(renderer_.picture()) ? "" : scene::why_nothing_is_seen(scene, view_.pixels);
    }
    return rendered;
}

bool SceneView::bring_up_to_date(const scene::Scene& scene, glm::ivec2 area, double now) {
    SceneStamp stamp = picture_stamp(scene);
    if (stamp != stamp_ || shaders_.revision() != shader_revision_ || area != area_) {
        const bool turned = same_but_for_view(stamp, stamp_) && shaders_.revision() == shader_revision_ &&
                            area == area_ && takes_clouds_from_last(scene);
        stamp_ = std::move(stamp);
        shader_revision_ = shaders_.revision();
        area_ = area;
        changed_at_ = now;
        render::View view = quality_.moving(area, turned);
        refined_ = view == QualityController::refined(area) && !render::is_path_traced(scene);
        view.paths.samples = 1;
        if (!render(scene, view)) {
            return false;
        }
        refined_ = refined_ && is_light_inside_settled() && renderer_.missing_cloud_turns() == 0;
        moving_ms_ = last_ms_;
        return true;
    }
    if (!refined_ && now - changed_at_ >= rest_s && !waits_for_hand()) {
        return refine(scene);
    }
    return false;
}

bool SceneView::refine(const scene::Scene& scene) {
    render::View view = QualityController::refined(area_);
    view.paths.samples = path_samples_;
    view.paths.budget_ms = path_budget_ms;
    refined_ = true;
    const bool rendered = render(scene, view);
    const bool all_paths = !path_standing_ || path_standing_->samples >= path_samples_;
    const bool all_turns = renderer_.missing_cloud_turns() == 0;
    refined_ = (all_paths && all_turns && is_light_inside_settled()) || !rendered;
    return rendered;
}

bool SceneView::is_light_inside_settled() const {
    const std::optional<render::TranslucentStanding> inside = renderer_.translucent_standing();
    return !inside || inside->settled || inside->passes >= path_samples_;
}

void SceneView::look_at_paths() {
    const std::optional<int> samples = renderer_.path_samples();
    if (!samples) {
        path_standing_.reset();
        return;
    }
    // The error is read back from the GPU, so not at every turn.
    if (!path_standing_ || *samples < error_seen_at_ || *samples >= error_seen_at_ + error_seen_at_ / 4 + 1 ||
        *samples >= path_samples_) {
        path_standing_ = renderer_.path_standing();
        error_seen_at_ = *samples;
    }
    path_standing_->samples = *samples;
}

bool SceneView::render(const scene::Scene& scene, const render::View& view) {
    const auto start = std::chrono::steady_clock::now();
    try {
        render::RunReport report = renderer_.render(scene, view, true);
        if (std::none_of(report.begin(), report.end(), [](const render::PassReport& pass) { return pass.ran; })) {
            fault_.clear();
            return true;  // the picture was there already; what it cost is still told
        }
        report_ = std::move(report);
    } catch (const Error& error) {
        // Tried again when something changes, such as the shader at fault.
        if (fault_ != error.what()) {
            fault_ = error.what();
            log_error("{}", fault_);
        }
        refined_ = true;
        return false;
    }
    fault_.clear();
    last_ms_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    double march_ms = 0.0;
    for (const render::PassReport& pass : report_) {
        if (!pass.ran) {
            continue;
        }
        march_ms += is_march(pass.name) ? pass.gpu_ms : 0.0;
        if (std::find(passes_run_.begin(), passes_run_.end(), pass.name) == passes_run_.end()) {
            passes_run_.push_back(pass.name);
        }
    }
    look_at_paths();
    if (!path_standing_ || view.paths.samples == 1) {
        quality_.measured(view, march_ms, last_ms_ - march_ms, renderer_.clouds_from_last());
    }
    view_ = view;
    has_picture_ = true;
    ++renders_;
    return true;
}

void SceneView::draw(const scene::Display& display, glm::ivec2 area) {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (has_picture_ && area.x > 0 && area.y > 0) {
        glViewport(0, 0, area.x, area.y);
        presenter_.draw(renderer_.picture(), display, area);
    }
}

bool SceneView::waits_for_hand() const {
    return hand_down_ && quality_.refined_ms(area_) > longest_hiccup_ms;
}

std::optional<double> SceneView::refine_at() const {
    return refined_ || !has_picture_ || waits_for_hand() ? std::nullopt : std::optional(changed_at_ + rest_s);
}

io::Picture8 SceneView::refined_picture(const scene::Scene& scene, glm::ivec2 area) {
    render::View view = QualityController::refined(area);
    view.paths.samples = path_samples_;
    do {
        render(scene, view);
    } while (fault_.empty() && renderer_.missing_cloud_turns() > 0);
    if (!fault_.empty()) {
        throw InputError(fault_);
    }
    return {area.x, area.y, presenter_.read(renderer_.picture(), *scene.display)};
}

std::optional<double> SceneView::opacity_at(glm::dvec2 share) const {
    if (!has_picture_ || !(share.x >= 0.0 && share.x < 1.0 && share.y >= 0.0 && share.y < 1.0)) {
        return std::nullopt;
    }
    const gl::Texture& color = renderer_.picture().color;
    const glm::ivec2 size(color.size());
    const glm::ivec2 pixel(share * glm::dvec2(size));
    float rgba[4];
    glGetTextureSubImage(color.name(), 0, pixel.x, size.y - 1 - pixel.y, 0, 1, 1, 1, GL_RGBA, GL_FLOAT, sizeof rgba,
                         rgba);
    return double(rgba[3]);
}

render::SampleTotals SceneView::count_samples(const scene::Scene& scene) {
    return renderer_.count_samples(scene, view_);
}

}  // namespace bruma::app
