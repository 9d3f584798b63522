#pragma once
#include <filesystem>
#include <string_view>

namespace bruma {

/// Where the program's own files are: "shaders" or "assets". Looked for in this order: the folder set by
/// `use_folder`, beside the installed program (../share/bruma/NAME), then the source tree it was built from.
/// Throws MachineError naming the places when there is none.
std::filesystem::path installed_folder(std::string_view name);

/// Overrides the place of one folder (the --shaders option).
void use_folder(std::string_view name, std::filesystem::path folder);

/// Full path of the running program.
std::filesystem::path program_path();

}  // namespace bruma
