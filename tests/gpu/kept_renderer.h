#pragma once
#include "drawing.h"

namespace bruma::render {

/// A test whose pictures share a renderer, so that what they have in common is made once.
class KeptRenderer : public Drawing {
  protected:
    void SetUp() override {
        Drawing::SetUp();
        if (!IsSkipped()) {
            renderer = std::make_unique<Renderer>(shaders());
        }
    }
    void TearDown() override {
        renderer.reset();
        Drawing::TearDown();
    }

    std::unique_ptr<Renderer> renderer;
};

}  // namespace bruma::render
