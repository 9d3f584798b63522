#pragma once
#include "app/panels/panel_context.h"
#include "app/panels/volume/transfer_function_panel.h"

namespace bruma::app {

/// The column at the right edge of the window that holds all panels, one below the other. Its inner edge can be
/// dragged. Returns its width in screen units.
float show_side_panel(PanelContext& context, TransferFunctionPanel& transfer_function);

}  // namespace bruma::app
