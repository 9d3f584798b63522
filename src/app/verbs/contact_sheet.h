#pragma once
#include <string>
#include <vector>

#include "app/scene_arguments.h"
#include "io/picture/picture_file.h"
#include "render/compose/presenter.h"
#include "render/renderer.h"

namespace bruma::app {

/// One scene under many settings, side by side: each column and each row adds its own.
struct ContactSheet {
    using Settings = std::vector<std::string>;  ///< PATH=VALUE
    std::vector<Settings> across = std::vector<Settings>(1), down = across;
    bool auto_exposure = false;  ///< each picture its own
};

/// 'PATH=VALUE PATH=VALUE | PATH=VALUE': settings of one picture between blanks, pictures between bars. Throws
/// InputError, with the option's name, for a picture without settings.
std::vector<ContactSheet::Settings> sheet_settings(const std::string& option, const std::string& words);

/// Draws them all, each of `arguments.size`, the first row on top.
io::Picture8 draw_sheet(const ContactSheet& sheet, const SceneArguments& arguments, gl::ShaderLibrary& shaders);

}  // namespace bruma::app
