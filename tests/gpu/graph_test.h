#pragma once
#include <algorithm>

#include "base/installation.h"
#include "drawing.h"

namespace bruma::render {

using Names = std::vector<std::string>;

/// Draws the scene; names of the passes that ran, sorted.
inline Names reruns(Renderer& renderer, const scene::Scene& scene, const View& view) {
    Names names;
    for (const PassReport& report : renderer.render(scene, view)) {
        if (report.ran) {
            names.push_back(report.name);
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

/// A test of what the frame graph runs and what it compiles: one renderer with programs of its own.
class GraphTest : public Drawing {
  protected:
    void SetUp() override {
        Drawing::SetUp();
        if (!IsSkipped()) {
            own_shaders = std::make_unique<gl::ShaderLibrary>(installed_folder("shaders"));
            renderer = std::make_unique<Renderer>(*own_shaders);
        }
    }
    void TearDown() override {
        renderer.reset();
        own_shaders.reset();
        Drawing::TearDown();
    }
    Names reruns() { return bruma::render::reruns(*renderer, scene, view); }
    /// Why a pass ran or did not, in the last picture.
    std::string reason(const std::string& pass) const {
        for (const PassReport& report : renderer->graph().last_report()) {
            if (report.name == pass) {
                return report.reason;
            }
        }
        return "not in the report";
    }
    /// Whether any program was compiled whose file or switches hold this.
    bool compiled(const std::string& part) const {
        const Names names = own_shaders->compiled_names();
        return std::any_of(names.begin(), names.end(),
                           [&](const std::string& name) { return name.find(part) != std::string::npos; });
    }

    std::unique_ptr<gl::ShaderLibrary> own_shaders;
    std::unique_ptr<Renderer> renderer;
    scene::Scene scene;
    View view{{16, 12}, 1.0};
};

}  // namespace bruma::render
