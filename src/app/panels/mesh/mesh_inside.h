#pragma once
#include <string>

#include "scene/scene.h"

namespace bruma::app {

/// How far light goes in a translucent mesh beside what the maps of it can
/// show, for people: three lengths in mm.
std::string light_inside_words(const scene::Scene& scene, const std::string& node_name, const scene::Mesh& mesh);

}  // namespace bruma::app
