#pragma once
#include <imgui/imgui.h>

#include <glm/glm.hpp>
#include <map>
#include <string>

namespace bruma::app {

/// Where named widgets stood in the last frame, in screen units, so that a script can point at them by name.
class WidgetPlaces {
  public:
    struct Rectangle {
        glm::dvec2 low{0.0}, high{0.0};
    };
    void clear() { places_.clear(); }
    void note(const std::string& name, ImVec2 low, ImVec2 high) { places_[name] = {{low.x, low.y}, {high.x, high.y}}; }
    /// The widget just submitted to ImGui.
    void note_last(const std::string& name) { note(name, ImGui::GetItemRectMin(), ImGui::GetItemRectMax()); }
    /// Null when no such widget was shown.
    const Rectangle* find(const std::string& name) const {
        const auto found = places_.find(name);
        return found == places_.end() ? nullptr : &found->second;
    }
    const std::map<std::string, Rectangle>& all() const { return places_; }

  private:
    std::map<std::string, Rectangle> places_;
};

}  // namespace bruma::app
