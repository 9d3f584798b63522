#pragma once
#include "app/panels/panel_context.h"
#include "app/panels/volume/opacity_scale.h"
#include "app/panels/volume/volume_histogram.h"

namespace bruma::app {

/// The curves of a transfer function as things to be grasped: opacity points over the histogram, colour points along a
/// band, and the window's two ends over the whole range of the data.
class TransferFunctionEditor {
  public:
    /// Draws everything and lets a hand change `tf`; `window`: the data values between which it is stretched.
    void show(scene::TransferFunction& tf, std::array<double, 2> window,
              const std::shared_ptr<const scene::VolumeGrid>& grid, WidgetPlaces& places);
    /// Another volume: nothing is selected.
    void forget();

  private:
    struct Canvas {
        ImVec2 low, high;
        float x(double u) const { return low.x + float(u) * (high.x - low.x); }
        float y(double height) const { return high.y - float(height) * (high.y - low.y); }
    };
    void draw_curve(const scene::TransferFunction& tf, std::array<double, 2> window, const Canvas& canvas) const;
    void edit_opacity(scene::TransferFunction& tf, const Canvas& canvas);
    void edit_colors(scene::TransferFunction& tf, WidgetPlaces& places);
    void pick_color(scene::TransferFunction& tf);
    void edit_window(scene::TransferFunction& tf, std::array<double, 2> window, WidgetPlaces& places);
    void edit_numbers(scene::TransferFunction& tf, WidgetPlaces& places);
    void choose_scales(WidgetPlaces& places);

    VolumeHistogram histogram_;
    OpacityScale scale_ = OpacityScale::linear;
    bool logarithmic_counts_ = true;
    int point_ = -1, color_ = -1;  ///< selected ones; -1: none
    int window_part_ = -1;         ///< grasped: 0 lower end, 1 upper end, 2 both
    bool grasping_ = false;        ///< a point follows the hand
    ImVec2 grasp_{0.0F, 0.0F};     ///< where it would be if it could go anywhere, screen units
};

}  // namespace bruma::app
