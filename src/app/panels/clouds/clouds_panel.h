#pragma once
#include "app/panels/panel_context.h"

namespace bruma::app {

/// All of a layer of clouds: a menu of presets, the layer, its weather, its light, and how it is marched.
void show_clouds(PanelContext& context, scene::Clouds& clouds);

/// Play, pause, scrub and loop the scene's time.
void show_animation(PanelContext& context);

}  // namespace bruma::app
