#include "render/light/light_medium.h"

namespace bruma::render {

gl::Texture optics_texture(const TransferTables& tables) {
    gl::Texture texture = gl::Texture::make_1d("optics of the light's medium", GL_RGBA32F, depth_entries);
    texture.upload({GL_RGBA, GL_FLOAT}, tables.optics.data());
    return texture;
}

CellsInTexture cells_in_texture(const glm::dmat4& texture_from_cells) {
    return {glm::dvec3(texture_from_cells[3]),
            {texture_from_cells[0][0], texture_from_cells[1][1], texture_from_cells[2][2]}};
}

void make_light_medium(gl::ShaderLibrary& shaders, const VolumeTexture& voxels, const EmptinessTexture& emptiness,
                       const scene::TransferFunction& tf, const LightMediumParameters& p, LightMedium& medium) {
    const TransferTables tables =
        make_transfer_tables(tf, {.preintegrated = false, .lit = true, .scatters = true, .albedo = p.albedo});
    const gl::Texture optics = optics_texture(tables);
    medium.extinction = gl::Texture::make_3d("extinction for light", GL_R32F, p.grid.cells);
    medium.albedo = p.with_albedo ? gl::Texture::make_3d("albedo for light", GL_RGBA16F, p.grid.cells) : gl::Texture();
    gl::Defines defines;
    if (p.with_albedo) {
        defines["ALBEDO"] = "";
    }
    if (voxels.holes) {
        defines["HOLES"] = "";
    }
    gl::Program& program = shaders.get("light/light_medium.comp", defines);
    const auto [low, per_cell] = cells_in_texture(glm::inverse(p.cells_from_texture));
    voxels.texture.bind(0);
    optics.bind(1);
    emptiness.distance.bind(2);
    program.set("voxels", 0);
    program.set("optics_table", 1);
    program.set("emptiness", 2);
    program.set("optics_from_voxel", glm::vec2(table_from_voxel(u_from_voxel(voxels, p.window), depth_entries)));
    program.set("depth_per_sigma", float(p.depth_per_sigma));
    program.set("cells", p.grid.cells);
    program.set("texture_low", glm::vec3(low));
    program.set("texture_per_cell", glm::vec3(per_cell));
    program.set("macrocells_from_texture", glm::vec3(emptiness.voxels) / float(emptiness.edge));
    program.set("samples", p.samples);
    program.use();
    glBindImageTexture(0, medium.extinction.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_R32F);
    if (p.with_albedo) {
        glBindImageTexture(1, medium.albedo.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA16F);
    }
    glDispatchCompute(GLuint(p.grid.cells.x + 7) / 8, GLuint(p.grid.cells.y + 3) / 4, GLuint(p.grid.cells.z + 3) / 4);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

}  // namespace bruma::render
