#pragma once
#include <functional>

#include "scene/scene.h"

namespace bruma::reference {

struct Pixel {
    int x = 0, y = 0;
    std::size_t index = 0;       ///< y * width + x
    scene::Ray ray;              ///< through its centre
    glm::dvec3 background{0.0};  ///< what is seen where nothing is
};

/// Calls `shade` for each pixel of the picture that the scene's camera sees, in tiles on all cores. `progress`, if set,
/// gets the share done, one call at a time. Throws InputError for a picture without pixels.
void for_each_pixel(const scene::Scene& scene, int width, int height, const std::function<void(double)>& progress,
                    const std::function<void(const Pixel&)>& shade);

}  // namespace bruma::reference
