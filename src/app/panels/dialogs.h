#pragma once
#include <deque>
#include <functional>
#include <string>

#include "app/panels/widget_places.h"

namespace bruma::app {

/// Windows in front of all others that wait for an answer: questions for a path, sentences to be read, questions to be
/// agreed with. Shown one at a time; Escape closes them without doing anything.
class Dialogs {
  public:
    /// Asks for a path and calls `then` with it.
    void ask_path(std::string title, std::string words, std::string path, std::function<void(std::string)> then);
    /// Shows a sentence.
    void tell(std::string title, std::string sentence);
    /// Calls `then` only if the person agrees.
    void confirm(std::string title, std::string sentence, std::string agree, std::function<void()> then);

    /// Asks what becomes of edits that are in no file: calls `save` or `discard`, or neither.
    void ask_about_edits(std::string title, std::string sentence, std::function<void()> save,
                         std::function<void()> discard);

    void show(WidgetPlaces& places);
    /// What the one in front says; empty when there is none.
    std::string words() const { return waiting_.empty() ? "" : waiting_.front().words; }
    bool any() const { return !waiting_.empty(); }
    /// Whether one of this title waits for an answer.
    bool holds(const std::string& title) const;

  private:
    enum class Kind { path, sentence, question, edits };
    struct Dialog {
        Kind kind;
        std::string title, words, path, agree;
        std::function<void(std::string)> then;
        std::function<void()> discard;
        bool shown = false;
        int number = 0;  ///< unlike any other, so that a box of text knows nothing of the last dialog's
    };
    enum class Answer { none, agreed, discarded, closed };
    static Answer show_dialog(Dialog& dialog, WidgetPlaces& places);
    static Answer show_buttons(const Dialog& dialog, WidgetPlaces& places);
    void add(Dialog dialog);
    std::deque<Dialog> waiting_;
    int count_ = 0;
};

/// How far a file has been read, with a button to stop; returns whether it was pressed.
bool show_loading(const std::string& title, const std::string& what, double share, WidgetPlaces& places);

/// Keys and gestures, over the picture; any click or key closes it.
void show_help(bool& open);

}  // namespace bruma::app
