#pragma once
#include <string>

#include "measure/bench/bench_machine.h"
#include "measure/bench/light/bench_light.h"
#include "render/renderer.h"

/// Private to the bench of light.
namespace bruma::measure {

/// What one frame spent on light and on the march.
struct LightTimes {
    double build_ms = 0.0;  ///< of the light's passes; their medium is not counted
    double draw_ms = 0.0;
    int dispatches = 0;
};

/// A scene with one volume that is lit by one light, drawn again and again with other settings.
class LightStand {
  public:
    LightStand(gl::ShaderLibrary& shaders, scene::Scene scene);

    void set(LightProvider provider, const scene::LightVolumeSettings& settings);
    /// Emission and absorption alone.
    void set_unlit();
    void multiply_density(double factor);

    /// Draws as it is, so that all is built and compiled.
    Image picture(glm::ivec2 pixels);
    /// What the last `picture` spent; shaders may have been compiled in it.
    const LightTimes& first_times() const { return first_times_; }
    /// Draws after a small change of the light, there and back in turn, so that it is built anew and nothing else is.
    LightTimes after_light_change(glm::ivec2 pixels);
    /// Draws the same once more; nothing but the march runs.
    double draw_ms(glm::ivec2 pixels);

    /// What is kept for this volume's light: cells of direct light, megabytes with the medium.
    std::int64_t cells() const;
    glm::ivec3 grid_cells(int coarsening) const;
    double megabytes() const;

  private:
    scene::Volume& volume();
    const scene::Volume& volume() const;
    LightTimes timed(glm::ivec2 pixels);

    render::Renderer renderer_;
    scene::Scene scene_;
    std::string volume_name_;
    scene::Light light_;
    LightProvider provider_ = LightProvider::direct;
    bool moved_ = false;
    LightTimes first_times_;
};

}  // namespace bruma::measure
