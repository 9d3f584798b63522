#include "render/subsurface/subsurface_entry.h"

#include <algorithm>
#include <cmath>

namespace bruma::render {
namespace {

/// Layout of subsurface/subsurface_entry.glsl.
struct EntryLampData {
    glm::vec4 power, eye;
    MapFace faces[6];
};

}  // namespace

gl::Defines entry_defines(const LightMaps& light, const scene::SubsurfaceSettings& settings) {
    gl::Defines defines;
    if (settings.model == scene::SubsurfaceModel::standard_dipole) {
        defines["STANDARD_DIPOLE"] = "";
    }
    if (settings.sampling == scene::SubsurfaceSampling::exponential_disk) {
        defines["EXPONENTIAL_DISK"] = "";
    }
    if (std::any_of(light.lamps.begin(), light.lamps.end(),
                    [](const LightMaps::Drawn& lamp) { return lamp.cameras.size() > 1; })) {
        defines["CUBE_LAMPS"] = "";
    }
    return defines;
}

void set_entry(gl::Program& program, const LightMaps& light, const SubsurfaceConstants& constants,
               const std::vector<glm::dvec3>& powers, GLuint unit, gl::Buffer& lamps) {
    std::vector<EntryLampData> data(std::max<std::size_t>(1, light.lamps.size()));
    const double radius = light.bounding_radius;
    for (std::size_t n = 0; n < light.lamps.size(); ++n) {
        const LightMaps::Drawn& lamp = light.lamps[n];
        const bool cube = lamp.cameras.size() > 1;
        const double distance = glm::length(lamp.lamp.position);
        data[n].power = glm::vec4(powers[n], !lamp.lamp.has_position ? 0.0 : cube ? 2.0 : 1.0);
        data[n].eye = glm::vec4(lamp.lamp.position, !lamp.lamp.has_position || cube
                                                        ? radius
                                                        : radius / std::sqrt(distance * distance - radius * radius));
        for (std::size_t f = 0; f < lamp.cameras.size(); ++f) {
            data[n].faces[f] = map_face(lamp.cameras[f], int(lamp.first_layer) + int(f));
        }
    }
    lamps = gl::Buffer("lamps", std::span<const EntryLampData>(data));
    lamps.bind_storage(2);
    const EntryRates rates = entry_rates(constants, radius);
    set_medium(program, constants);
    program.set("lamp_count", int(light.lamps.size()));
    program.set("tail_rates", glm::vec3(rates.tails));
    program.set("core_rates", glm::vec3(rates.cores));
    program.set("back_lit_depth", float(rates.back_lit_depth));
    light.points.bind(unit);
    program.set("light_points", int(unit));
    light.normals.bind(unit + 1);
    program.set("light_normals", int(unit + 1));
}

void set_entry_points(gl::Program& program, std::uint64_t first, int count) {
    program.set("entry_samples", count);
    for (int n = 0; n < count; ++n) {
        const std::uint64_t index = first + std::uint64_t(n) + 1;  // point 0 is a corner
        program.set_at("entry_points", n, "", glm::vec2(radical_inverse(index, 2), radical_inverse(index, 3)));
    }
}

}  // namespace bruma::render
