#pragma once
#include <optional>
#include <string>

namespace bruma::app {

/// Boxes of numbers take a decimal comma as a decimal point. ImGui would leave the comma out and make 5 of 0,5.

/// To be called behind each box that is no slider and no drag, and behind all for whole numbers.
void note_number_box(bool is_whole);

/// Looks at what was typed since the last frame, before any widget does: in a box of numbers each comma becomes a
/// point, and a second one is left out. In a box of whole numbers a comma or a point refuses all that was typed: the
/// box has its old number again until it is left. Returns a sentence when something was refused. Between ImGui's
/// NewFrame and the first widget.
std::string take_decimal_commas();

/// What a paste into the box at hand may bring: the text as it is, except that a box of numbers gets a decimal comma as
/// a point. Nothing where the text is no number that the box can hold, as 1,234.5.
std::optional<std::string> pasted_number(const std::string& text);

}  // namespace bruma::app
