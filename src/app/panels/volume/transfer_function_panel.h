#pragma once
#include "app/panels/volume/transfer_function_editor.h"

namespace bruma::app {

/// The transfer function of the selected volume, or of the first one: presets, the editor, window and level.
class TransferFunctionPanel {
  public:
    void show(PanelContext& context);

  private:
    TransferFunctionEditor editor_;
    std::string node_;
};

/// The volume that the panel edits: the selected one, else the first; empty when there is none.
std::string edited_volume(const scene::Scene& scene, const std::string& selected);

}  // namespace bruma::app
