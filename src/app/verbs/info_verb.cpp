#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/scene_arguments.h"
#include "app/verbs/verbs.h"
#include "base/console.h"
#include "base/error.h"
#include "io/describe.h"

namespace bruma::app {

Verb declare_info(CLI::App& app) {
    auto arguments = std::make_shared<SceneArguments>();
    arguments->declare(app, false);
    app.get_option("files")->required();
    return [arguments] {
        const scene::VolumeSource hints = arguments->hints();
        for (const std::string& file : arguments->files) {
            answer("{}", io::describe_file(file, hints, arguments->settings, preset_folders()));
        }
        return int(ExitCode::done);
    };
}

}  // namespace bruma::app
