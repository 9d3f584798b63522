#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "reference/subsurface/subsurface_view.h"
#include "scene/scene.h"

namespace bruma::app {

struct BodyReferenceOptions {
    reference::SubsurfaceMethod method = reference::SubsurfaceMethod::quadrature;
    std::optional<double> tolerance;  ///< quadrature: of each pixel, relative
    std::uint64_t photons = 1'000'000;
    std::uint64_t seed = 1;
    std::function<void(double)> progress = {};
};

/// A picture with the error of each pixel and what to say about it.
struct DrawnReference {
    Image image;
    std::vector<float> error;
    std::string findings;
};

/// The light from within the scene's one translucent mesh over the background, by either truth; says what of the scene
/// is left out. Throws InputError for a scene that shows anything else.
DrawnReference draw_body_reference(const scene::Scene& scene, glm::ivec2 pixels, const BodyReferenceOptions& options);

}  // namespace bruma::app
