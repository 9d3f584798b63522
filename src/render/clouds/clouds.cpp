#include "render/clouds/clouds.h"

#include <algorithm>

namespace bruma::render {
namespace {

const scene::Clouds& clouds_in(const scene::Scene& scene, const std::string& name) {
    return std::get<scene::Clouds>(scene.nodes.at(name).content);
}

}  // namespace

void Clouds::keep_only(const scene::Scene& scene, const std::vector<std::string>& shown) {
    std::erase_if(layers_, [&](const auto& entry) {
        const bool gone = std::find(shown.begin(), shown.end(), entry.first) == shown.end();
        if (gone) {
            entry.second->march.remove();
            entry.second->passes.remove();
        }
        return gone;
    });
    std::erase_if(noise_, [&](const auto& entry) {
        const bool wanted = std::any_of(shown.begin(), shown.end(), [&](const std::string& name) {
            return clouds_in(scene, name).layer->packing == entry.first;
        });
        if (!wanted) {
            entry.second->remove();
        }
        return !wanted;
    });
}

CloudShadows Clouds::prepare(const scene::Scene& scene, const std::vector<std::string>& shown) {
    keep_only(scene, shown);
    const glm::dvec3 to_sun = sun_direction_world(scene);
    std::vector<Handle<CloudSunDepths>> depths;
    for (const std::string& name : shown) {
        const scene::Clouds& clouds = clouds_in(scene, name);
        const scene::NoisePacking packing = clouds.layer->packing;
        auto& noise = noise_[packing];
        if (!noise) {
            noise = std::make_unique<CloudNoisePass>(graph_, shaders_, packing);
        }
        noise->update(std::any_of(shown.begin(), shown.end(), [&](const std::string& other) {
            const scene::CloudLayer& layer = *clouds_in(scene, other).layer;
            return layer.packing == packing && layer.linear_coverage;
        }));
        auto& layer = layers_[name];
        if (!layer) {
            layer = std::make_unique<Layer>(graph_, shaders_, name);
        }
        layer->passes.update(clouds, noise->noise, to_sun);
        depths.push_back(layer->passes.sun);
    }
    return cloud_shadows(scene, shown, depths);
}

std::vector<Handle<CloudPicture>> Clouds::update(const scene::Scene& scene, const std::vector<std::string>& shown,
                                                 Surroundings around, const View& view) {
    if (around.sky.index >= 0) {
        forget_own_sky();
    } else {
        if (!sky_) {
            sky_ = std::make_unique<CloudSkyPass>(graph_);
        }
        sky_->update(scene);
        around.sky = sky_->light;
    }
    std::vector<Handle<CloudPicture>> pictures;
    for (const std::string& name : shown) {
        const scene::Clouds& clouds = clouds_in(scene, name);
        Layer& layer = *layers_.at(name);
        const Handle<CloudNoise> noise = noise_.at(clouds.layer->packing)->noise;
        layer.march.update(scene, clouds, {layer.passes, noise, around.sky, around.opaque, around.air}, view);
        pictures.push_back(layer.march.picture);
    }
    return pictures;
}

Handle<CloudShafts> Clouds::update_shafts(const scene::Scene& scene, const std::vector<std::string>& shown,
                                          const CloudShadows& shadows, const std::optional<AirTables>& air,
                                          glm::ivec2 pixels) {
    if (!air || shadows.layers.empty() || !scene.outdoors->sky->shafts) {
        forget_shafts();
        return {};
    }
    if (!shafts_) {
        shafts_ = std::make_unique<CloudShaftsPass>(graph_, shaders_);
    }
    double reach = 0.0;
    for (const std::string& name : shown) {
        reach = std::max(reach, clouds_in(scene, name).march->reach_m);
    }
    shafts_->update(scene, shadows, *air, reach, pixels);
    return shafts_->shafts;
}

void Clouds::forget_shafts() {
    if (shafts_) {
        shafts_->remove();
        shafts_.reset();
    }
}

void Clouds::forget_own_sky() {
    if (sky_) {
        sky_->remove();
        sky_.reset();
    }
}

void Clouds::remove() {
    for (auto& [name, layer] : layers_) {
        layer->march.remove();
        layer->passes.remove();
    }
    for (auto& [packing, noise] : noise_) {
        noise->remove();
    }
    forget_own_sky();
    forget_shafts();
}

int Clouds::missing_turns() const {
    int most = 0;
    for (const auto& [name, layer] : layers_) {
        most = std::max(most, layer->march.missing_turns());
    }
    return most;
}

bool Clouds::from_last() const {
    return std::any_of(layers_.begin(), layers_.end(),
                       [](const auto& layer) { return layer.second->march.from_last(); });
}

std::vector<Handle<CloudPicture>> Clouds::pictures() const {
    std::vector<Handle<CloudPicture>> all;
    for (const auto& [name, layer] : layers_) {
        all.push_back(layer->march.picture);
    }
    return all;
}

std::vector<Handle<CloudCounts>> Clouds::counts() const {
    std::vector<Handle<CloudCounts>> all;
    for (const auto& [name, layer] : layers_) {
        all.push_back(layer->march.counts);
    }
    return all;
}

}  // namespace bruma::render
