#include "app/panels/number_boxes.h"

#include <imgui/imgui.h>
// The state of the box being typed into is nowhere else.
#include <imgui/imgui_internal.h>

#include <algorithm>
#include <utility>

namespace bruma::app {
namespace {

ImGuiID refusing = 0;  ///< the box that takes nothing until it is left

struct NotedBox {
    ImGuiID id = 0;
    bool is_whole = false;
};
NotedBox noted;

/// The state of the box being typed into if it takes numbers; else null. Sliders and drags become such boxes for a
/// while; the others are noted. The flags of the state, which would tell, stand elsewhere in Debian's library than in
/// its header.
ImGuiInputTextState* number_box() {
    ImGuiContext& context = *ImGui::GetCurrentContext();
    ImGuiInputTextState& state = context.InputTextState;
    const ImGuiID active = context.ActiveId;
    const bool is_one = active != 0 && state.ID == active && (active == context.TempInputId || active == noted.id);
    return is_one ? &state : nullptr;
}

bool takes_whole_numbers(const ImGuiInputTextState& state) {
    return noted.is_whole && noted.id == state.ID;
}

bool separates(ImWchar c) {
    return c == ',' || c == '.';
}

/// Whether a point is in the box beside what the next character would replace.
bool has_point(const ImGuiInputTextState& state) {
    const auto [first, last] = std::minmax(state.Stb.select_start, state.Stb.select_end);
    for (int n = 0; n < state.CurLenW; ++n) {
        if (state.TextW[n] == '.' && (n < first || n >= last)) {
            return true;
        }
    }
    return false;
}

void put_back(ImGuiInputTextState& state) {
    state.CurLenW = ImTextStrFromUtf8(state.TextW.Data, state.TextW.Size, state.InitialTextA.Data, nullptr);
    state.Stb.cursor = state.Stb.select_start = state.Stb.select_end = state.CurLenW;
}

}  // namespace

void note_number_box(bool is_whole) {
    if (ImGui::IsItemActive()) {
        noted = {ImGui::GetActiveID(), is_whole};
    }
}

std::string take_decimal_commas() {
    ImGuiInputTextState* state = number_box();
    if (state == nullptr) {
        refusing = 0;
        return "";
    }
    ImVector<ImWchar>& typed = ImGui::GetIO().InputQueueCharacters;
    if (refusing == state->ID) {
        typed.clear();
        return "";
    }
    refusing = 0;
    if (takes_whole_numbers(*state)) {
        if (std::none_of(typed.begin(), typed.end(), separates)) {
            return "";
        }
        refusing = state->ID;
        typed.clear();
        put_back(*state);
        return "A whole number is asked for here, without comma or point; the old one stays.";
    }
    bool pointed = has_point(*state);
    ImVector<ImWchar> taken;
    for (const ImWchar c : typed) {
        if (!separates(c)) {
            taken.push_back(c);
        } else if (!std::exchange(pointed, true)) {
            taken.push_back('.');
        }
    }
    typed.swap(taken);
    return "";
}

std::optional<std::string> pasted_number(const std::string& text) {
    const ImGuiInputTextState* state = number_box();
    if (state == nullptr) {
        return text;
    }
    const auto separators = std::count_if(text.begin(), text.end(), [](char c) { return c == ',' || c == '.'; });
    if (refusing == state->ID || separators > (takes_whole_numbers(*state) || has_point(*state) ? 0 : 1)) {
        return std::nullopt;
    }
    std::string number = text;
    std::replace(number.begin(), number.end(), ',', '.');
    return number;
}

}  // namespace bruma::app
