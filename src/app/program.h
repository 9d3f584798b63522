#pragma once
#include <functional>
#include <string>
#include <vector>

#include "scene/volume/volume.h"

namespace bruma::app {

/// What the viewer is started with.
struct ViewRequest {
    std::vector<std::string> files;
    scene::VolumeSource hints;
    std::vector<std::string> settings;  ///< PATH=VALUE
    std::string camera;                 ///< see scene_arguments.h; empty: fitted
    std::string up;                     ///< likewise; empty: y
    std::string drive_script;           ///< file of steps to act out (tests); empty: a person acts
    int width = 1280, height = 800;     ///< of the window
    int samples = 1024;                 ///< path_traced lighting: paths per pixel of the picture that stays
};
using Viewer = std::function<int(const ViewRequest&)>;

/// The whole program: reads the command line (without the program's name) and returns the exit code. Faults are told
/// on standard error in one sentence. `viewer` is empty where there are no windows.
int run_program(const std::vector<std::string>& arguments, const Viewer& viewer);

}  // namespace bruma::app
