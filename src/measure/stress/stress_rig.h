#pragma once
#include <optional>
#include <string>
#include <vector>

#include "measure/stress/stress.h"
#include "render/renderer.h"

/// Private to the stress suites.
namespace bruma::measure {

constexpr glm::ivec2 stress_pixels{48, 32};

/// Draws small pictures and judges them.
class StressRig {
  public:
    explicit StressRig(const StressOptions& options);

    /// Which group the following cases belong to.
    void group(const std::string& name) { group_ = name; }
    /// The picture must be finite, with opacity in [0, 1], and hold the same bits without skipping. With a bound it
    /// must also be that near to the double-precision reference: largest difference of a channel or of the opacity, as
    /// a share of max(1, largest radiance of the reference).
    void picture(const std::string& name, const std::string& what, const scene::Scene& scene,
                 std::optional<double> bound = {});
    /// A number that must not exceed a bound; `measure` may throw, which is a failure.
    void number(const std::string& name, const std::string& what, double bound, const std::function<double()>& measure);
    /// A picture as it is judged, for `number`. Throws std::runtime_error if it is not finite.
    Image draw(const scene::Scene& scene, glm::ivec2 pixels = stress_pixels);

    gl::ShaderLibrary& shaders() { return shaders_; }
    const render::Renderer& renderer() const { return renderer_; }
    const std::vector<StressVerdict>& verdicts() const { return verdicts_; }

  private:
    bool is_wanted(const std::string& name) const;
    void fall(StressVerdict verdict);

    const StressOptions& options_;
    gl::ShaderLibrary shaders_;
    render::Renderer renderer_;
    std::string group_;
    std::vector<StressVerdict> verdicts_;
};

/// Largest difference over all four channels.
double largest_difference(const Image& a, const Image& b);

void stress_values(StressRig& rig);
void stress_curves(StressRig& rig);
void stress_cameras(StressRig& rig);
void stress_placement(StressRig& rig);
void stress_march(StressRig& rig);
void stress_lights(StressRig& rig);
void stress_random(StressRig& rig, int count);

void stress_light_optics(StressRig& rig);
void stress_light_lamps(StressRig& rig);
void stress_light_shapes(StressRig& rig);
void stress_light_motion(StressRig& rig);

}  // namespace bruma::measure
