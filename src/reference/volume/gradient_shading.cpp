#include "reference/volume/gradient_shading.h"

#include "reference/interpolation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bruma::reference {
namespace {

/// The zero vector stays what it is.
glm::dvec3 unit_or_zero(glm::dvec3 v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

double dot_axis(const scene::Light& light, const scene::Incident& incident) {
    return glm::dot(incident.toward_world, glm::normalize(light.direction_world));
}

}  // namespace

GradientShading::GradientShading(const scene::Scene& scene, const scene::VolumeOptics& optics,
                                 double smallest_voxel_edge, double shading_range)
    : optics_(optics),
      share_per_gradient_(shading_range > 0.0 ? smallest_voxel_edge / shading_range : 0.0),
      // A highlight cos^n is about 1 / sqrt(n) wide.
      largest_turn_(std::min(0.5, 2.0 / std::sqrt(std::max(1.0, optics.specular > 0.0 ? optics.shininess : 1.0)))) {
    camera_back_world_ = scene::camera_frame(**scene.camera).back_world;
    for (const auto& [name, light] : scene.lights) {
        if (scene::shines(*light)) {
            lights_.push_back(*light);
        }
    }
}

void GradientShading::append_bends(glm::dvec3 gradient_world, glm::dvec3 position_world, glm::dvec3 ray_direction_world,
                                   std::vector<double>& bends) const {
    const double share = glm::length(gradient_world) * share_per_gradient_;
    bends.push_back(share - optics_.gradient_soft_from);
    bends.push_back(share - optics_.gradient_soft_to);
    bends.push_back(glm::dot(gradient_world, ray_direction_world));
    for (const scene::Light& light : lights_) {
        const scene::Incident incident = scene::incident_light(light, position_world, camera_back_world_);
        bends.push_back(glm::dot(gradient_world, incident.toward_world));
        if (light.kind == scene::LightKind::spot) {
            bends.push_back(scene::spot_share(light, dot_axis(light, incident)) - 0.5);
        }
    }
}

bool GradientShading::is_resolved(glm::dvec3 begin, glm::dvec3 middle, glm::dvec3 end) const {
    if (share_per_gradient_ == 0.0) {
        return true;
    }
    const double change = std::max({glm::length(middle - begin), glm::length(end - middle), glm::length(end - begin)});
    const double length = std::min({glm::length(begin), glm::length(middle), glm::length(end)});
    return change <= largest_turn_ * std::max(length, optics_.gradient_soft_from / share_per_gradient_);
}

double GradientShading::highlight(glm::dvec3 normal, glm::dvec3 to_light, glm::dvec3 to_eye) const {
    const double cosine = optics_.highlight == scene::Highlight::blinn_phong
                              ? glm::dot(normal, unit_or_zero(to_light + to_eye))
                              : glm::dot(2.0 * glm::dot(normal, to_light) * normal - to_light, to_eye);
    return cosine > 0.0 ? std::pow(cosine, optics_.shininess) : 0.0;
}

GradientShading::Surface GradientShading::surface_at(glm::dvec3 gradient_world, glm::dvec3 ray_direction_world) const {
    const double gradient = glm::length(gradient_world);
    if (!(gradient > 0.0)) {
        return {};
    }
    const glm::dvec3 normal = gradient_world / -gradient;
    const bool turned = optics_.two_sided && glm::dot(normal, ray_direction_world) > 0.0;
    return {smoothstep(optics_.gradient_soft_from, optics_.gradient_soft_to, gradient * share_per_gradient_),
            turned ? -normal : normal};
}

GradientShading::Reflected GradientShading::reflect(const Surface& surface, const scene::Incident& incident,
                                                    glm::dvec3 ray_direction_world) const {
    const glm::dvec3 irradiance = incident.irradiance / std::numbers::pi;
    const double cosine = glm::dot(surface.normal_world, incident.toward_world);
    Reflected reflected;
    reflected.diffuse = irradiance * (optics_.diffuse * (optics_.two_sided ? std::abs(cosine) : std::max(cosine, 0.0)));
    if (cosine > 0.0) {
        reflected.highlight = irradiance * (optics_.specular * highlight(surface.normal_world, incident.toward_world,
                                                                         -ray_direction_world));
    }
    return reflected;
}

glm::dvec3 GradientShading::lit(glm::dvec3 color, glm::dvec3 gradient_world, glm::dvec3 position_world,
                                glm::dvec3 ray_direction_world) const {
    const Surface surface = surface_at(gradient_world, ray_direction_world);
    if (surface.share == 0.0) {
        return color;
    }
    glm::dvec3 diffuse(optics_.ambient);
    glm::dvec3 highlights(0.0);
    for (const scene::Light& light : lights_) {
        const Reflected reflected =
            reflect(surface, scene::incident_light(light, position_world, camera_back_world_), ray_direction_world);
        diffuse += reflected.diffuse;
        highlights += reflected.highlight;
    }
    return glm::mix(color, color * diffuse + highlights, surface.share);
}

}  // namespace bruma::reference
