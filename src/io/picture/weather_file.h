#pragma once
#include <filesystem>
#include <memory>

#include "scene/scene.h"

namespace bruma::io {

/// A weather map from a picture of 8 x 8 to 8192 x 8192 texels (.png, .jpg, .bmp, .tga; colour, grey or palette; 8 or
/// 16 bits, of which 8 are kept), whose numbers are taken as they stand: a weather map is no colour picture. Grey ones
/// give placement in both channels and tops at full height; without alpha, density is neutral. Throws InputError.
std::shared_ptr<const scene::WeatherMap> load_weather_map(const std::filesystem::path& path);

/// Makes or reads the maps of all clouds that have none, or one from elsewhere; `known` (may be null) has some already.
void load_missing_weather(scene::Scene& scene, const scene::Scene* known);

}  // namespace bruma::io
