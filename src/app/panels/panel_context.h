#pragma once
#include <optional>
#include <string>

#include "app/panels/widget_places.h"
#include "context/context.h"
#include "io/scene/transfer_function_file.h"
#include "render/renderer.h"
#include "scene/scene.h"

namespace bruma::app {

/// What a person asks for in a panel and the viewer does after the frame.
struct PanelRequests {
    bool open_file = false, save_scene = false, save_scene_as = false, screenshot = false;
    bool fit = false, help = false, expose = false, count_samples = false, undo = false, redo = false;
    std::optional<bool> play;  ///< time starts or stops running
    bool load_transfer_function = false, save_transfer_function = false;
    std::string transfer_function_file;  ///< to be loaded into the volume being edited
};

/// What the viewer tells its panels.
struct ViewerFacts {
    context::DriverInfo driver;
    render::View view;   ///< of the last picture
    glm::ivec2 area{0};  ///< pixels that the picture fills
    bool refined = false;
    std::optional<render::PathStanding> paths;  ///< of a path traced picture
    int path_samples = 0;                       ///< how many paths per pixel it is to have
    double last_ms = 0.0;                       ///< of the last picture
    double moving_ms = 0.0;                     ///< of the last one while something moved
    int frames = 0, renders = 0;
    render::RunReport passes;
    std::optional<render::SampleTotals> samples;  ///< when someone asked
    std::vector<io::Preset> presets;              ///< of transfer functions
    bool can_undo = false, can_redo = false;
    bool playing = false;  ///< time runs
};

/// All that a panel sees. It changes the scene in place; the viewer notices by the revisions.
struct PanelContext {
    scene::Scene& scene;
    std::string& selected;  ///< name of a node, or of nothing
    WidgetPlaces& places;
    PanelRequests& requests;
    const ViewerFacts& facts;
};

}  // namespace bruma::app
