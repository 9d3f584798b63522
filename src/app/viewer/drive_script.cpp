#include "app/viewer/drive_script.h"

#include <GL/glew.h>
#include <GLFW/glfw3.h>
#include <fmt/core.h>

#include <cctype>
#include <fstream>
#include <map>

#include "base/error.h"
#include "base/nearest_name.h"

namespace bruma::app {
namespace {

struct Parts {
    std::size_t least, most;
};
const std::map<std::string, Parts> steps{{"move", {2, 3}},
                                         {"press", {1, 1}},
                                         {"release", {1, 1}},
                                         {"key", {1, 1}},
                                         {"hold", {1, 1}},
                                         {"let", {1, 1}},
                                         {"scroll", {1, 1}},
                                         {"type", {1, 1}},
                                         {"open", {1, 1}},
                                         {"drop", {1, 8}},
                                         {"paste", {1, 1}},
                                         {"close-window", {0, 0}},
                                         {"wait-idle", {0, 0}},
                                         {"wait", {0, 1}},
                                         {"watch-passes", {0, 0}},
                                         {"expect-passes", {1, 1}},
                                         {"expect-node", {1, 1}},
                                         {"expect-no-node", {1, 1}},
                                         {"expect-fault", {1, 1}},
                                         {"expect-no-fault", {0, 0}},
                                         {"expect-title", {1, 1}},
                                         {"expect-status", {1, 1}},
                                         {"expect-no-status", {1, 1}},
                                         {"expect-nodes", {1, 1}},
                                         {"expect-all-in-view", {0, 0}},
                                         {"expect-closed", {0, 0}},
                                         {"expect-frames-idle", {1, 1}},
                                         {"screenshot", {1, 1}},
                                         {"picture", {1, 1}},
                                         {"run", {1, 1}},
                                         {"quit", {0, 0}}};

std::vector<std::string> words_of(const std::string& line) {
    std::vector<std::string> words;
    std::size_t at = 0;
    while (true) {
        at = line.find_first_not_of(" \t\r", at);
        if (at == std::string::npos || line[at] == '#') {
            return words;
        }
        const bool quoted = line[at] == '\'';
        const std::size_t start = quoted ? at + 1 : at;
        const std::size_t end = std::min(line.find_first_of(quoted ? "'" : " \t\r", start), line.size());
        words.push_back(line.substr(start, end - start));
        at = std::min(end + (quoted ? 1 : 0), line.size());
    }
}

}  // namespace

std::vector<DriveStep> read_drive_script(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file) {
        throw InputError(fmt::format("{}: cannot be read; is the path right?", path.string()));
    }
    std::vector<std::string> known;
    known.reserve(steps.size());
    for (const auto& [word, parts] : steps) {
        known.push_back(word);
    }
    std::vector<DriveStep> script;
    std::string line;
    for (int number = 1; std::getline(file, line); ++number) {
        std::vector<std::string> words = words_of(line);
        if (words.empty()) {
            continue;
        }
        const auto found = steps.find(words[0]);
        if (found == steps.end()) {
            throw InputError(
                fmt::format("{}:{}: {}: unknown step{}", path.string(), number, words[0], suggestion(words[0], known)));
        }
        DriveStep step{number, words[0], {words.begin() + 1, words.end()}};
        if (step.parts.size() < found->second.least || step.parts.size() > found->second.most) {
            throw InputError(fmt::format("{}:{}: {} takes {} words, not {}; put quotes around blanks", path.string(),
                                         number, words[0], found->second.most, step.parts.size()));
        }
        script.push_back(std::move(step));
    }
    return script;
}

int key_of_name(const std::string& name) {
    static const std::map<std::string, int> names{
        {"enter", GLFW_KEY_ENTER},      {"escape", GLFW_KEY_ESCAPE},       {"tab", GLFW_KEY_TAB},
        {"space", GLFW_KEY_SPACE},      {"backspace", GLFW_KEY_BACKSPACE}, {"delete", GLFW_KEY_DELETE},
        {"left", GLFW_KEY_LEFT},        {"right", GLFW_KEY_RIGHT},         {"up", GLFW_KEY_UP},
        {"down", GLFW_KEY_DOWN},        {"home", GLFW_KEY_HOME},           {"end", GLFW_KEY_END},
        {"shift", GLFW_KEY_LEFT_SHIFT}, {"ctrl", GLFW_KEY_LEFT_CONTROL},   {"slash", GLFW_KEY_SLASH}};
    if (name.size() == 1 && std::isalnum(static_cast<unsigned char>(name[0]))) {
        return std::toupper(static_cast<unsigned char>(name[0]));
    }
    const auto found = names.find(name);
    return found == names.end() ? -1 : found->second;
}

}  // namespace bruma::app
