#include "app/panels/dialogs.h"

#include <imgui/imgui.h>
#include <imgui/imgui_stdlib.h>

#include <algorithm>
#include <utility>

#include "app/panels/theme.h"

namespace bruma::app {

void Dialogs::ask_path(std::string title, std::string words, std::string path, std::function<void(std::string)> then) {
    add({Kind::path, std::move(title), std::move(words), std::move(path), "OK", std::move(then), {}});
}

void Dialogs::tell(std::string title, std::string sentence) {
    add({Kind::sentence, std::move(title), std::move(sentence), "", "OK", {}, {}});
}

void Dialogs::confirm(std::string title, std::string sentence, std::string agree, std::function<void()> then) {
    add({Kind::question,
         std::move(title),
         std::move(sentence),
         "",
         std::move(agree),
         [then = std::move(then)](const std::string&) { then(); },
         {}});
}

void Dialogs::ask_about_edits(std::string title, std::string sentence, std::function<void()> save,
                              std::function<void()> discard) {
    add({Kind::edits, std::move(title), std::move(sentence), "", "Save",
         [save = std::move(save)](const std::string&) { save(); }, std::move(discard)});
}

void Dialogs::add(Dialog dialog) {
    dialog.number = ++count_;
    waiting_.push_back(std::move(dialog));
}

bool Dialogs::holds(const std::string& title) const {
    return std::any_of(waiting_.begin(), waiting_.end(), [&](const Dialog& dialog) { return dialog.title == title; });
}

Dialogs::Answer Dialogs::show_buttons(const Dialog& dialog, WidgetPlaces& places) {
    Answer answer = Answer::none;
    if (ImGui::Button(dialog.agree.c_str(), {7.0F * ImGui::GetFontSize(), 0.0F})) {
        answer = Answer::agreed;
    }
    places.note_last("dialog-ok");
    if (dialog.kind == Kind::edits) {
        ImGui::SameLine();
        answer = ImGui::Button("Discard") ? Answer::discarded : answer;
        places.note_last("dialog-discard");
    }
    if (dialog.kind != Kind::sentence) {
        ImGui::SameLine();
        answer = ImGui::Button("Cancel") ? Answer::closed : answer;
        places.note_last("dialog-cancel");
    }
    // Enter is the answer that loses nothing; a question is agreed with by its button.
    const bool takes_enter = dialog.kind == Kind::sentence || dialog.kind == Kind::edits;
    if (takes_enter && !ImGui::IsWindowAppearing() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false)) {
        answer = Answer::agreed;
    }
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false) ? Answer::closed : answer;
}

Dialogs::Answer Dialogs::show_dialog(Dialog& dialog, WidgetPlaces& places) {
    const std::string id = dialog.title + "###dialog";
    if (!std::exchange(dialog.shown, true)) {
        ImGui::OpenPopup(id.c_str());
    }
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5F * screen.x, 0.4F * screen.y}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowSize({std::min(36.0F * ImGui::GetFontSize(), 0.9F * screen.x), 0.0F});
    if (!ImGui::BeginPopupModal(id.c_str(), nullptr, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove)) {
        dialog.shown = false;  // another popup took its place: it is opened again, since it still waits
        return Answer::none;
    }
    ImGui::TextWrapped("%s", dialog.words.c_str());
    ImGui::Spacing();
    bool entered = false;
    if (dialog.kind == Kind::path) {
        if (ImGui::IsWindowAppearing()) {
            ImGui::SetKeyboardFocusHere();
        }
        ImGui::SetNextItemWidth(-1.0F);
        ImGui::PushID(dialog.number);
        entered = ImGui::InputText("##path", &dialog.path, ImGuiInputTextFlags_EnterReturnsTrue);
        places.note_last("dialog-path");
        ImGui::PopID();
        ImGui::Spacing();
    }
    Answer answer = show_buttons(dialog, places);
    answer = entered ? Answer::agreed : answer;
    if (answer != Answer::none) {
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
    return answer;
}

void Dialogs::show(WidgetPlaces& places) {
    if (waiting_.empty()) {
        return;
    }
    const Answer answer = show_dialog(waiting_.front(), places);
    if (answer == Answer::none) {
        return;
    }
    const Dialog done = std::move(waiting_.front());
    waiting_.pop_front();
    if (answer == Answer::agreed && done.then) {
        done.then(done.path);
    } else if (answer == Answer::discarded && done.discard) {
        done.discard();
    }
}

bool show_loading(const std::string& title, const std::string& what, double share, WidgetPlaces& places) {
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({1.2F * em, ImGui::GetIO().DisplaySize.y - 3.2F * em}, ImGuiCond_Always, {0.0F, 1.0F});
    ImGui::SetNextWindowSize({26.0F * em, 0.0F});
    ImGui::Begin("loading", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoNav);
    ImGui::TextUnformatted(title.c_str());
    ImGui::ProgressBar(float(share), {-5.0F * em, 0.0F}, what.c_str());
    ImGui::SameLine();
    const bool cancel = ImGui::Button("Cancel", {-1.0F, 0.0F});
    places.note_last("loading-cancel");
    ImGui::End();
    return cancel;
}

void show_help(bool& open) {
    static constexpr std::pair<const char*, const char*> lines[] = {
        {"Left drag", "orbit around the target"},
        {"Middle drag, Shift + left drag", "pan"},
        {"Wheel", "nearer, farther"},
        {"F, double click", "show everything"},
        {"1 2 3 4 5 6", "front, back, left, right, top, bottom"},
        {"O", "perspective or orthographic"},
        {"R", "camera as it was at first"},
        {"E", "exposure that suits the picture"},
        {"", ""},
        {"Ctrl + O, drop a file", "open, add to the scene"},
        {"Ctrl + S, Ctrl + Shift + S", "save the scene, under a new name"},
        {"P", "refined picture to a .png file"},
        {"Ctrl + Z, Ctrl + Y", "undo, redo"},
        {"Tab", "panels away, and back"},
        {"H or ?", "this help"},
        {"Esc, Ctrl + Q", "close a dialog, quit (asks about edits that are in no file)"},
        {"", ""},
        {"In the transfer function", "click adds a point, drag moves it"},
        {"Shift + drag", "ten times finer"},
        {"Right click, Delete", "remove the point"},
        {"Double click on a colour", "choose it"},
        {"Ctrl + click on any slider", "type a number"},
    };
    if (!open) {
        return;
    }
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5F * screen.x, 0.5F * screen.y}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowFocus();
    ImGui::Begin("help", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoNav);
    ImGui::TextColored(theme::accent, "Keys and gestures");
    ImGui::Separator();
    for (const auto& [keys, words] : lines) {
        ImGui::TextUnformatted(keys);
        ImGui::SameLine(17.0F * ImGui::GetFontSize());
        ImGui::TextDisabled("%s", words);
    }
    const bool escape = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    if (escape || (ImGui::IsMouseClicked(0) && !ImGui::IsWindowAppearing())) {
        open = false;
    }
    ImGui::End();
}

}  // namespace bruma::app
