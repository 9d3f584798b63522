#pragma once
#include <string>

#include "render/compose/picture_coverage.h"
#include "scene/scene.h"

namespace bruma::app {

/// Looks at pictures one after the other, and has a sentence when none of them shows anything of its scene's nodes.
class NothingSeen {
  public:
    explicit NothingSeen(gl::ShaderLibrary& shaders) : coverage_(shaders) {}

    /// Nothing is looked at any more once a picture showed something.
    void look_at(const scene::Scene& scene, const render::Picture& picture);
    /// Of the first picture; empty while something was seen, or nothing is missed.
    const std::string& sentence() const { return sentence_; }
    /// Writes the sentence, if there is one, to the log.
    void say() const;

  private:
    render::PictureCoverage coverage_;
    bool seen_ = false;
    std::string sentence_;
};

}  // namespace bruma::app
