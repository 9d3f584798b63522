#include "render/sky/sky_air.h"

namespace bruma::render {

void set_air(gl::Program& program, const scene::Atmosphere& atmosphere) {
    program.set("air.radius", float(atmosphere.planet_radius_m));
    program.set("air.height", float(atmosphere.height_m));
    program.set("air.rayleigh_scattering", glm::vec3(atmosphere.rayleigh_scattering_per_m));
    program.set("air.rayleigh_scale_height", float(atmosphere.rayleigh_scale_height_m));
    program.set("air.mie_scattering", float(atmosphere.mie_scattering_per_m));
    program.set("air.mie_extinction", float(atmosphere.mie_scattering_per_m + atmosphere.mie_absorption_per_m));
    program.set("air.mie_scale_height", float(atmosphere.mie_scale_height_m));
    program.set("air.mie_g", float(atmosphere.mie_g));
    program.set("air.ozone_absorption", glm::vec3(atmosphere.ozone_absorption_per_m));
    program.set("air.ozone_altitude", float(atmosphere.ozone_altitude_m));
    program.set("air.ozone_half_width", float(atmosphere.ozone_half_width_m));
    program.set("air.ground_albedo", glm::vec3(atmosphere.ground_albedo));
}

void set_air(const PassAccess& access, gl::Program& program, const AirTables& air, GLuint& unit) {
    set_air(program, air.atmosphere);
    const gl::Texture none;  // nothing bound reads as 0
    access.read(air.transmittance).texture.bind(unit);
    program.set("transmittance_table", int(unit++));
    (air.multiple_scattering.index >= 0 ? access.read(air.multiple_scattering).texture : none).bind(unit);
    program.set("multiple_table", int(unit++));
}

}  // namespace bruma::render
