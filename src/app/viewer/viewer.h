#pragma once
#include "app/program.h"

namespace bruma::app {

/// Opens a window on the files and returns when it is closed.
int run_viewer(const ViewRequest& request);

}  // namespace bruma::app
