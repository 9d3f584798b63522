#pragma once
#include "scene/scene.h"

namespace bruma::scene {

/// What the sun is called among the lamps.
inline constexpr const char* sun_lamp_name = "sun in the sky";

/// Of the sun's light on its way through the air to a point of this altitude, metres, with the share of the disc that
/// stands above the point's horizon; `climb` is the sine of the sun's elevation there.
glm::dvec3 sun_transmittance(const Atmosphere& atmosphere, double altitude_m, double climb);

/// The sun as a lamp: its direction, and its irradiance behind the air at the world's origin.
Light sun_lamp(const Sun& sun, const Atmosphere& atmosphere);

/// An outdoor scene with its sun among the lamps; any other as it is.
Scene with_sun_as_lamp(Scene scene);

}  // namespace bruma::scene
