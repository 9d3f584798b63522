#include "render/march/march_pass.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "render/blue_noise.h"
#include "render/view_rays.h"

namespace bruma::render {
namespace {

void make_targets(Picture& picture, glm::ivec2 pixels) {
    if (!picture.color || glm::ivec2(picture.color.size()) != pixels) {
        picture.framebuffer = {};
        picture.color = gl::Texture::make_2d("picture", GL_RGBA32F, pixels);
        picture.framebuffer = gl::Framebuffer("picture", {&picture.color});
    }
}

void make_targets(SampleCounts& counts, glm::ivec2 pixels) {
    if (!counts.counts || glm::ivec2(counts.counts.size()) != pixels) {
        counts.framebuffer = {};
        counts.picture = gl::Texture::make_2d("picture while counting", GL_RGBA32F, pixels);
        counts.counts = gl::Texture::make_2d("sample counts", GL_RG32F, pixels);
        counts.framebuffer = gl::Framebuffer("sample counts", {&counts.picture, &counts.counts});
    }
}

}  // namespace

MarchPass::MarchPass(FrameGraph& graph, gl::ShaderLibrary& shaders) : graph_(graph), shaders_(shaders) {
    camera_ = graph.add_source<scene::Camera>("camera");
    background_ = graph.add_source<scene::Background>("background");
    shader_revision_ = graph.add_source<int>("shaders");
    picture = graph.add_product<Picture>("picture");
    counts = graph.add_product<SampleCounts>("sample counts");
    march_ = graph.add_pass({"march",
                             "light along every pixel's ray, through all volumes, over meshes and background",
                             {},
                             {picture.index},
                             {}});
    count_ = graph.add_pass({"count samples", "the same march, counting what it looks up", {}, {counts.index}, {}});
}

void MarchPass::update(const scene::Scene& scene, const Volumes& volumes, const Lights& lights,
                       Handle<OpaquePicture> opaque, const std::vector<Handle<CloudPicture>>& clouds, const View& view,
                       double step_world, Handle<SkyPicture> sky, Handle<CloudShafts> shafts,
                       const CloudShadows& shadows) {
    graph_.set_source(camera_, **scene.camera, scene.camera->revision());
    graph_.set_source(background_, *scene.background, scene.background.revision());
    graph_.set_source(shader_revision_, 0, shaders_.revision());

    const double skipped = skipped_distance(**scene.camera, scene::world_bounds(scene));
    Parameters parameters{view,
                          *scene.rendering,
                          step_world * view.step_scale,
                          skipped,
                          opaque,
                          clouds,
                          {},
                          {},
                          false,
                          gradients_stored_,
                          sky,
                          shafts,
                          {}};
    const std::vector<std::string> shining = order_lights(scene);
    std::vector<int> reads{camera_.index, background_.index, shader_revision_.index};
    for (const int behind : {opaque.index, sky.index, shafts.index}) {
        if (behind >= 0) {
            reads.push_back(behind);
        }
    }
    for (const Handle<CloudPicture> layer : clouds) {
        reads.push_back(layer.index);
    }
    for (const auto& [name, passes] : volumes) {
        const auto& volume = std::get<scene::Volume>(scene.nodes.at(name).content);
        VolumeInput input{passes->voxels,
                          passes->gradients,
                          passes->tables,
                          passes->emptiness,
                          scene::world_from_texture(scene, name),
                          *volume.clip,
                          *volume.optics,
                          scene::effective_window(volume),
                          volume.optics->density_scale / volume.transfer_function->reference_length,
                          scene::shading_range(volume),
                          *volume.light_volume,
                          {},
                          {},
                          {}};
        reads.insert(reads.end(), {input.voxels.index, input.tables.index});
        if (scene.rendering->empty_space_skipping) {
            reads.push_back(input.emptiness.index);
        }
        parameters.lit = parameters.lit || input.optics.lighting != scene::VolumeLighting::none;
        if (reflects(input.optics) && gradients_stored_) {
            reads.push_back(input.gradients.index);
        }
        if (const auto found = lights.find(name); found != lights.end()) {
            input.light_grid = found->second->grid();
            input.light = found->second->stacked();
            input.beside = found->second->stacked_beside();
            for (const Handle<LightTextures> handle : {input.light, input.beside}) {
                if (handle.index >= 0 && reads.back() != handle.index) {
                    reads.push_back(handle.index);
                }
            }
        }
        parameters.volumes.push_back(input);
    }
    if (parameters.lit) {
        for (const std::string& light : shining) {
            parameters.lights.push_back(*scene.lights.at(light));
        }
    }
    if (parameters.lit || shafts.index >= 0) {
        parameters.shadows = shadows;
        parameters.shadows.lamp = cloud_lamp(scene);  // among the lamps as they are counted here
        parameters.shadows.add_reads(reads);
    }
    for (const PassId pass : {march_, count_}) {
        graph_.set_reads(pass, reads);
        graph_.set_parameters(pass, parameters);
    }
    graph_.set_execute(march_, [this, parameters](const PassAccess& access) { draw(access, parameters, false); });
    graph_.set_execute(count_, [this, parameters](const PassAccess& access) { draw(access, parameters, true); });
}

gl::Program& MarchPass::program(const PassAccess& access, const Parameters& parameters, bool counting) {
    gl::Defines defines;
    if (parameters.opaque.index >= 0) {
        defines["OPAQUE"] = "";
    }
    if (parameters.sky.index >= 0) {
        defines["SKY"] = "";
    }
    if (!parameters.clouds.empty()) {
        defines["CLOUDS"] = std::to_string(parameters.clouds.size());
    }
    if (parameters.shafts.index >= 0) {
        defines["SHAFTS"] = "";
    }
    parameters.shadows.add_defines(defines);
    if (parameters.volumes.empty()) {
        return shaders_.get("compose/background.frag", defines);
    }
    defines["VOLUMES"] = std::to_string(parameters.volumes.size());
    for (const VolumeInput& input : parameters.volumes) {
        if (access.read(input.voxels).holes) {
            defines["HOLES"] = "";
        }
    }
    if (parameters.lit) {
        defines["LIT"] = "";
        count_lights(defines, parameters.lights);
        std::int64_t near_steps = 0;
        std::set<std::pair<bool, bool>> shadings;  // two-sided, Blinn's highlight
        for (const VolumeInput& input : parameters.volumes) {
            if (scene::scatters(input.optics.lighting)) {
                defines["SCATTER"] = "";
                near_steps = std::max(near_steps, input.light_volume.near_steps);
                if (input.beside.index >= 0) {
                    defines["DIFFUSE_LIGHT"] = "";
                }
            }
            if (reflects(input.optics)) {
                shadings.insert({input.optics.two_sided, input.optics.highlight == scene::Highlight::blinn_phong});
                defines[scene::scatters(input.optics.lighting) ? "SURFACES" : "REFLECT"] = "";
                if (!parameters.gradients_stored) {
                    defines["GRADIENTS_FROM_VOXELS"] = "";
                }
                if (input.optics.specular > 0.0) {
                    defines["HIGHLIGHTS"] = "";
                }
            }
            if (access.read(input.tables).tables.glows) {
                defines["GLOW"] = "";
            }
        }
        if (shadings.size() == 1) {
            defines["TWO_SIDED"] = shadings.begin()->first ? "true" : "false";
            defines["BLINN_PHONG"] = shadings.begin()->second ? "true" : "false";
        }
        if (defines.contains("SCATTER")) {
            defines["NEAR_STEPS"] = std::to_string(near_steps);
        } else {
            defines["REFLECT"] = "";  // only unlit volumes glow without it
        }
    }
    if (parameters.settings.classification == scene::Classification::post) {
        defines["SAMPLE_AT_MIDPOINTS"] = "";
    } else if (parameters.settings.refine && parameters.view.step_scale == 1.0) {
        defines["REFINE"] = "";
    }
    if (parameters.settings.empty_space_skipping) {
        defines["LEAP"] = "";
    }
    if (parameters.settings.early_termination) {
        defines["STOP_EARLY"] = "";
    }
    if (counting) {
        defines["COUNT"] = "";
    }
    return shaders_.get("march/volume_march.frag", defines);
}

void MarchPass::draw(const PassAccess& access, const Parameters& parameters, bool counting) {
    const glm::ivec2 pixels = parameters.view.pixels;
    if (counting) {
        make_targets(access.write(counts), pixels);
        access.write(counts).framebuffer.bind();
    } else {
        make_targets(access.write(picture), pixels);
        access.write(picture).framebuffer.bind();
    }
    gl::Program& shader = program(access, parameters, counting);
    const scene::Camera camera = started_nearer(access.read(camera_), parameters.skipped_distance);
    const scene::Background& background = access.read(background_);
    const double h = parameters.step_world;
    GLuint unit = 0, sky_unit = 0;
    shader.set("pixels", glm::vec2(pixels));
    shader.set("background_top", glm::vec3(background.top));
    shader.set("background_bottom", glm::vec3(background.bottom));
    if (parameters.opaque.index >= 0) {
        unit += 2;
        shader.set("steps_per_unit", float(access.read(parameters.opaque).layers.unit_world / h));
    }
    if (parameters.sky.index >= 0) {
        sky_unit = unit++;
        shader.set("sky_picture", int(sky_unit));
    }
    for (std::size_t n = 0; n < parameters.clouds.size(); ++n) {
        const CloudPicture& layer = access.read(parameters.clouds[n]);
        layer.radiance.bind(unit);
        shader.set_at("cloud_radiance", int(n), "", int(unit++));
        layer.distance.bind(unit);
        shader.set_at("cloud_distance", int(n), "", int(unit++));
    }
    shader.set("metres_per_step", float(h));
    parameters.shadows.set(access, shader, camera.eye_world, h, unit);
    unit += GLuint(parameters.shadows.layers.size());
    if (parameters.shafts.index >= 0) {
        access.read(parameters.shafts).set(shader, access.read(camera_), pixels, unit);
        shader.set("half_view", glm::vec2(half_view(camera, pixels, h)));
        shader.set("shafts_skipped", float(parameters.skipped_distance));
        if (parameters.opaque.index >= 0) {
            shader.set("shafts_surface", float(access.read(parameters.opaque).layers.unit_world));
        }
    }
    if (!parameters.volumes.empty()) {
        shader.set("orthographic", camera.projection == scene::Projection::orthographic ? 1 : 0);
        shader.set("half_view", glm::vec2(half_view(camera, pixels, h)));
        shader.set("near_steps", float(camera.near_distance / h));
        shader.set("stop_transmittance", float(parameters.settings.stop_transmittance));
        shader.set("jitter", int(parameters.settings.jitter));
        if (parameters.settings.jitter == scene::Jitter::blue_noise) {
            if (!blue_noise_) {
                constexpr int edge = 64;
                std::vector<float> tile;
                for (const std::uint16_t rank : make_blue_noise(edge)) {
                    tile.push_back(float(rank) / (edge * edge));
                }
                blue_noise_ = gl::Texture::make_2d("blue noise", GL_R32F, {edge, edge});
                blue_noise_.upload({GL_RED, GL_FLOAT}, tile.data());
            }
            blue_noise_.bind(unit);
            shader.set("blue_noise", int(unit++));
        } else {
            // Samplers of different kinds may not share a unit, so an idle one gets a unit of its own.
            shader.set("blue_noise", int(unit++));
        }
        if (parameters.lit) {
            const scene::CameraFrame frame = scene::camera_frame(camera);
            shader.set("world_from_camera", glm::mat3(glm::dmat3(frame.right_world, frame.up_world, frame.back_world)));
            set_lights(shader, parameters.lights, camera, h);
        }
        for (std::size_t n = 0; n < parameters.volumes.size(); ++n) {
            bind_volume(access, shader, parameters, int(n), unit, camera);
        }
    }
    const SurfaceLayers* const surfaces =
        parameters.opaque.index >= 0 ? &access.read(parameters.opaque).layers : nullptr;
    for (int layer = 0; layer < (surfaces != nullptr ? surfaces->count : 1); ++layer) {
        if (surfaces != nullptr) {
            surfaces->bind(shader, layer, 0);
        }
        if (parameters.sky.index >= 0) {
            access.read(parameters.sky).layers[std::size_t(layer)].color.bind(sky_unit);
        }
        full_screen_.draw(shader, layer > 0);
    }
    access.note(fmt::format("{} x {} pixels", pixels.x, pixels.y) +
                (parameters.volumes.empty() ? "" : fmt::format(", step {:.3g} mm", 1e3 * h)));
}

}  // namespace bruma::render
