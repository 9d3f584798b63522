#include "render/renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/log.h"
#include "render/light/far_lamps.h"
#include "render/view_rays.h"
#include "scene/sky/sun_lamp.h"

namespace bruma::render {
namespace {

/// Whether a lamp throws shadows that a camera can see.
bool casts_shadows(const scene::Scene& scene) {
    return scene.rendering->shadow_map_size > 0 &&
           std::any_of(scene.lights.begin(), scene.lights.end(), [](const auto& light) {
               return scene::shines(*light.second) && light.second->kind != scene::LightKind::headlight;
           });
}

bool is_translucent(const scene::Scene& scene, const std::string& name) {
    return std::get<scene::Mesh>(scene.nodes.at(name).content).surface->shading == scene::MeshShading::translucent;
}

}  // namespace

Renderer::Renderer(gl::ShaderLibrary& shaders)
    : shaders_(shaders), march_(graph_, shaders), path_trace_(graph_, shaders) {
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
}

double Renderer::step_world(const scene::Scene& scene) {
    double smallest = 1e300, longest = 0.0;
    for (const std::string& name : scene::shown_volumes(scene)) {
        const auto& volume = std::get<scene::Volume>(scene.nodes.at(name).content);
        const glm::dmat4 world_from_texture = scene::world_from_texture(scene, name);
        for (int k = 0; k < 3; ++k) {
            smallest = std::min(smallest, glm::length(glm::dvec3(world_from_texture[k])) / (*volume.grid)->size[k]);
            longest = std::max(longest, glm::length(glm::dvec3(world_from_texture[k])));
        }
    }
    // A speck beside something large must not make a ray's steps so many that the machine stands still, or that floats
    // no longer count them.
    constexpr double most_steps = 1 << 18;
    return smallest < 1e300 ? std::max(smallest * scene.rendering->step, longest / most_steps) : 1.0;
}

void Renderer::update(const scene::Scene& scene, const View& view) {
    if (!scene.outdoors) {
        sky_.reset();
        update_passes(fitting_.fit(scene), view);
        return;
    }
    if (!sky_) {
        sky_ = std::make_unique<SkyPasses>(graph_, shaders_);
    }
    update_passes(fitting_.fit(scene::with_sun_as_lamp(scene)), view);
}

void Renderer::update_passes(const scene::Scene& scene, const View& view) {
    const std::vector<std::string> shown = scene::shown_volumes(scene);
    for (const std::string& name : shown) {
        if (!volumes_.contains(name)) {
            volumes_[name] = std::make_unique<VolumePasses>(graph_, name);
        }
    }
    update_lights(scene, shown, step_world(scene));
    std::erase_if(volumes_, [&](const auto& entry) {
        const bool gone = std::find(shown.begin(), shown.end(), entry.first) == shown.end();
        if (gone) {
            path_trace_.forget(entry.first);
            entry.second->remove();
        }
        return gone;
    });
    const double step = step_world(scene);
    for (const auto& [name, passes] : volumes_) {
        passes->update(std::get<scene::Volume>(scene.nodes.at(name).content), *scene.rendering, step);
    }
    path_traced_ = is_path_traced(scene);
    const CloudShadows shadows = path_traced_ ? CloudShadows{} : prepare_clouds(scene);
    update_meshes(scene, path_traced_ ? std::vector<std::string>{} : scene::shown_meshes(scene), view, shadows);
    if (path_traced_) {
        if (!said_no_meshes_ && !scene::shown_meshes(scene).empty()) {
            said_no_meshes_ = true;
            log_warning("path_traced lighting: paths do not meet meshes yet, so they are left out of the picture");
        }
        if (!said_no_sky_ && sky_) {
            said_no_sky_ = true;
            log_warning("path_traced lighting: paths meet the sun but not the sky; set environment.radiance instead");
        }
        path_trace_.update(scene, volumes_, view);
    } else {
        path_trace_.forget_all();
        const Handle<OpaquePicture> opaque = opaque_ ? opaque_->picture : Handle<OpaquePicture>{};
        if (sky_) {
            sky_->update(scene, opaque, view.pixels);
        }
        const std::vector<Handle<CloudPicture>> clouds = update_clouds(scene, view);
        march_.store_gradients(fitting_.gradients_stored());
        march_.update(scene, volumes_, lights_, opaque, clouds, {view.pixels, view.step_scale}, step,
                      sky_ ? sky_->picture : Handle<SkyPicture>{},
                      clouds_ ? clouds_->update_shafts(scene, scene::shown_clouds(scene), shadows,
                                                       sky_ ? std::optional(sky_->air(*scene.outdoors)) : std::nullopt,
                                                       view.pixels)
                              : Handle<CloudShafts>{},
                      shadows);
    }
}

void Renderer::update_meshes(const scene::Scene& scene, const std::vector<std::string>& shown, const View& view,
                             const CloudShadows& clouds) {
    if (shown.empty() && opaque_) {
        opaque_->remove();
        opaque_.reset();
    }
    if (shadows_ && (shown.empty() || !casts_shadows(scene))) {
        shadows_->remove();
        shadows_.reset();
    }
    const auto is_shown_translucent = [&](const std::string& name) {
        return std::find(shown.begin(), shown.end(), name) != shown.end() && is_translucent(scene, name);
    };
    std::erase_if(translucents_, [&](const auto& entry) { return !is_shown_translucent(entry.first); });
    std::erase_if(meshes_, [&](const auto& entry) {
        const bool gone = std::find(shown.begin(), shown.end(), entry.first) == shown.end();
        if (gone) {
            entry.second->remove();
        }
        return gone;
    });
    if (shown.empty()) {
        map_reads_.reset();
        return;
    }
    if (!opaque_) {
        opaque_ = std::make_unique<OpaquePass>(graph_, shaders_);
    }
    for (const std::string& name : shown) {
        auto& passes = meshes_[name];
        if (!passes) {
            passes = std::make_unique<MeshPasses>(graph_, name);
        }
        passes->update(std::get<scene::Mesh>(scene.nodes.at(name).content));
    }
    const std::optional<scene::Scene> parallel = with_far_lamps_parallel(scene);
    const scene::Scene& lit = parallel ? *parallel : scene;
    std::vector<scene::Light> lights;
    for (const std::string& name : order_lights(lit)) {
        lights.push_back(*lit.lights.at(name));
    }
    update_translucent(lit, shown, lights, view);
    if (casts_shadows(lit)) {
        if (!shadows_) {
            shadows_ = std::make_unique<ShadowPass>(graph_, shaders_);
        }
        shadows_->update(lit, meshes_, lights);
    }
    opaque_->update(lit, meshes_, translucents_, shadows_ ? shadows_->maps : Handle<ShadowMaps>{}, view.pixels,
                    sky_ ? sky_->light : Handle<SkyLight>{}, clouds);
}

void Renderer::update_translucent(const scene::Scene& scene, const std::vector<std::string>& shown,
                                  const std::vector<scene::Light>& lights, const View& view) {
    const glm::dvec3 back = scene::camera_frame(**scene.camera).back_world;
    const bool needs_reads = std::any_of(shown.begin(), shown.end(), [&](const std::string& name) {
        return is_translucent(scene, name) &&
               TranslucentPasses::needs_reads(*std::get<scene::Mesh>(scene.nodes.at(name).content).subsurface);
    });
    if (!needs_reads) {
        map_reads_.reset();
    } else if (!map_reads_) {
        map_reads_ = std::make_unique<MapReadsPass>(graph_, shaders_);
    }
    for (const std::string& name : shown) {
        if (is_translucent(scene, name)) {
            auto& passes = translucents_[name];
            if (!passes) {
                passes = std::make_unique<TranslucentPasses>(graph_, shaders_, name, *meshes_.at(name));
            }
            std::vector<TranslucentPasses::Occluder> occluders;
            for (const auto& [other, mesh] : meshes_) {
                if (other != name) {
                    occluders.push_back({mesh->triangles, mesh->buffers, scene::world_from_model(scene, other)});
                }
            }
            passes->update(std::get<scene::Mesh>(scene.nodes.at(name).content), scene::world_from_model(scene, name),
                           occluders, lights, back, view.paths, map_reads_ ? map_reads_->reads : Handle<MapReads>{});
        }
    }
    if (map_reads_) {
        map_reads_->update(scene, meshes_, translucents_, view.pixels);
    }
}

CloudShadows Renderer::prepare_clouds(const scene::Scene& scene) {
    const std::vector<std::string> shown = scene::shown_clouds(scene);
    if (shown.empty()) {
        if (clouds_) {
            clouds_->remove();
            clouds_.reset();
        }
        return {};
    }
    if (!clouds_) {
        clouds_ = std::make_unique<Clouds>(graph_, shaders_);
    }
    if (const std::string sentence = shadows_left_out(shown); sentence != said_shadows_left_out_) {
        said_shadows_left_out_ = sentence;
        if (!sentence.empty()) {
            log_warning("{}", sentence);
        }
    }
    // Surfaces count their lamps so, and shadows name one of them.
    const std::optional<scene::Scene> parallel = with_far_lamps_parallel(scene);
    return clouds_->prepare(parallel ? *parallel : scene, shown);
}

std::vector<Handle<CloudPicture>> Renderer::update_clouds(const scene::Scene& scene, const View& view) {
    if (!clouds_) {
        return {};
    }
    Clouds::Surroundings around;
    if (opaque_) {
        around.opaque = opaque_->picture;
    }
    if (sky_) {
        around.sky = sky_->light;
        around.air = sky_->air(*scene.outdoors);
    }
    return clouds_->update(scene, scene::shown_clouds(scene), around, view);
}

void Renderer::update_lights(const scene::Scene& scene, const std::vector<std::string>& shown, double step_world) {
    std::vector<std::pair<std::string, scene::Light>> shining;
    for (const std::string& name : order_lights(scene)) {
        shining.emplace_back(name, *scene.lights.at(name));
    }
    const glm::dvec3 back = scene::camera_frame(**scene.camera).back_world;
    // A volume that scatters nothing, or in the dark, needs no light.
    const auto needs_light = [&](const std::string& name) {
        const auto& optics = *std::get<scene::Volume>(scene.nodes.at(name).content).optics;
        return !is_path_traced(scene) && scene::scatters(optics.lighting) &&
               (optics.albedo != glm::dvec3(0.0) || optics.surfaces) && !shining.empty();
    };
    std::erase_if(lights_, [&](const auto& entry) {
        return std::find(shown.begin(), shown.end(), entry.first) == shown.end() || !needs_light(entry.first);
    });
    for (const std::string& name : shown) {
        if (needs_light(name)) {
            auto& passes = lights_[name];
            if (!passes) {
                passes = std::make_unique<LightPasses>(graph_, shaders_, name, *volumes_.at(name));
            }
            passes->update(std::get<scene::Volume>(scene.nodes.at(name).content),
                           scene::world_from_texture(scene, name), shining, back, step_world);
        }
    }
}

const RunReport& Renderer::render(const scene::Scene& scene, const View& view, bool measure_gpu) {
    update(scene, view);
    FrameGraph::Stopwatch stopwatch;
    if (measure_gpu) {
        stopwatch = [](const std::function<void()>& body) {
            // Wall time between two drained queues: on hardware it holds the submission too, and on software renderers,
            // whose timer queries were seen to give nonsense, it is the time.
            glFinish();
            const auto start = std::chrono::steady_clock::now();
            body();
            glFinish();
            return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        };
    }
    return graph_.run({wanted_picture()}, stopwatch);
}

}  // namespace bruma::render
