#pragma once
#include <vector>

#include "gl/texture.h"

namespace bruma::render {

/// The sky behind everything and the surfaces before it, behind their air; alpha is their coverage. Bottom row first.
/// As many layers as surfaces have; in those behind the first only pixels count that have a share there.
struct SkyPicture {
    struct Layer {
        gl::Texture color;
        gl::Framebuffer framebuffer;
    };
    std::vector<Layer> layers;
};

}  // namespace bruma::render
