#include "render/volume_needs.h"

#include <algorithm>
#include <limits>

#include "base/log.h"
#include "gl/memory.h"
#include "render/light/light_sweep_plan.h"
#include "render/march/march_pass.h"
#include "render/paths/path_trace_pass.h"
#include "scene/volume/thinned_grid.h"

namespace bruma::render {
namespace {

const scene::Volume& volume_in(const scene::Scene& scene, const std::string& name) {
    return std::get<scene::Volume>(scene.nodes.at(name).content);
}

std::uint64_t cell_count(const LightGrid& grid) {
    return std::uint64_t(grid.cells.x) * std::uint64_t(grid.cells.y) * std::uint64_t(grid.cells.z);
}

/// Of the textures that render/light/light_passes makes, and of the sweep's working memory.
std::uint64_t light_bytes(const scene::Volume& volume, const glm::dmat4& world_from_texture, std::uint64_t lamps) {
    constexpr std::uint64_t most_scratch = 256 << 20;
    constexpr std::uint64_t extinction = 4, albedo = 8;  // bytes of a cell
    const scene::LightVolumeSettings& settings = *volume.light_volume;
    const bool rays = volume.optics->lighting == scene::VolumeLighting::shadow_rays;
    const bool paper = !rays && settings.mode == scene::SweepMode::paper;
    const bool diffuse = !rays && !paper && settings.diffuse;
    const int coarsening = 1 << int(settings.resolution);
    const std::uint64_t fine = cell_count(light_grid(volume, world_from_texture, coarsening));
    const std::uint64_t coarse = diffuse ? cell_count(light_grid(volume, world_from_texture, 2 * coarsening)) : 0;
    const std::uint64_t number = settings.precision == scene::LightPrecision::single ? 4 : 2;
    // The grids of several lamps are copied into one texture.
    const std::uint64_t copies = lamps > 1 ? 2 * lamps : lamps;
    const std::uint64_t medium = rays ? 0 : fine * (extinction + (paper ? albedo : 0)) + coarse * (extinction + albedo);
    const std::uint64_t light = fine * (number + (paper ? 4 * number : 0)) + coarse * 4 * number;
    const std::uint64_t scratch = rays ? 0 : std::min(most_scratch, 16 * fine);
    return medium + copies * light + scratch;
}

}  // namespace

std::vector<VolumeNeeds> volume_needs(const scene::Scene& scene, const std::vector<std::string>& shown,
                                      GLenum byte_format) {
    const auto lamps = std::uint64_t(std::count_if(scene.lights.begin(), scene.lights.end(),
                                                   [](const auto& light) { return scene::shines(*light.second); }));
    const bool paths = is_path_traced(scene);
    std::vector<VolumeNeeds> needs;
    for (const std::string& name : shown) {
        const scene::Volume& volume = volume_in(scene, name);
        const scene::VolumeGrid& grid = **volume.grid;
        VolumeNeeds of{name, grid.size, voxel_format(grid, byte_format)};
        if (!paths && MarchPass::reflects(*volume.optics)) {
            of.gradient_format = gradient_format(grid, gradient_storage(volume));
        }
        if (!paths && scene::scatters(volume.optics->lighting)) {
            of.light_bytes = light_bytes(volume, scene::world_from_texture(scene, name), lamps);
        }
        needs.push_back(std::move(of));
    }
    return needs;
}

void VolumeFitting::set_budget(std::uint64_t bytes) {
    budget_ = bytes;
    needs_.clear();
}

const scene::Scene& VolumeFitting::fit(const scene::Scene& scene) {
    const std::vector<std::string> shown = scene::shown_volumes(scene);
    if (!byte_format_ && !shown.empty()) {
        byte_format_ = filters_8bit_texels_precisely() ? GL_R8 : GL_R16;
    }
    std::vector<VolumeNeeds> needs = volume_needs(scene, shown, byte_format_.value_or(GL_R8));
    if (needs != needs_) {
        const gl::TextureRoom room = gl::texture_room();
        // What this renderer holds already is there to be used again. A tenth stays for the rest of a picture.
        std::uint64_t free = room.free_bytes;
        if (free != std::numeric_limits<std::uint64_t>::max()) {
            free = free - free / 10 + plan_.bytes;
        }
        plan_ = plan_memory(needs, {budget_.value_or(free), room.longest_edge, gl::takes_3d});
        needs_ = std::move(needs);
        for (const std::string& remark : plan_.remarks) {
            if (said_.insert(remark).second) {
                log_note("{}", remark);
            }
        }
    }
    fitted_.reset();
    std::erase_if(thinned_,
                  [&](const auto& entry) { return std::find(shown.begin(), shown.end(), entry.first) == shown.end(); });
    for (std::size_t n = 0; n < shown.size(); ++n) {
        const scene::Volume& volume = volume_in(scene, shown[n]);
        if (plan_.thinning[n] == glm::ivec3(1)) {
            thinned_.erase(shown[n]);
            continue;
        }
        Thinned& thin = thinned_[shown[n]];
        if (thin.whole != volume.grid.revision() || thin.factors != plan_.thinning[n]) {
            thin.whole = volume.grid.revision();
            thin.factors = plan_.thinning[n];
            thin.grid = scene::thinned(**volume.grid, thin.factors);
        }
        if (!fitted_) {
            fitted_ = scene;
        }
        std::get<scene::Volume>(fitted_->nodes.at(shown[n]).content).grid = thin.grid;
    }
    return fitted_ ? *fitted_ : scene;
}

}  // namespace bruma::render
