#include "app/sibling.h"

#include <unistd.h>

#include <array>

#include "base/error.h"
#include "base/installation.h"
#include "base/log.h"
#include "base/nearest_name.h"

namespace bruma::app {
namespace {

/// Replaces this process by the sibling; returns only if that fails.
void become_sibling(const std::vector<std::string>& arguments) {
    const bool is_osmesa = context::offers(context::Kind::osmesa);
    const std::string path = (program_path().parent_path() / (is_osmesa ? "bruma" : "bruma-osmesa")).string();
    std::vector<char*> words{const_cast<char*>(path.c_str())};
    for (const std::string& argument : arguments) {
        words.push_back(const_cast<char*>(argument.c_str()));
    }
    words.push_back(nullptr);
    ::execv(path.c_str(), words.data());
}

}  // namespace

context::Kind context_kind(const std::string& word) {
    static const std::array<std::string, 3> words{"auto", "egl", "osmesa"};
    for (std::size_t n = 0; n < words.size(); ++n) {
        if (word == words[n]) {
            return context::Kind(n);
        }
    }
    throw InputError("--context " + word + ": unknown" + suggestion(word, words));
}

std::unique_ptr<context::Context> open_context_or_run_sibling(context::Kind kind,
                                                              const std::vector<std::string>& arguments) {
    if (!context::offers(kind)) {
        become_sibling(arguments);
        throw MachineError("--context " + std::string(kind == context::Kind::egl ? "egl" : "osmesa") +
                           ": the program for it is not beside " + program_path().string() +
                           "; build the whole project");
    }
    try {
        return context::open_offscreen(kind);
    } catch (const MachineError& fault) {
        if (kind != context::Kind::automatic || context::offers(context::Kind::osmesa)) {
            throw;
        }
        log_note("{}; trying OSMesa", fault.what());
        become_sibling(arguments);
        throw;
    }
}

}  // namespace bruma::app
