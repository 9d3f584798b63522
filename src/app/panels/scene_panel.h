#pragma once
#include "app/panels/panel_context.h"

namespace bruma::app {

/// What is in the world: the tree of nodes with what the selected one is made of, lights, sky, display, background,
/// camera.
void show_nodes(PanelContext& context);
void show_selected_node(PanelContext& context);
void show_lights(PanelContext& context);
void show_sky(PanelContext& context);
void show_display(PanelContext& context);
void show_surroundings(PanelContext& context);

}  // namespace bruma::app
