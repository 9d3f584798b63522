#pragma once
#include "app/panels/panel_context.h"

namespace bruma::app {

/// What the last picture cost, pass by pass, and why each ran or did not.
void show_statistics(PanelContext& context);
/// The newest lines of the log.
void show_messages();
/// "refined", or how coarse the picture is.
std::string quality_words(const ViewerFacts& facts);
/// "optical depth 1.83, 16 % passes" of an opacity in (0, 1]; a bound where the march stopped before the end.
std::string optical_depth_words(double opacity, const scene::RenderSettings& settings);

}  // namespace bruma::app
