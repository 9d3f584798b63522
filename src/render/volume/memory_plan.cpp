#include "render/volume/memory_plan.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/error.h"
#include "scene/volume/thinned_grid.h"

namespace bruma::render {
namespace {

std::uint64_t bytes_per_texel(GLenum format) {
    switch (format) {
        case GL_R8:
            return 1;
        case GL_R16:
            return 2;
        case GL_RGBA16F:
        case GL_RGBA16_SNORM:
            return 8;
        default:  // GL_R32F, GL_RGB10_A2
            return 4;
    }
}

/// Whole MiB, rounded up: what is needed is never said to be 0.
std::uint64_t mebibytes(std::uint64_t bytes) {
    return (bytes >> 20) + ((bytes & 0xFFFFFU) != 0 ? 1 : 0);
}

class Planner {
  public:
    Planner(const std::vector<VolumeNeeds>& volumes, const TextureBudget& budget) : volumes_(volumes), budget_(budget) {
        plan_.thinning.assign(volumes.size(), glm::ivec3(1));
    }

    MemoryPlan plan() {
        for (std::size_t n = 0; n < volumes_.size(); ++n) {
            fit_by_itself(n);
        }
        thin_until_all_fit();
        refuse_light_without_room();
        keep_gradients_if_they_fit();
        say_what_is_thinned();
        return plan_;
    }

  private:
    glm::ivec3 size(std::size_t n) const { return scene::thinned_size(volumes_[n].samples, plan_.thinning[n]); }
    std::uint64_t voxel_bytes(std::size_t n) const { return texture_bytes(volumes_[n].voxel_format, size(n)); }
    bool takes(GLenum format, glm::ivec3 size) const {
        return std::max({size.x, size.y, size.z}) <= budget_.longest_edge &&
               (!budget_.takes || budget_.takes(format, size));
    }
    static bool can_thin(glm::ivec3 size) { return std::max({size.x, size.y, size.z}) > 1; }

    std::uint64_t all_voxels() const {
        std::uint64_t bytes = 0;
        for (std::size_t n = 0; n < volumes_.size(); ++n) {
            bytes += voxel_bytes(n);
        }
        return bytes;
    }

    void fit_by_itself(std::size_t n) {
        for (int axis = 0; axis < 3; ++axis) {
            const int edge = volumes_[n].samples[axis];
            plan_.thinning[n][axis] = std::max(1, (edge - 1) / budget_.longest_edge + 1);
        }
        while (!takes(volumes_[n].voxel_format, size(n)) && can_thin(size(n))) {
            plan_.thinning[n] *= 2;
        }
    }

    void thin_until_all_fit() {
        while (all_voxels() > budget_.bytes) {
            std::size_t largest = 0;
            for (std::size_t n = 1; n < volumes_.size(); ++n) {
                largest = voxel_bytes(n) > voxel_bytes(largest) ? n : largest;
            }
            if (!can_thin(size(largest))) {
                break;
            }
            plan_.thinning[largest] *= 2;
        }
    }

    void refuse_light_without_room() {
        plan_.bytes = all_voxels();
        for (const VolumeNeeds& needs : volumes_) {
            if (needs.light_bytes > budget_.bytes - std::min(budget_.bytes, plan_.bytes)) {
                throw MachineError(fmt::format(
                    "nodes.{}: its light volumes need about {} MiB beside {} MiB of samples, but {} MiB are free for "
                    "textures; choose light_volume.resolution=quarter, fewer lights or optics.lighting=gradient",
                    needs.name, mebibytes(needs.light_bytes), mebibytes(plan_.bytes), budget_.bytes >> 20));
            }
            plan_.bytes += needs.light_bytes;
        }
    }

    void keep_gradients_if_they_fit() {
        const std::uint64_t left = budget_.bytes - std::min(budget_.bytes, plan_.bytes);
        std::uint64_t bytes = 0;
        std::string without, why;
        for (std::size_t n = 0; n < volumes_.size(); ++n) {
            const GLenum format = volumes_[n].gradient_format;
            if (format == 0) {
                continue;
            }
            bytes += texture_bytes(format, size(n));
            const bool is_taken = takes(format, size(n));
            if ((!is_taken || bytes > left) && plan_.gradients_stored) {
                plan_.gradients_stored = false;
                without = volumes_[n].name;
                why = is_taken ? fmt::format("of which {} MiB are free", left >> 20)
                               : "which this driver does not take in one texture";
            }
        }
        if (plan_.gradients_stored) {
            plan_.bytes += bytes;
            return;
        }
        plan_.remarks.push_back(fmt::format(
            "nodes.{}: stored gradients would need about {} MiB, {}, so they are worked out from the samples "
            "at each look, which is slower",
            without, mebibytes(bytes), why));
    }

    void say_what_is_thinned() {
        for (std::size_t n = 0; n < volumes_.size(); ++n) {
            const glm::ivec3 whole = volumes_[n].samples;
            const glm::ivec3 kept = size(n);
            if (kept == whole) {
                continue;
            }
            const std::string why =
                std::max({whole.x, whole.y, whole.z}) > budget_.longest_edge
                    ? fmt::format("with an edge longer than the {} that this driver takes", budget_.longest_edge)
                : takes(volumes_[n].voxel_format, whole)
                    ? fmt::format("of which {} MiB are free for textures", budget_.bytes >> 20)
                    : "which this driver does not take in one texture";
            plan_.remarks.push_back(
                fmt::format("nodes.{}: its {} x {} x {} samples need about {} MiB, {}, so {} x {} x {} means of "
                            "neighbours are shown; cut the volume to see all of a part",
                            volumes_[n].name, whole.x, whole.y, whole.z,
                            mebibytes(texture_bytes(volumes_[n].voxel_format, whole)), why, kept.x, kept.y, kept.z));
        }
    }

    const std::vector<VolumeNeeds>& volumes_;
    const TextureBudget& budget_;
    MemoryPlan plan_;
};

}  // namespace

std::uint64_t texture_bytes(GLenum format, glm::ivec3 size) {
    return bytes_per_texel(format) * std::uint64_t(size.x) * std::uint64_t(size.y) * std::uint64_t(size.z);
}

MemoryPlan plan_memory(const std::vector<VolumeNeeds>& volumes, const TextureBudget& budget) {
    return Planner(volumes, budget).plan();
}

}  // namespace bruma::render
