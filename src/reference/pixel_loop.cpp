#include "reference/pixel_loop.h"

#include <fmt/core.h>
#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <mutex>

#include "base/error.h"

namespace bruma::reference {

void for_each_pixel(const scene::Scene& scene, int width, int height, const std::function<void(double)>& progress,
                    const std::function<void(const Pixel&)>& shade) {
    if (width < 1 || height < 1) {
        throw InputError(fmt::format("reference: a picture of {} x {} pixels holds nothing; both must be at least 1",
                                     width, height));
    }
    const scene::Camera& camera = **scene.camera;
    std::mutex progress_mutex;
    std::size_t done = 0;
    tbb::parallel_for(tbb::blocked_range2d<int>(0, height, 16, 0, width, 16), [&](const auto& tile) {
        for (int y = tile.rows().begin(); y != tile.rows().end(); ++y) {
            const glm::dvec3 background = glm::mix(scene.background->top, scene.background->bottom, (y + 0.5) / height);
            for (int x = tile.cols().begin(); x != tile.cols().end(); ++x) {
                shade({x, y, std::size_t(y) * width + x, scene::camera_ray(camera, x + 0.5, y + 0.5, width, height),
                       background});
            }
        }
        if (progress) {
            const std::lock_guard lock(progress_mutex);
            done += std::size_t(tile.rows().size()) * tile.cols().size();
            progress(double(done) / (double(width) * height));
        }
    });
}

}  // namespace bruma::reference
