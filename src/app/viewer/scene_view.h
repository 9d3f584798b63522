#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/viewer/quality.h"
#include "app/viewer/scene_stamp.h"
#include "io/picture/picture_file.h"
#include "render/compose/picture_coverage.h"
#include "render/compose/presenter.h"
#include "render/renderer.h"

namespace bruma::app {

/// The picture of the scene in the window: drawn coarsely while the scene changes, refined once it has been at rest for
/// `rest_s`, and not drawn again until something changes. A path traced picture gets more paths until it has
/// `path_samples` for each pixel.
class SceneView {
  public:
    static constexpr double rest_s = 0.15;

    SceneView(gl::ShaderLibrary& shaders, int path_samples)
        : shaders_(shaders), renderer_(shaders), presenter_(shaders), coverage_(shaders), path_samples_(path_samples) {}

    /// Brings the picture up to date for `area` pixels; `now` in seconds. While a hand is down, a refinement that would
    /// make it wait waits itself. Returns whether it rendered.
    bool update(const scene::Scene& scene, glm::ivec2 area, double now, bool hand_down);
    /// Draws the picture over the lower left `area` of the window.
    void draw(const scene::Display& display, glm::ivec2 area);

    /// When `update` should be called again although nothing happens.
    std::optional<double> refine_at() const;
    bool is_refined() const { return refined_; }
    const render::View& view() const { return view_; }
    /// The refined picture as the display has it.
    io::Picture8 refined_picture(const scene::Scene& scene, glm::ivec2 area);
    /// The picture as it stands, linear; without pixels before the first.
    Image linear_picture() const { return has_picture_ ? renderer_.read_picture() : Image(); }
    /// Opacity along the ray through a point of the picture, given as shares of its width and height from the upper
    /// left corner; nothing outside it.
    std::optional<double> opacity_at(glm::dvec2 share) const;
    int path_samples() const { return path_samples_; }
    /// Of a path traced picture; the error as it was when last looked at, within a quarter of the paths.
    const std::optional<render::PathStanding>& path_standing() const { return path_standing_; }
    render::SampleTotals count_samples(const scene::Scene& scene);

    /// The sentence of why the last rendering failed; empty when it did not. The picture before it stays.
    const std::string& fault() const { return fault_; }
    /// Why the refined picture shows nothing of the scene's nodes; empty when it shows something, or nothing is missed.
    const std::string& why_nothing_is_seen() const { return why_nothing_is_seen_; }
    const render::RunReport& report() const { return report_; }
    double last_ms() const { return last_ms_; }
    double moving_ms() const { return moving_ms_; }
    int renders() const { return renders_; }
    /// Names of the passes that ran since the last call, in the order of their first run.
    std::vector<std::string> take_passes_run() { return std::exchange(passes_run_, {}); }

  private:
    static constexpr double longest_hiccup_ms = 250.0;
    static constexpr double path_budget_ms = 50.0;  ///< between two frames of the window
    bool waits_for_hand() const;
    bool bring_up_to_date(const scene::Scene& scene, glm::ivec2 area, double now);
    bool render(const scene::Scene& scene, const render::View& view);
    bool refine(const scene::Scene& scene);
    void look_at_paths();
    /// Whether translucent meshes need no more passes.
    bool is_light_inside_settled() const;

    gl::ShaderLibrary& shaders_;
    render::Renderer renderer_;
    render::Presenter presenter_;
    render::PictureCoverage coverage_;
    std::string why_nothing_is_seen_;
    QualityController quality_;
    SceneStamp stamp_;
    Revision shader_revision_ = 0;
    glm::ivec2 area_{0};
    render::View view_;
    bool refined_ = false, has_picture_ = false, hand_down_ = false;
    double changed_at_ = 0.0;
    std::string fault_;
    render::RunReport report_;
    double last_ms_ = 0.0, moving_ms_ = 0.0;
    int renders_ = 0;
    std::vector<std::string> passes_run_;
    int path_samples_;
    std::optional<render::PathStanding> path_standing_;
    int error_seen_at_ = 0;  ///< paths
};

}  // namespace bruma::app
