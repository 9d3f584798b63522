#include <algorithm>

#include "render/march/march_pass.h"

// What the march looks up of each volume: textures and constants.
namespace bruma::render {
namespace {

void set_surface(gl::Program& program, int index, const scene::VolumeOptics& optics, bool reflecting) {
    program.set_at("surface_uniforms", index, ".ambient", float(optics.ambient));
    program.set_at("surface_uniforms", index, ".diffuse", float(optics.diffuse));
    program.set_at("surface_uniforms", index, ".specular", float(optics.specular));
    program.set_at("surface_uniforms", index, ".shininess", float(optics.shininess));
    program.set_at("surface_uniforms", index, ".blinn_phong",
                   optics.highlight == scene::Highlight::blinn_phong ? 1 : 0);
    program.set_at("surface_uniforms", index, ".two_sided", optics.two_sided ? 1 : 0);
    // Unlit among lit ones: no gradient is ever steep enough.
    program.set_at("surface_uniforms", index, ".soft_from", reflecting ? float(optics.gradient_soft_from) : 1e30F);
    const double width = optics.gradient_soft_to - optics.gradient_soft_from;
    program.set_at("surface_uniforms", index, ".soft_inverse_width", float(width > 1e-20 ? 1.0 / width : 1e20));
}

}  // namespace

bool MarchPass::reflects(const scene::VolumeOptics& optics) {
    return optics.lighting == scene::VolumeLighting::gradient || (scene::scatters(optics.lighting) && optics.surfaces);
}

void MarchPass::bind_volume(const PassAccess& access, gl::Program& program, const Parameters& parameters, int index,
                            GLuint& unit, const scene::Camera& camera) {
    const VolumeInput& input = parameters.volumes[std::size_t(index)];
    // An empty texture unbinds the unit: sampling it gives (0, 0, 0, 1). Every sampler gets a unit of its own even so,
    // since samplers of different kinds may not share one.
    const auto bind = [&](const char* sampler, const gl::Texture& texture) {
        texture.bind(unit);
        program.set_at(sampler, index, "", int(unit));
        ++unit;
    };
    const VolumeTexture& voxels = access.read(input.voxels);
    const TableTextures& tables = access.read(input.tables);
    bind("voxels", voxels.texture);
    const glm::dvec2 u_of_texel = u_from_voxel(voxels, input.window);
    if (parameters.settings.classification == scene::Classification::post) {
        bind("optics_table", tables.optics);
        program.set_at("volume_uniforms", index, ".optics_from_voxel",
                       glm::vec2(table_from_voxel(u_of_texel, depth_entries)));
        program.set_at("volume_uniforms", index, ".optics_visible",
                       glm::vec2(table_coordinate(tables.tables.lowest_visible, depth_entries),
                                 table_coordinate(tables.tables.highest_visible, depth_entries)));
    } else {
        bind("depth_table", tables.depth);
        program.set_at("volume_uniforms", index, ".u_visible",
                       glm::vec2(tables.tables.lowest_visible, tables.tables.highest_visible));
        bind("source_table", tables.source);
    }
    if (parameters.lit) {
        bind("glow_table", tables.glow);
    }
    program.set_at("volume_uniforms", index, ".u_from_voxel", glm::vec2(u_of_texel));
    program.set_at("volume_uniforms", index, ".tau_scale", float(input.tau_per_sigma_metre * parameters.step_world));

    const glm::dmat4 texture_from_world = glm::inverse(input.world_from_texture);
    const glm::dmat3 linear(texture_from_world);
    const scene::CameraFrame frame = scene::camera_frame(camera);
    const double h = parameters.step_world;
    glm::dmat4 texture_from_camera(1.0);
    texture_from_camera[0] = glm::dvec4(linear * (frame.right_world * h), 0.0);
    texture_from_camera[1] = glm::dvec4(linear * (frame.up_world * h), 0.0);
    texture_from_camera[2] = glm::dvec4(linear * (frame.back_world * h), 0.0);
    texture_from_camera[3] = texture_from_world * glm::dvec4(camera.eye_world, 1.0);
    program.set_at("texture_from_camera", index, "", glm::mat4(texture_from_camera));
    program.set_at("clip_low", index, "", glm::vec3(input.clip.low));
    program.set_at("clip_high", index, "", glm::vec3(input.clip.high));

    if (parameters.settings.empty_space_skipping) {
        const EmptinessTexture& emptiness = access.read(input.emptiness);
        bind("emptiness", emptiness.distance);
        program.set_at("volume_uniforms", index, ".cells_from_texture",
                       glm::vec3(emptiness.voxels) / float(emptiness.edge));
        program.set_at("volume_uniforms", index, ".last_cell", glm::vec3(emptiness.distance.size() - 1));
    }
    if (parameters.lit) {
        set_surface(program, index, input.optics, reflects(input.optics));
        bind_light(access, program, parameters, index, unit);
    }
    if (reflects(input.optics)) {
        double difference_per_texel = voxels.value_of_one - voxels.value_of_zero;
        double texel_of_zero = 0.0;
        if (parameters.gradients_stored) {
            const GradientTexture& gradients = access.read(input.gradients);
            bind("gradients", gradients.texture);
            difference_per_texel = gradients.difference_per_texel;
            texel_of_zero = gradients.texel_of_zero;
        } else {
            bind("gradients", gl::Texture());
            program.set_at("volume_uniforms", index, ".samples", glm::vec3(voxels.texture.size()));
        }
        const glm::dvec3 size(voxels.texture.size());
        double smallest_edge = 1e300;
        for (int k = 0; k < 3; ++k) {
            smallest_edge = std::min(smallest_edge, glm::length(glm::dvec3(input.world_from_texture[k])) / size[k]);
        }
        // Per voxel -> per texture unit -> per metre (inverse transpose) -> ranges of shading per smallest voxel edge.
        const double range = input.shading_range > 0.0 ? input.shading_range : 1.0;
        glm::dmat3 scale(1.0);
        for (int k = 0; k < 3; ++k) {
            scale[k][k] = size[k];
        }
        const glm::dmat3 world_from_gradient =
            glm::transpose(linear) * scale * (difference_per_texel * smallest_edge / range);
        program.set_at("volume_uniforms", index, ".world_from_gradient", glm::mat3(world_from_gradient));
        program.set_at("volume_uniforms", index, ".gradient_zero", glm::vec3(float(texel_of_zero)));
    } else if (parameters.lit) {
        bind("gradients", gl::Texture());
    }
}

void MarchPass::bind_light(const PassAccess& access, gl::Program& program, const Parameters& parameters, int index,
                           GLuint& unit) const {
    const VolumeInput& input = parameters.volumes[std::size_t(index)];
    const bool scatters = scene::scatters(input.optics.lighting);
    const bool paper = input.optics.lighting == scene::VolumeLighting::light_volume &&
                       input.light_volume.mode == scene::SweepMode::paper;
    program.set_at("volume_uniforms", index, ".scatter_kind", !scatters ? 0 : paper ? 2 : 1);
    program.set_at("volume_uniforms", index, ".asymmetry", float(input.optics.g));
    const glm::dvec3 extent = input.clip.high - input.clip.low;
    program.set_at("volume_uniforms", index, ".grid_from_texture_scale", glm::vec3(1.0 / extent));
    program.set_at("volume_uniforms", index, ".grid_from_texture_shift", glm::vec3(-input.clip.low / extent));
    program.set_at("volume_uniforms", index, ".light_cells", glm::vec3(glm::dvec3(input.light_grid.cells) / extent));
    const glm::dmat3 texture_from_world(glm::inverse(input.world_from_texture));
    program.set_at("volume_uniforms", index, ".texture_from_world",
                   glm::mat3(texture_from_world * parameters.step_world));
    const auto bind = [&](const char* sampler, Handle<LightTextures> light, gl::Texture LightTextures::*which) {
        const gl::Texture none;
        const gl::Texture& texture = light.index >= 0 ? access.read(light).*which : none;
        texture.bind(unit);
        program.set_at(sampler, index, "", int(unit));
        ++unit;
        const double deep = texture ? double(texture.size().z) / double(parameters.lights.size()) : 1.0;
        return float(0.5 / deep);
    };
    const float direct_half = bind("direct_light", input.light, &LightTextures::direct);
    const float beside_half = bind("diffuse_light", input.beside, &LightTextures::beside);
    program.set_at("volume_uniforms", index, ".half_cell", glm::vec2(direct_half, beside_half));
}

}  // namespace bruma::render
