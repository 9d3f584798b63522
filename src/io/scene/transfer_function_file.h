#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/volume/transfer_function.h"

namespace bruma::io {

/// A transfer function with every field of its table.
nlohmann::json transfer_function_json(const scene::TransferFunction& transfer_function);
/// The reverse, normalised; missing fields keep their defaults. `where` opens the messages of InputError.
scene::TransferFunction read_transfer_function(const nlohmann::json& from, const std::string& where);

/// One transfer function in a file of its own, marked by the key "bruma_transfer_function": 1.
scene::TransferFunction load_transfer_function(const std::filesystem::path& path);
void save_transfer_function(const scene::TransferFunction& transfer_function, const std::filesystem::path& path);

struct Preset {
    std::string name;  ///< file stem
    std::filesystem::path path;
};
/// The .json files of a folder by name; none when there is no such folder. They are not opened.
std::vector<Preset> list_presets(const std::filesystem::path& folder);

/// The file that a scene means by a preset's name: `name` or `name`.json in one of the folders, the first one first.
/// Throws InputError with the nearest preset known.
std::filesystem::path find_preset(const std::string& name, const std::vector<std::filesystem::path>& folders,
                                  const std::string& where);

}  // namespace bruma::io
