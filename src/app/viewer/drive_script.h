#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace bruma::app {

/// One step of a script that acts in a person's place.
struct DriveStep {
    int line = 0;                    ///< in the file, from 1
    std::string word;                ///< what to do
    std::vector<std::string> parts;  ///< with what; the number is checked
};

/// Reads a script: a step on each line, '#' starts a comment, words in single quotes may hold blanks. The steps:
///
///     move X Y                   pointer to screen units; from -1 on the last position relative: move +5 -3
///     move @PLACE FX FY          pointer to a share (0..1, from the upper left) of a named widget
///     press|release left|right|middle
///     key NAME                   key down and up; with Ctrl+ or Shift+ before the name
///     hold NAME, let NAME        key down; key up
///     scroll N                   notches of the wheel
///     type TEXT
///     paste TEXT                 Ctrl+V with the text on the clipboard
///     open FILE, drop FILE...    as if dropped on the window, alone or up to eight at once
///     close-window               the window's own button
///     wait-idle                  until nothing is being read, refined or still to be drawn
///     wait [MS]                  for so long; without a number, for the frames that are due
///     watch-passes               forgets which passes have run
///     expect-passes LIST         what ran since the last watch-passes or expect-passes, in order, with ', ' between
///     expect-node NAME           the scene has it
///     expect-no-node NAME        the scene does not have it
///     expect-nodes N             so many nodes
///     expect-all-in-view         the picture holds the boxes of all shown nodes
///     expect-fault WORDS         the banner over the picture, or a dialog, holds these words
///     expect-no-fault            neither is shown
///     expect-title WORDS         that of the window holds these words
///     expect-status WORDS        the lines over the picture hold these words; expect-no-status: they do not
///     expect-closed              the window closes; only 'run' may follow
///     expect-frames-idle MS      nothing is drawn for so long
///     screenshot FILE.png        the whole window
///     picture FILE.png           the refined picture, without panels
///     run COMMAND                a shell command, which must succeed
///     quit
///
/// Throws InputError naming file and line of an unknown word or a wrong number of parts.
std::vector<DriveStep> read_drive_script(const std::filesystem::path& path);

/// GLFW key code of a name: letters, digits, f1.., enter, escape, tab, delete, backspace, shift, ctrl, ...; -1 if
/// unknown.
int key_of_name(const std::string& name);

}  // namespace bruma::app
