#pragma once
#include <imgui/imgui.h>

namespace bruma::app {

/// The colours of all panels: a quiet dark that leaves the eye to the picture, and one accent.
namespace theme {
const ImVec4 accent{0.36F, 0.66F, 0.80F, 1.0F};
const ImVec4 faint{0.58F, 0.61F, 0.65F, 1.0F};
const ImVec4 warning{0.93F, 0.72F, 0.33F, 1.0F};
const ImVec4 error{0.94F, 0.45F, 0.42F, 1.0F};
}  // namespace theme

/// Sets style and font for a screen where one unit of text is `scale` times the usual size.
void apply_theme(float scale);

}  // namespace bruma::app
