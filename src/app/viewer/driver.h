#pragma once
#include <optional>

#include "app/viewer/drive_script.h"
#include "app/viewer/input.h"
#include "app/viewer/workbench.h"

namespace bruma::app {

/// Acts out a script on a viewer: one step, then frames until the window has taken it in, then the next step.
class Driver {
  public:
    Driver(std::filesystem::path script, Input& input, Workbench& workbench);

    /// Called once per turn of the loop, with no frame due. Throws DriveFault when an expectation fails.
    void act(double now);
    /// The window has closed: the script must expect that next, and may run commands afterwards.
    void closed();
    bool finished() const { return next_ >= steps_.size(); }

    /// The file that the next frame is to be photographed into; once.
    std::string take_screenshot_path() { return std::exchange(screenshot_, {}); }
    bool has_screenshot_due() const { return !screenshot_.empty(); }
    const std::filesystem::path& script() const { return script_; }

  private:
    bool step(const DriveStep& step, double now);
    void move(const DriveStep& step);
    void keys(const DriveStep& step);
    void type(const std::string& text);
    void run(const DriveStep& step) const;
    void expect_of_scene(const DriveStep& step) const;
    void expect_words(const DriveStep& step) const;
    bool expect_idle(const DriveStep& step, double now);
    void expect(const DriveStep& step);
    bool is_idle() const;
    [[noreturn]] void fail(const DriveStep& step, const std::string& words) const;

    std::filesystem::path script_;
    std::vector<DriveStep> steps_;
    std::size_t next_ = 0;
    Input& input_;
    Workbench& workbench_;
    std::optional<double> waiting_until_;
    std::optional<double> step_started_;
    int frames_then_ = 0;
    std::string screenshot_;
};

/// An expectation of a script did not hold.
class DriveFault : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace bruma::app
