#pragma once
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace bruma::app {

/// Whether a field of a volume's optics, or of its light volume, has any effect under its present lighting.
bool optics_field_matters(const scene::VolumeOptics& optics, std::string_view field);
bool light_volume_field_matters(const scene::Volume& volume, std::string_view field);
/// Whether a field of the optics is about surfaces rather than about what lies between them.
bool is_about_surfaces(std::string_view field);

/// One sentence: which part of the light the volume's lighting leaves out in this scene.
std::string light_left_out(const scene::Scene& scene, const scene::Volume& volume);

/// Whether light is swept through the volume, and from no other lights than headlights.
bool lacks_sun(const scene::Scene& scene, const scene::Volume& volume);
/// Puts a directional light over the viewer's left shoulder, under which a white medium that scatters all light once is
/// as bright as its colour, in the place of all headlights; returns its name.
std::string add_sun(scene::Scene& scene);

/// "light_1", or the first name after it that no light has; likewise for other words.
std::string free_light_name(const scene::Scene& scene, std::string_view word);

/// Puts a light that has just become one with a position, or ceased to, where it lights the middle of the scene as
/// brightly and from the same side as `before`.
scene::Light with_same_effect(const scene::Scene& scene, const scene::Light& before, scene::Light after);

}  // namespace bruma::app
