#pragma once
#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

#include "context/window.h"

namespace bruma::app {

/// The one door for what a person does to the window. GLFW's callbacks and scripts of steps both come through it, so a
/// script acts on the same code as a hand does. It keeps the state that ImGui asks for at each frame, and counts the
/// frames that are due: a widget needs a few frames after an event until it has come to rest.
class Input {
  public:
    explicit Input(context::Window& window) : window_(window) {}

    /// Lets GLFW report to this object. With `hands_off` only the window's own events (size, exposure, close) are
    /// heard, so that a pointer lying on the screen does not disturb a script.
    void listen(bool hands_off);

    void mouse_moved(glm::dvec2 position);  ///< screen units from the upper left corner
    void mouse_button(int button, bool down);
    void scrolled(glm::dvec2 notches);
    void key(int key, bool down);  ///< a GLFW_KEY_*
    void typed(unsigned codepoint);
    void dropped(std::vector<std::string> paths);
    void close_asked();  ///< the window's own button, or the desktop's
    void disturbed();    ///< anything else that makes the window look different
    void one_frame() { frames_due_ = std::max(frames_due_, 1); }

    bool frame_is_due() const { return frames_due_ > 0; }
    /// Hands everything to ImGui and counts one frame as drawn. `now`: seconds.
    void begin_frame(double now);
    bool any_button_down() const;
    bool focused() const;
    std::vector<std::string> take_dropped() { return std::exchange(dropped_, {}); }
    bool take_close_asked() { return std::exchange(close_asked_, false); }
    glm::dvec2 mouse() const { return mouse_; }

  private:
    void set_key(int key, bool down);

    context::Window& window_;
    glm::dvec2 mouse_{-1e9};
    std::array<bool, 3> down_{}, pressed_{};
    std::vector<std::string> dropped_;
    bool close_asked_ = false;
    std::vector<int> unseen_keys_, released_unseen_, release_next_;
    double last_frame_ = 0.0;
    int frames_due_ = 3;
};

/// Tells ImGui which keys and which clipboard there are. Once per ImGui context.
void set_up_imgui_input(context::Window& window);

}  // namespace bruma::app
