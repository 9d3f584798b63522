#pragma once
#include <string>
#include <vector>

#include "gl/shader_source.h"

namespace bruma::app {

/// The sets of switches under which the passes ask for this file of `shaders`, each value that changes the text at
/// least once: what a validator has to read. A switch of the file that no set holds is found by `bruma shaders`.
std::vector<gl::Defines> shader_variants(const std::string& file);

}  // namespace bruma::app
