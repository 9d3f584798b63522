#include "app/viewer/viewer.h"

#include "context/window.h"

namespace bruma::app {

int run_viewer(const ViewRequest& request) {
    const context::Window window("Bruma", {request.width, request.height});
    return 0;
}

}  // namespace bruma::app
