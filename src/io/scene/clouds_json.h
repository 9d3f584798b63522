#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "scene/clouds/clouds.h"

namespace bruma::io {

/// Writes the fields of a layer, and its optics, weather and march as objects of their own, into a node's object.
void write_clouds(const scene::Clouds& clouds, nlohmann::json& object);
/// The reverse. With a "preset" what is missing is that of the preset. The map stays null.
scene::Clouds read_clouds(const nlohmann::json& object, const std::string& where);
/// Writes what makes a preset into a node's object; how it is marched stays. Throws InputError, with the nearest known
/// name, for an unknown one.
void write_cloud_preset(const nlohmann::json& name, const std::string& where, nlohmann::json& object);

}  // namespace bruma::io
