#include "app/viewer/driver.h"

#include <GL/glew.h>
#include <GLFW/glfw3.h>
#include <fmt/core.h>
#include <imgui/imgui_internal.h>

#include <algorithm>
#include <cstdlib>

#include "app/viewer/orbit.h"
#include "base/error.h"

namespace bruma::app {
namespace {

/// Longest that one step may take, seconds: software renderers under sanitizers are slow.
constexpr double patience_s = 120.0;

int button_of(const std::string& name) {
    return name == "right" ? 1 : name == "middle" ? 2 : 0;
}

}  // namespace

Driver::Driver(std::filesystem::path script, Input& input, Workbench& workbench)
    : script_(std::move(script)), steps_(read_drive_script(script_)), input_(input), workbench_(workbench) {}

void Driver::fail(const DriveStep& step, const std::string& words) const {
    std::string text = step.word;
    for (const std::string& part : step.parts) {
        text += " " + part;
    }
    throw DriveFault(fmt::format("{}:{}: {}: {}", script_.string(), step.line, text, words));
}

bool Driver::is_idle() const {
    return !workbench_.is_loading() && !workbench_.view().refine_at() && !input_.frame_is_due();
}

void Driver::act(double now) {
    if (finished()) {
        return;
    }
    const DriveStep& current = steps_[next_];
    const double started = step_started_.value_or(now);
    step_started_ = started;
    if (now - started > patience_s) {
        fail(current, fmt::format("not done after {:.0f} seconds", patience_s));
    }
    try {
        if (step(current, now)) {
            ++next_;
            step_started_.reset();
        }
    } catch (const Error& fault) {
        fail(current, fault.what());
    }
}

bool Driver::step(const DriveStep& step, double now) {
    const std::string& word = step.word;
    if (word == "move") {
        move(step);
    } else if (word == "press" || word == "release") {
        input_.mouse_button(button_of(step.parts[0]), word == "press");
    } else if (word == "key" || word == "hold" || word == "let") {
        keys(step);
    } else if (word == "scroll") {
        input_.scrolled({0.0, std::atof(step.parts[0].c_str())});
    } else if (word == "type") {
        type(step.parts[0]);
    } else if (word == "paste") {
        ImGui::SetClipboardText(step.parts[0].c_str());
        input_.key(GLFW_KEY_LEFT_CONTROL, true);
        input_.key(GLFW_KEY_V, true);
        input_.key(GLFW_KEY_V, false);
        input_.key(GLFW_KEY_LEFT_CONTROL, false);
    } else if (word == "drop") {
        input_.dropped(step.parts);
    } else if (word == "close-window") {
        input_.close_asked();
    } else if (word == "open") {
        input_.dropped({step.parts[0]});
    } else if (word == "wait-idle") {
        return is_idle();
    } else if (word == "wait") {
        return now - *step_started_ >= 1e-3 * (step.parts.empty() ? 0.0 : std::atof(step.parts[0].c_str()));
    } else if (word == "expect-frames-idle") {
        return expect_idle(step, now);
    } else if (word == "screenshot") {
        screenshot_ = step.parts[0];
        input_.one_frame();
    } else if (word == "picture") {
        workbench_.write_refined_picture(step.parts[0]);
    } else if (word == "run") {
        run(step);
    } else if (word == "quit") {
        next_ = steps_.size();
        return false;
    } else {
        expect(step);
    }
    return true;
}

void Driver::closed() {
    const bool expected = next_ < steps_.size() && steps_[next_].word == "expect-closed";
    for (std::size_t n = next_; n < steps_.size(); ++n) {
        if (!expected || (n > next_ && steps_[n].word != "run")) {
            fail(steps_[n], "the window has closed before this");
        }
        if (steps_[n].word == "run") {
            run(steps_[n]);
        }
    }
    next_ = steps_.size();
}

void Driver::run(const DriveStep& step) const {
    if (std::system(step.parts[0].c_str()) != 0) {
        fail(step, "the command failed");
    }
}

void Driver::type(const std::string& text) {
    for (const char* at = text.c_str(); *at != '\0';) {
        unsigned codepoint = 0;
        at += std::max(1, ImTextCharFromUtf8(&codepoint, at, nullptr));
        input_.typed(codepoint);
    }
}

void Driver::move(const DriveStep& step) {
    const auto number = [](const std::string& text) { return std::atof(text.c_str()); };
    const auto relative = [](const std::string& text) { return text[0] == '+' || text[0] == '-'; };
    if (step.parts[0][0] != '@') {
        glm::dvec2 to = input_.mouse();
        for (int n = 0; n < 2; ++n) {
            const std::string& part = step.parts[std::size_t(n)];
            to[n] = relative(part) ? to[n] + number(part) : number(part);
        }
        input_.mouse_moved(to);
        return;
    }
    const std::string name = step.parts[0].substr(1);
    const WidgetPlaces::Rectangle* place = workbench_.places().find(name);
    if (place == nullptr || step.parts.size() != 3) {
        std::string shown;
        for (const auto& [known, rectangle] : workbench_.places().all()) {
            shown += (shown.empty() ? "" : ", ") + known;
        }
        fail(step, "no such widget is shown; shown are " + shown);
    }
    const glm::dvec2 share(number(step.parts[1]), number(step.parts[2]));
    input_.mouse_moved(place->low + share * (place->high - place->low));
}

void Driver::keys(const DriveStep& step) {
    std::string name = step.parts[0];
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::vector<int> codes;
    for (std::size_t at = 0; at != std::string::npos;) {
        const std::size_t plus = name.find('+', at);
        codes.push_back(key_of_name(name.substr(at, plus - at)));
        at = plus == std::string::npos ? plus : plus + 1;
        if (codes.back() < 0) {
            fail(step, "no such key");
        }
    }
    if (step.word != "let") {
        for (const int code : codes) {
            input_.key(code, true);
        }
    }
    if (step.word != "hold") {
        for (const int code : codes) {
            input_.key(code, false);
        }
    }
}

bool Driver::expect_idle(const DriveStep& step, double now) {
    if (!waiting_until_) {
        waiting_until_ = now + 1e-3 * std::atof(step.parts[0].c_str());
        frames_then_ = workbench_.frames();
        return false;
    }
    if (now < *waiting_until_) {
        return false;
    }
    waiting_until_.reset();
    if (workbench_.frames() != frames_then_) {
        fail(step, fmt::format("{} frames were drawn", workbench_.frames() - frames_then_));
    }
    return true;
}

void Driver::expect_words(const DriveStep& step) const {
    const std::string shown = step.word == "expect-title" ? workbench_.title() : workbench_.shown_status();
    if ((shown.find(step.parts[0]) != std::string::npos) == (step.word == "expect-no-status")) {
        fail(step, "shown is: " + shown);
    }
}

void Driver::expect_of_scene(const DriveStep& step) const {
    const scene::Scene& scene = workbench_.scene();
    if (step.word == "expect-nodes" && std::to_string(scene.nodes.size()) != step.parts[0]) {
        fail(step, fmt::format("there are {}", scene.nodes.size()));
    }
    const double aspect = double(workbench_.area().x) / std::max(1, workbench_.area().y);
    if (step.word == "expect-all-in-view" &&
        !(scene.camera && shows(**scene.camera, scene::world_bounds(scene), aspect))) {
        fail(step, "some of it is outside");
    }
}

void Driver::expect(const DriveStep& step) {
    if (step.word == "expect-closed") {
        fail(step, "the window is open");
    }
    if (step.word == "expect-title" || step.word == "expect-status" || step.word == "expect-no-status") {
        expect_words(step);
        return;
    }
    if (step.word == "expect-nodes" || step.word == "expect-all-in-view") {
        expect_of_scene(step);
        return;
    }
    if (step.word == "expect-node" || step.word == "expect-no-node") {
        if (workbench_.scene().nodes.contains(step.parts[0]) != (step.word == "expect-node")) {
            std::string names;
            for (const auto& [name, node] : workbench_.scene().nodes) {
                names += (names.empty() ? "" : ", ") + name;
            }
            fail(step, "the scene holds " + (names.empty() ? "no node" : names));
        }
    } else if (step.word == "expect-fault" || step.word == "expect-no-fault") {
        const std::string shown = workbench_.shown_fault();
        if (step.word == "expect-no-fault" ? !shown.empty() : shown.find(step.parts[0]) == std::string::npos) {
            fail(step, shown.empty() ? "no fault is shown" : "shown is: " + shown);
        }
    } else {
        std::string ran;
        for (const std::string& name : workbench_.view().take_passes_run()) {
            ran += (ran.empty() ? "" : ", ") + name;
        }
        if (step.word == "expect-passes" && ran != step.parts[0]) {
            fail(step, ran.empty() ? "no pass ran" : "these ran: " + ran);
        }
    }
}

}  // namespace bruma::app
