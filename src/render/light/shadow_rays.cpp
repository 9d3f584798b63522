#include "render/light/shadow_rays.h"

namespace bruma::render {

gl::Texture trace_shadow_rays(gl::ShaderLibrary& shaders, const VolumeTexture& voxels,
                              const EmptinessTexture& emptiness, const scene::TransferFunction& tf,
                              const SweepPlan& plan, const ShadowRays& rays) {
    const TransferTables tables = make_transfer_tables(tf, {.preintegrated = false});
    const gl::Texture optics = optics_texture(tables);
    const bool single = rays.precision == scene::LightPrecision::single;
    gl::Texture direct = gl::Texture::make_3d("direct light", single ? GL_R32F : GL_R16F, plan.grid.cells);
    gl::Defines defines{{"VOLUMES", "1"},
                        {"SAMPLE_AT_MIDPOINTS", ""},
                        {"LEAP", ""},
                        {"STOP_EARLY", ""},
                        {"FORMAT", single ? "r32f" : "r16f"}};
    if (plan.from_point) {
        defines["FROM_POINT"] = "";
    }
    if (voxels.holes) {
        defines["HOLES"] = "";
    }
    gl::Program& program = shaders.get("light/light_rays.comp", defines);
    const glm::dmat4 texture_from_world = glm::inverse(rays.world_from_texture);
    const glm::dmat4 texture_from_cells = texture_from_world * plan.grid.world_from_cells;
    const glm::dvec3 to_light = plan.from_point ? glm::dvec3(texture_from_cells * glm::dvec4(plan.light_cells, 1.0))
                                                : glm::dmat3(texture_from_cells) * plan.light_cells * rays.step_world;
    voxels.texture.bind(0);
    program.set_at("voxels", 0, "", 0);
    optics.bind(1);
    program.set_at("optics_table", 0, "", 1);
    emptiness.distance.bind(2);
    program.set_at("emptiness", 0, "", 2);
    program.set_at("volume_uniforms", 0, ".optics_from_voxel",
                   glm::vec2(table_from_voxel(u_from_voxel(voxels, rays.window), depth_entries)));
    program.set_at("volume_uniforms", 0, ".optics_visible",
                   glm::vec2(table_coordinate(tables.lowest_visible, depth_entries),
                             table_coordinate(tables.highest_visible, depth_entries)));
    program.set_at("volume_uniforms", 0, ".tau_scale", float(rays.tau_per_step));
    program.set_at("volume_uniforms", 0, ".cells_from_texture", glm::vec3(emptiness.voxels) / float(emptiness.edge));
    program.set_at("volume_uniforms", 0, ".last_cell", glm::vec3(emptiness.distance.size() - 1));
    program.set("cells", plan.grid.cells);
    const auto [low, per_cell] = cells_in_texture(texture_from_cells);
    program.set("texture_low", glm::vec3(low));
    program.set("texture_per_cell", glm::vec3(per_cell));
    program.set("clip_low", glm::vec3(rays.clip.low));
    program.set("clip_high", glm::vec3(rays.clip.high));
    program.set("light", glm::vec3(to_light));
    program.set("steps_from_texture", glm::mat3(glm::dmat3(rays.world_from_texture) / rays.step_world));
    program.use();
    glBindImageTexture(0, direct.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, direct.format());
    const glm::ivec3 cells = plan.grid.cells;
    glDispatchCompute(GLuint(cells.x + 7) / 8, GLuint(cells.y + 3) / 4, GLuint(cells.z + 3) / 4);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    return direct;
}

}  // namespace bruma::render
