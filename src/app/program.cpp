#include "app/program.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <sstream>

#include "app/scene_arguments.h"
#include "app/verbs/verbs.h"
#include "base/console.h"
#include "base/error.h"
#include "base/installation.h"
#include "base/log.h"
#include "base/nearest_name.h"
#include "context/context.h"

namespace bruma::app {
namespace {

const char* const footer = R"(Without a verb, the files open in the viewer: bruma [FILE...]
Exit codes: 0 done, 1 the answer is 'no' (compare, stress), 2 the input is at fault, 3 this machine cannot.)";

std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            names.push_back("--" + name);
        }
    }
    return names;
}

/// One sentence for what CLI11 did not like.
int tell(const CLI::App& app, const CLI::ParseError& fault) {
    if (fault.get_exit_code() == int(CLI::ExitCodes::Success)) {
        std::ostringstream asked;  // --help or --version
        app.exit(fault, asked, asked);
        answer_text(asked.str());
        require_answer_told();
        return int(ExitCode::done);
    }
    std::string sentence = fault.what();
    if (dynamic_cast<const CLI::ExtrasError*>(&fault)) {
        for (const std::string& word : app.remaining(true)) {
            if (word.starts_with("-")) {
                const std::string name = word.substr(0, word.find('='));
                const CLI::App* used = &app;
                for (const CLI::App* verb : app.get_subcommands()) {
                    used = verb;
                }
                sentence = fmt::format("{}: unknown option{}", name, suggestion(name, option_names(*used)));
                break;
            }
        }
    }
    say("bruma: {}; 'bruma --help' lists what there is\n", sentence);
    return int(ExitCode::user_input);
}

/// A first word that is neither a verb nor a file was meant as one of them.
void check_first_word(const std::vector<std::string>& arguments, const std::vector<std::string>& verbs) {
    if (arguments.empty() || arguments[0].starts_with("-") || arguments[0].find_first_of(":./") != std::string::npos) {
        return;
    }
    std::error_code error;
    const bool is_verb = std::find(verbs.begin(), verbs.end(), arguments[0]) != verbs.end();
    if (!is_verb && !std::filesystem::exists(arguments[0], error)) {
        throw InputError(fmt::format("{}: neither a verb nor a file{}", arguments[0], suggestion(arguments[0], verbs)));
    }
}

/// With BRUMA_STRICT_DRIVER in the environment, as tests have it: throws when the driver told of a fault.
void require_silent_driver() {
    const int faults = context::driver_error_count();
    if (faults > 0 && std::getenv("BRUMA_STRICT_DRIVER") != nullptr) {
        throw MachineError(fmt::format("the driver told of faults ({}), see the messages above", faults));
    }
}

/// Options and files before a verb are the viewer's, and the verb would not see them.
void refuse_words_before_verb(const CLI::App& app) {
    if (app.get_subcommands().empty()) {
        return;
    }
    const std::string verb = app.get_subcommands().front()->get_name();
    for (const CLI::Option* option : app.get_options()) {
        if (option->count() > 0 && option->get_name() != "--verbose") {
            throw InputError(fmt::format("{}: stands before '{}', which does not see it there; write it behind",
                                         option->get_name() == "files" ? option->results().front() : option->get_name(),
                                         verb));
        }
    }
}

int run(const std::vector<std::string>& arguments, const Viewer& viewer) {
    CLI::App app("Bruma: light that scatters, measured against a slow, true picture.", "bruma");
    app.footer(footer);
    app.set_version_flag("--version", "bruma 0.1.0");
    bool verbose = false;
    std::string shaders;
    std::string drive;
    Verb chosen;

    SceneArguments to_view;
    to_view.declare(app, true);
    int samples = ViewRequest{}.samples;
    app.add_option("--samples", samples, "path_traced lighting: paths for each pixel, then the picture rests")
        ->check(CLI::Range(1, 1 << 20));
    app.add_option("--drive", drive, "file of steps that the viewer acts out by itself (for tests)");
    const auto verbosity = [&](CLI::App& verb) {
        verb.add_flag("-v,--verbose", verbose, "say more on standard error");
    };
    const auto with_shaders = [&](CLI::App& verb) {
        verb.add_option("--shaders", shaders, "folder of the shaders, to try out changed ones");
    };
    verbosity(app);
    with_shaders(app);
    std::vector<std::string> verbs;
    const auto add = [&](const char* name, const char* sentence, auto declare, bool draws) {
        CLI::App* verb = app.add_subcommand(name, sentence);
        verbosity(*verb);
        if (draws) {
            with_shaders(*verb);
        }
        const Verb run_verb = declare(*verb);
        verb->callback([&chosen, run_verb] { chosen = run_verb; });
        verbs.emplace_back(name);
    };
    add(
        "render", "a picture of a scene, without a window",
        [&](CLI::App& verb) { return declare_render(verb, arguments); }, true);
    add("reference", "the same picture in double precision, with its stated error", declare_reference, false);
    add("compare", "how far a picture is from another", declare_compare, false);
    add(
        "bench", "run time against error: numbers and a page with plots",
        [&](CLI::App& verb) { return declare_bench(verb, arguments); }, true);
    add(
        "stress", "numerical stability: the whole matrix of nasty inputs, one line each",
        [&](CLI::App& verb) { return declare_stress(verb, arguments); }, true);
    add("info", "what a file holds, or what it may hold", declare_info, false);
    add("parameters", "every parameter of a scene, its path, meaning and range", declare_describe_parameters, false);
    add("shaders", "the shaders as the driver gets them", declare_shaders, true);

    check_first_word(arguments, verbs);
    try {
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    } catch (const CLI::ParseError& fault) {
        return tell(app, fault);
    }
    refuse_words_before_verb(app);
    set_log_level(verbose ? LogLevel::detail : LogLevel::note);
    if (!shaders.empty()) {
        use_folder("shaders", shaders);
    }
    if (chosen) {
        const int code = chosen();
        require_answer_told();
        return code;
    }
    if (!viewer) {
        throw MachineError("this program opens no windows; 'bruma' does, and 'render' needs none");
    }
    const glm::ivec2 size = to_view.pixels();
    return viewer({to_view.files, to_view.hints(), to_view.all_settings(), to_view.camera, to_view.up, drive, size.x,
                   size.y, samples});
}

}  // namespace

int run_program(const std::vector<std::string>& arguments, const Viewer& viewer) {
    prepare_standard_streams();
    try {
        const int code = run(arguments, viewer);
        require_silent_driver();
        return code;
    } catch (const Error& fault) {
        say("bruma: {}\n", fault.what());
        return int(fault.code());
    } catch (const std::bad_alloc&) {
        say("bruma: not enough memory for this; close other programs or use smaller data\n");
        return int(ExitCode::machine);
    } catch (const std::exception& fault) {
        say("bruma: {} (this is a fault of the program; please report it with the command)\n", fault.what());
        return int(ExitCode::machine);
    }
}

}  // namespace bruma::app
