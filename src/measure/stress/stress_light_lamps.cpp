#include <GL/glew.h>
#include <fmt/core.h>

#include "base/error.h"
#include "measure/stress/stress_light.h"

namespace bruma::measure {
namespace {

scene::Light lamp_at(glm::dvec3 position_world, double intensity = 1e-4) {
    return {.kind = scene::LightKind::point, .position_world = position_world, .intensity = intensity};
}

/// The usual light in `count` equal parts.
scene::Scene shared_among(int count) {
    scene::Scene scene = scattering_scene({});
    const scene::Light whole = *scene.lights.at("light");
    scene.lights.clear();
    for (int n = 0; n < count; ++n) {
        scene::Light part = whole;
        part.intensity /= count;
        scene.lights[fmt::format("light-{}", n)] = part;
    }
    return scene;
}

scene::Scene with_second(const scene::Light& light) {
    scene::Scene scene = scattering_scene({});
    scene.lights["second"] = light;
    return scene;
}

scene::Light spot(double angle_deg, glm::dvec3 position_world) {
    scene::Light light = lamp_at(position_world, 1e-3);
    light.kind = scene::LightKind::spot;
    light.direction_world = position_world;  // the volume's centre is the origin
    light.spot_angle_deg = angle_deg;
    light.spot_softness = 0.0;
    return light;
}

}  // namespace

void stress_light_lamps(StressRig& rig) {
    rig.group("lamps");
    // Irradiance has no bound beside a lamp: finite and not below 0 is all that can be asked of the picture.
    constexpr double finite = 3.4e38;
    struct Place {
        const char* name;
        glm::dvec3 position_world;
    };
    for (const Place& place :
         {Place{"centre", {0.0, 0.0, 0.0}}, Place{"on-a-sample", {0.5e-3, 0.5e-3, 0.5e-3}},
          Place{"on-a-face", {8e-3, 1e-3, 2e-3}}, Place{"on-an-edge", {8e-3, 8e-3, 1e-3}},
          Place{"at-a-corner", {8e-3, 8e-3, 8e-3}}, Place{"beside-a-face", {8.001e-3, 0.0, 0.0}}}) {
        rig.number(place.name, "a point light there: brightest", finite,
                   [&] { return share_of_allowed(rig, scattering_scene(lamp_at(place.position_world))); });
    }
    rig.number("at-the-eye", "a point light in the eye: brightest", finite, [&] {
        scene::Scene scene = scattering_scene({});
        scene.lights["light"] = lamp_at((*scene.camera)->eye_world);
        return share_of_allowed(rig, scene);
    });
    rig.number("1e300", "a point light 1e300 m away: black", 0.0, [&] {
        return share_of_allowed(rig, scattering_scene(lamp_at({1e300, 0.0, 1e300})));
    });
    // Axes of parallel light below a weight of 1/1024 are left out and the others take their share; those of a lamp are
    // kept, so that the two may differ by 1/512.
    rig.number("far", "a point light 1e4 m away, against parallel light", 2e-3, [&] {
        const glm::dvec3 way = 1e4 * glm::normalize(glm::dvec3(-0.4, 0.8, 0.6));
        return difference_in_all_ways(rig, scattering_scene(lamp_at(way, 1e8 * std::numbers::pi)),
                                      scattering_scene({}));
    });
    // Sums of rounded parts: 2^-24 for each.
    rig.number("coincident", "two halves of a light in one place, against the whole", 1e-5,
               [&] { return difference_in_all_ways(rig, shared_among(2), scattering_scene({})); });
    rig.number("eight", "the same light as eight of an eighth each", 1e-5,
               [&] { return difference_in_all_ways(rig, shared_among(8), scattering_scene({})); });
    // Each light takes two textures, and drivers have 16 or more.
    GLint units = 0;
    glGetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &units);
    rig.number("40", fmt::format("forty parts of a light, where {} textures fit: refused, or as the whole", units),
               1e-5, [&] {
                   try {
                       return difference_in_all_ways(rig, shared_among(40), scattering_scene({}));
                   } catch (const Error&) {
                       return 0.0;
                   }
               });
    rig.number("black", "a second light that is black changes nothing", 0.0, [&] {
        return difference_in_all_ways(rig, with_second({.color = glm::dvec3(0.0)}), scattering_scene({}));
    });
    rig.number("off", "a second light that is off changes nothing", 0.0,
               [&] { return difference_in_all_ways(rig, with_second({.on = false}), scattering_scene({})); });
    rig.number("intensity-0", "a second light of intensity 0 changes nothing", 0.0,
               [&] { return difference_in_all_ways(rig, with_second({.intensity = 0.0}), scattering_scene({})); });
    const glm::dvec3 outside(0.02, 0.03, 0.03);
    rig.number("spot-0.1", "a spot of 0.1 degrees: brightest, as a share", 1.0,
               [&] { return share_of_allowed(rig, scattering_scene(spot(0.1, outside)), 10.0); });
    rig.number("spot-179", "a spot of 179 degrees, against a point light", 1e-6, [&] {
        return difference_in_all_ways(rig, scattering_scene(spot(179.0, outside)),
                                      scattering_scene(lamp_at(outside, 1e-3)));
    });
    rig.number("spot-179-inside", "a spot of 179 degrees in the middle of a voxel: brightest", finite, [&] {
        return share_of_allowed(rig, scattering_scene(spot(179.0, {0.4e-3, 0.3e-3, 0.2e-3})));
    });
    rig.number("direction-1e-150", "a direction hardly long: share of what energy allows", 1.001, [&] {
        return share_of_allowed(rig, scattering_scene({.direction_world = {0.0, 1e-150, 1e-150}}));
    });
    rig.number("intensity-1e12", "the strongest light: share of what energy allows", 1.001,
               [&] { return share_of_allowed(rig, scattering_scene({.intensity = 1e12}), 1e12); });
}

}  // namespace bruma::measure
