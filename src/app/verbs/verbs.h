#pragma once
#include <CLI/App.hpp>
#include <functional>
#include <string>
#include <vector>

/// The verbs of the command line. Each declares its options on a subcommand and returns what runs it; the returned
/// function gives the exit code. `arguments` are the whole command line, for the sibling program.
namespace bruma::app {

using Verb = std::function<int()>;

Verb declare_render(CLI::App& app, const std::vector<std::string>& arguments);
Verb declare_reference(CLI::App& app);
Verb declare_compare(CLI::App& app);
Verb declare_info(CLI::App& app);
Verb declare_bench(CLI::App& app, const std::vector<std::string>& arguments);
Verb declare_stress(CLI::App& app, const std::vector<std::string>& arguments);
Verb declare_shaders(CLI::App& app);
Verb declare_describe_parameters(CLI::App& app);

}  // namespace bruma::app
