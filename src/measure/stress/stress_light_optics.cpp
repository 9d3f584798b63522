#include <fmt/core.h>

#include "base/error.h"
#include "io/scene/scene_json.h"
#include "measure/stress/stress_light.h"

namespace bruma::measure {
namespace {

/// 0 if a value of the volume's optics is refused at the door and `usual` is not, else 1.
double accepted(const std::string& key, const nlohmann::json& value, const nlohmann::json& usual) {
    nlohmann::json document = io::to_json(scattering_scene({}));
    document["nodes"]["volume"]["source"]["file"] = "builtin:bucky";
    document["nodes"]["volume"][key] = usual;
    io::from_json(document, "");
    document["nodes"]["volume"][key] = value;
    try {
        io::from_json(document, "");
    } catch (const InputError&) {
        return 0.0;
    }
    return 1.0;
}

scene::Scene with_optics(const std::function<void(scene::VolumeOptics&)>& change) {
    scene::Scene scene = scattering_scene({});
    stress_volume(scene).optics.edit(change);
    return scene;
}

/// Relative error of the middle pixel against the closed form.
double uniform_error(StressRig& rig, double depth, int way, int near_steps) {
    scene::Scene scene = uniform_scene(depth);
    take_way(scene, way);
    stress_volume(scene).light_volume.edit([near_steps](auto& settings) { settings.near_steps = near_steps; });
    const Image image = rig.draw(scene);
    return std::abs(double(*image.pixel(image.width / 2, image.height / 2)) / uniform_radiance(depth) - 1.0);
}

}  // namespace

void stress_light_optics(StressRig& rig) {
    rig.group("optics");
    // Light is kept in half precision, whose unit is 2^-11.
    constexpr double energy = 1.0 + 1e-3;
    for (const double g : {-0.99, -0.5, 0.0, 0.5, 0.99}) {
        rig.number(fmt::format("g{:+g}", g), "brightest, as a share of what energy allows", energy,
                   [&] { return share_of_allowed(rig, with_optics([g](auto& o) { o.g = g; })); });
    }
    for (const double g : {-1.0, -0.991, 0.991, 1.0, 1e300}) {
        rig.number(fmt::format("g{:+g}", g), "beyond the range: refused", 0.0, [g] { return accepted("g", g, 0.99); });
    }
    rig.number("albedo-0", "nothing is scattered: black", 0.0,
               [&] { return share_of_allowed(rig, with_optics([](auto& o) { o.albedo = glm::dvec3(0.0); })); });
    rig.number("albedo-1e-9", "brightest, as a share of what energy allows", 1e-9 * energy,
               [&] { return share_of_allowed(rig, with_optics([](auto& o) { o.albedo = glm::dvec3(1e-9); })); });
    rig.number("albedo-1", "nothing is absorbed but by colours", energy,
               [&] { return share_of_allowed(rig, with_optics([](auto& o) { o.albedo = glm::dvec3(1.0); })); });
    for (const double albedo : {-1e-9, 1.000001, 2.0}) {
        rig.number(fmt::format("albedo{:+g}", albedo), "beyond the range: refused", 0.0, [albedo] {
            return accepted("albedo", {albedo, albedo, albedo}, {1.0, 0.0, 1.0});
        });
    }
    // The march's own first-order error under a light that falls within its step, and half precision.
    for (const double depth : {1e-9, 1e-6, 1e-3, 0.1, 1.0, 4.0}) {
        for (const int way : {0, 3}) {
            rig.number(fmt::format("depth-{:g}{}", depth, way == 3 ? "-rays" : ""),
                       "uniform cube lit from the eye, relative error to the closed form", 5e-3,
                       [&] { return uniform_error(rig, depth, way, 2); });
        }
    }
    for (const double depth : {1e2, 1e4, 1e9}) {
        rig.number(fmt::format("depth-{:g}", depth), "so dense that light ends within a step: share of what is allowed",
                   energy, [&] { return share_of_allowed(rig, uniform_scene(depth)); });
    }
    for (const double scale : {1e-9, 1e-4, 1e4, 1e9}) {
        rig.number(fmt::format("density_scale-{:g}", scale), "smooth data: share of what energy allows", energy,
                   [&] { return share_of_allowed(rig, with_optics([scale](auto& o) { o.density_scale = scale; })); });
    }
    rig.number("density_scale-0", "no matter at all: black", 0.0,
               [&] { return share_of_allowed(rig, with_optics([](auto& o) { o.density_scale = 0.0; })); });
}

}  // namespace bruma::measure
