#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/scene_arguments.h"
#include "app/verbs/verbs.h"
#include "base/error.h"
#include "io/describe.h"

namespace bruma::app {

Verb declare_info(CLI::App& app) {
    auto arguments = std::make_shared<SceneArguments>();
    arguments->declare(app, false);
    app.get_option("files")->required();
    return [arguments] {
        for (const std::string& file : arguments->files) {
            fmt::print("{}", io::describe_file(file, arguments->hints()));
        }
        return int(ExitCode::done);
    };
}

}  // namespace bruma::app
