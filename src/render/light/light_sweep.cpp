#include "render/light/light_sweep.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "gl/buffer.h"
#include "render/light/cone_kernel.h"

namespace bruma::render {
namespace {

/// Slices up to this many cells are swept by single work groups when no one says otherwise: there the launches and
/// barriers cost more than the arithmetic.
constexpr int small_slice = 64 * 64;
/// Launches cost a software renderer next to nothing, and one work group keeps but one core busy.
bool draws_in_software() {
    const auto* const renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const std::string_view name = renderer != nullptr ? renderer : "";
    return name.find("llvmpipe") != name.npos || name.find("softpipe") != name.npos;
}

/// Sweeps that need more scratch than this one after the other instead of side by side.
constexpr std::size_t most_scratch_bytes = std::size_t(256) << 20;

/// The parts of a vector that lie in the slices of an axis.
template <class T>
glm::vec<2, T> across(int axis, glm::vec<3, T> v) {
    using V = glm::vec<2, T>;
    return axis == 0 ? V(v.y, v.z) : axis == 1 ? V(v.x, v.z) : V(v.x, v.y);
}

glm::dvec3 edges_of(const SweepPlan& plan) {
    return {glm::length(plan.unit_from_cells[0]), glm::length(plan.unit_from_cells[1]),
            glm::length(plan.unit_from_cells[2])};
}

void set_plan(gl::Program& program, const SweepPlan& plan, const std::vector<SweepAxis>& axes) {
    program.set("cells", plan.grid.cells);
    program.set("light",
                glm::vec3(plan.from_point ? plan.light_cells : plan.light_cells / glm::length(plan.light_cells)));
    program.set("unit_from_cells", glm::mat3(plan.unit_from_cells));
    int begin = 0;
    for (std::size_t n = 0; n < axes.size(); ++n) {
        program.set_at("sweeps", int(n), "", glm::ivec4(axes[n].axis, axes[n].sign, axes[n].first, axes[n].slices));
        program.set_at("sweep_begin", int(n), "", begin);
        const glm::ivec2 size = across(axes[n].axis, plan.grid.cells);
        begin += size.x * size.y * axes[n].slices;
    }
}

std::size_t cells_of(const SweepPlan& plan, const SweepAxis& axis) {
    const glm::ivec2 size = across(axis.axis, plan.grid.cells);
    return std::size_t(size.x) * size.y * axis.slices;
}

/// One group of axes: sweeps them side by side; returns the number of dispatches.
int sweep_group(gl::Program& sweep, const SweepPlan& plan, const std::vector<SweepAxis>& axes,
                const SweepSettings& settings, bool whole, int per_dispatch) {
    set_plan(sweep, plan, axes);
    int slices = 0;
    glm::ivec2 largest(0);
    for (std::size_t n = 0; n < axes.size(); ++n) {
        const SweepAxis& axis = axes[n];
        slices = std::max(slices, axis.slices);
        largest = glm::max(largest, across(axis.axis, plan.grid.cells));
        if (settings.state == SweptState::diffuse) {
            sweep.set_at("spread_cells", int(n), "", glm::vec2(settings.spread / across(axis.axis, edges_of(plan))));
        }
        if (settings.state == SweptState::chromaticity) {
            const glm::dvec3 edge = edges_of(plan);
            const glm::dvec2 shift = plan.from_point
                                         ? glm::dvec2(0.0)
                                         : across(axis.axis, plan.light_cells / std::abs(plan.light_cells[axis.axis]));
            const auto weights = cone_kernel(settings.g, glm::radians(settings.cone_angle_deg),
                                             {across(axis.axis, edge), edge[axis.axis]}, shift);
            for (int k = 0; k < 9; ++k) {
                sweep.set_at("cone_weights", int(n) * 9 + k, "", float(weights[std::size_t(k)]));
            }
        }
    }
    sweep.set("soft", settings.soft_shadows ? 1 : 0);
    sweep.use();
    int dispatches = 0;
    for (int begin = 0; begin < slices; begin += per_dispatch) {
        sweep.set("slice_begin", begin);
        sweep.set("slice_end", std::min(slices, begin + per_dispatch));
        if (whole) {
            glDispatchCompute(1, 1, GLuint(axes.size()));
        } else {
            glDispatchCompute(GLuint(largest.x + 15) / 16, GLuint(largest.y + 7) / 8, GLuint(axes.size()));
        }
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        ++dispatches;
    }
    return dispatches;
}

}  // namespace

SweptLight sweep_light(gl::ShaderLibrary& shaders, const gl::Texture& extinction, const gl::Texture& albedo,
                       const SweepPlan& plan, const SweepSettings& settings, const EmptySpace& empty) {
    const bool single = settings.precision == scene::LightPrecision::single;
    const bool several = settings.state != SweptState::direct;
    gl::Defines defines;
    if (plan.from_point) {
        defines.emplace("FROM_POINT", "");
    }
    gl::Defines combine_defines = defines;
    combine_defines.emplace("CHANNELS", several ? "4" : "1");
    combine_defines.emplace("FORMAT", several ? (single ? "rgba32f" : "rgba16f") : (single ? "r32f" : "r16f"));
    if (settings.state == SweptState::diffuse) {
        defines.emplace("DIFFUSE", "");
        defines.emplace("BORDER_LIGHT", "vec3(0.0)");
        combine_defines.emplace("BORDER_LIGHT", "vec3(0.0)");
    } else if (settings.state == SweptState::chromaticity) {
        defines.emplace("PAPER", "");
        defines.emplace("BORDER_LIGHT", "vec3(1.0)");
        combine_defines.emplace("BORDER_LIGHT", "vec3(1.0)");
        combine_defines.emplace("ALSO_DIRECT", single ? "r32f" : "r16f");
    }

    int largest_slice = 0;
    int most_slices = 0;
    for (const SweepAxis& axis : plan.axes) {
        const glm::ivec2 size = across(axis.axis, plan.grid.cells);
        largest_slice = std::max(largest_slice, size.x * size.y);
        most_slices = std::max(most_slices, axis.slices);
    }
    int per_dispatch = settings.slices_per_dispatch;
    if (per_dispatch == 0) {
        per_dispatch = largest_slice <= small_slice && !draws_in_software() ? std::max(1, most_slices) : 1;
    }
    const bool whole = per_dispatch > 1;
    if (whole) {
        defines.emplace("WHOLE_SLICES", "");
    }
    if (empty.distance != nullptr) {
        defines.emplace("LEAP", "");
    }

    SweptLight result;
    const GLenum format = several ? (single ? GL_RGBA32F : GL_RGBA16F) : (single ? GL_R32F : GL_R16F);
    gl::Texture& combined = several ? result.beside : result.direct;
    combined = gl::Texture::make_3d(several ? "light beside direct" : "direct light", format, plan.grid.cells);
    if (settings.state == SweptState::chromaticity) {
        result.direct = gl::Texture::make_3d("direct light", single ? GL_R32F : GL_R16F, plan.grid.cells);
    }

    const std::size_t state_bytes = several ? 16 : 4;
    std::size_t first = 0;
    bool accumulate = false;
    while (first < plan.axes.size()) {
        // As many axes side by side as the scratch holds.
        std::vector<SweepAxis> group;
        std::size_t bytes = 0;
        while (first < plan.axes.size()) {
            const std::size_t more = cells_of(plan, plan.axes[first]) * state_bytes;
            if (!group.empty() && bytes + more > most_scratch_bytes) {
                break;
            }
            bytes += more;
            group.push_back(plan.axes[first++]);
        }
        const gl::Buffer swept("swept light", std::max<std::size_t>(bytes, 16));
        swept.bind_storage(0);

        gl::Program& sweep = shaders.get("light/light_sweep.comp", defines);
        extinction.bind(0);
        albedo.bind(1);
        sweep.set("extinction", 0);
        sweep.set("albedo", 1);
        if (empty.distance != nullptr) {
            empty.distance->bind(2);
            sweep.set("emptiness", 2);
            sweep.set("macrocells_per_cell", glm::vec3(empty.macrocells_per_cell));
            sweep.set("macrocell_of_origin", glm::vec3(empty.macrocell_of_origin));
        }
        result.dispatches += sweep_group(sweep, plan, group, settings, whole, per_dispatch);

        gl::Program& combine = shaders.get("light/light_combine.comp", combine_defines);
        set_plan(combine, plan, group);
        combine.set("sweep_count", int(group.size()));
        combine.set("normals", glm::mat3(plan.normals));
        combine.set("world_from_cells", glm::mat3(glm::dmat3(plan.grid.world_from_cells) / plan.grid.length));
        combine.set("accumulate", accumulate ? 1 : 0);
        for (std::size_t n = 0; n < group.size(); ++n) {
            combine.set_at("weights", int(n), "", float(group[n].weight));
        }
        combine.use();
        glBindImageTexture(0, combined.name(), 0, GL_TRUE, 0, GL_READ_WRITE, format);
        if (result.direct && several) {
            glBindImageTexture(1, result.direct.name(), 0, GL_TRUE, 0, GL_READ_WRITE, result.direct.format());
        }
        const glm::ivec3 groups = (plan.grid.cells + 3) / 4;
        glDispatchCompute(GLuint(groups.x), GLuint(groups.y), GLuint(groups.z));
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                        GL_TEXTURE_UPDATE_BARRIER_BIT);
        accumulate = true;
        ++result.dispatches;
    }
    return result;
}

}  // namespace bruma::render
