#pragma once
#include <cstdint>

#include "gl/texture.h"
#include "render/products/surface_layers.h"

namespace bruma::render {

/// What the meshes show.
struct OpaquePicture {
    SurfaceLayers layers;
    SampledSurfaces sampled;
    gl::Texture thickness;  ///< R32F, mm: of a body that is seen through, while it is drawn
    gl::Framebuffer thickness_framebuffer;
    gl::Texture open;  ///< R32UI: 1 where maps left samples of a body open, while it is drawn
    /// Pixels of translucent surfaces that no map sees well; their light is worked out one by one.
    std::uint32_t unseen = 0;
};

}  // namespace bruma::render
