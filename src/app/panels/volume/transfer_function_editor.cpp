#include "app/panels/volume/transfer_function_editor.h"

#include <algorithm>
#include <cmath>

#include "app/panels/fields_panel.h"
#include "app/panels/number_boxes.h"
#include "app/panels/theme.h"

namespace bruma::app {
namespace {

constexpr float reach = 9.0F;         ///< screen units from a point at which it is grasped
constexpr float margin = 7.0F;        ///< room at both ends, so that points on the border can be grasped
constexpr double fine_control = 0.1;  ///< share of the hand's way while Shift is held

ImU32 display_color(glm::dvec3 linear, float opacity) {
    const auto channel = [](double v) { return float(srgb_of_linear(std::clamp(v, 0.0, 1.0))); };
    return ImGui::ColorConvertFloat4ToU32({channel(linear.x), channel(linear.y), channel(linear.z), opacity});
}

float distance(ImVec2 a, ImVec2 b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

/// Moves what is grasped along with the hand.
void follow_hand(ImVec2& grasp) {
    const ImGuiIO& io = ImGui::GetIO();
    const auto share = float(io.KeyShift ? fine_control : 1.0);
    grasp.x += share * io.MouseDelta.x;
    grasp.y += share * io.MouseDelta.y;
}

/// The interval that a point may move in without passing its neighbours.
template <class Point>
std::pair<double, double> between_neighbours(const std::vector<Point>& points, int index,
                                             const std::array<double, 2>& domain) {
    const auto [low, high] = std::minmax(domain[0], domain[1]);
    const auto n = std::size_t(index);
    return {n > 0 ? points[n - 1].position : low, n + 1 < points.size() ? points[n + 1].position : high};
}

template <class Point>
int insert_sorted(std::vector<Point>& points, Point point) {
    const auto at = std::upper_bound(points.begin(), points.end(), point,
                                     [](const Point& a, const Point& b) { return a.position < b.position; });
    const auto index = at - points.begin();
    points.insert(at, point);
    return int(index);
}

template <class Point>
void remove_point(std::vector<Point>& points, int& index) {
    if (index >= 0 && index < int(points.size()) && points.size() > 1) {
        points.erase(points.begin() + index);
    }
    index = -1;
}

double clamped(double value, std::pair<double, double> range) {
    return std::clamp(value, std::min(range.first, range.second), std::max(range.first, range.second));
}

}  // namespace

void TransferFunctionEditor::forget() {
    point_ = color_ = window_part_ = -1;
    grasping_ = false;
}

void TransferFunctionEditor::show(scene::TransferFunction& tf, std::array<double, 2> window,
                                  const std::shared_ptr<const scene::VolumeGrid>& grid, WidgetPlaces& places) {
    histogram_.update(grid);
    const float em = ImGui::GetFontSize();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::GetContentRegionAvail().x, 11.0F * em};
    const Canvas canvas{{low.x + margin, low.y + 4.0F}, {low.x + size.x - margin, low.y + size.y}};
    point_ = std::min(point_, int(tf.opacity.size()) - 1);
    color_ = std::min(color_, int(tf.color.size()) - 1);

    ImGui::InvisibleButton("tf-editor", size, ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    places.note_last("tf-editor");
    edit_opacity(tf, canvas);
    draw_curve(tf, window, canvas);
    edit_colors(tf, places);
    edit_window(tf, window, places);
    choose_scales(places);
    edit_numbers(tf, places);
}

void TransferFunctionEditor::edit_opacity(scene::TransferFunction& tf, const Canvas& canvas) {
    const ImVec2 mouse = ImGui::GetMousePos();
    const auto place = [&](const scene::OpacityPoint& point) {
        return ImVec2(canvas.x(scene::u_of_position(tf, point.position)),
                      canvas.y(height_of_opacity(scale_, point.opacity)));
    };
    int nearest = -1;
    for (int n = 0; n < int(tf.opacity.size()); ++n) {
        const float to_this = distance(place(tf.opacity[std::size_t(n)]), mouse);
        if (to_this <= reach && (nearest < 0 || to_this < distance(place(tf.opacity[std::size_t(nearest)]), mouse))) {
            nearest = n;
        }
    }
    const double u = std::clamp(double(mouse.x - canvas.low.x) / (canvas.high.x - canvas.low.x), 0.0, 1.0);
    const double height = double(canvas.high.y - mouse.y) / (canvas.high.y - canvas.low.y);
    if (ImGui::IsItemHovered() && ImGui::IsMouseClicked(0)) {
        point_ = nearest >= 0
                     ? nearest
                     : insert_sorted(tf.opacity, {scene::position_of_u(tf, u), opacity_of_height(scale_, height)});
        color_ = -1;
        grasping_ = true;
        grasp_ = place(tf.opacity[std::size_t(point_)]);
    }
    if (ImGui::IsItemHovered() && ImGui::IsMouseClicked(1) && nearest >= 0) {
        remove_point(tf.opacity, nearest);
        point_ = -1;
    }
    const bool free_for_keys = !ImGui::GetIO().WantTextInput;
    if (point_ >= 0 && free_for_keys && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Delete), false)) {
        remove_point(tf.opacity, point_);
    }
    grasping_ = grasping_ && ImGui::IsMouseDown(0);
    const ImVec2 moved = ImGui::GetIO().MouseDelta;
    if (grasping_ && point_ >= 0 && color_ < 0 && window_part_ < 0 && (moved.x != 0.0F || moved.y != 0.0F)) {
        follow_hand(grasp_);
        scene::OpacityPoint& point = tf.opacity[std::size_t(point_)];
        const double to_u = double(grasp_.x - canvas.low.x) / (canvas.high.x - canvas.low.x);
        point.position = clamped(scene::position_of_u(tf, to_u), between_neighbours(tf.opacity, point_, tf.domain));
        point.opacity = opacity_of_height(scale_, double(canvas.high.y - grasp_.y) / (canvas.high.y - canvas.low.y));
    }
    if (ImGui::IsItemHovered() && nearest >= 0 && !ImGui::IsAnyMouseDown()) {
        const scene::OpacityPoint& point = tf.opacity[std::size_t(nearest)];
        ImGui::SetTooltip("%.5g: opacity %.4g", point.position, point.opacity);
    }
}

void TransferFunctionEditor::draw_curve(const scene::TransferFunction& tf, std::array<double, 2> window,
                                        const Canvas& canvas) const {
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const ImVec2 corner{canvas.low.x - margin, canvas.low.y - 4.0F};
    const ImVec2 opposite{canvas.high.x + margin, canvas.high.y};
    draw->AddRectFilled(corner, opposite, IM_COL32(17, 18, 20, 255), 4.0F);
    draw->PushClipRect(corner, opposite, true);
    const int columns = std::max(1, int(canvas.high.x - canvas.low.x) / 2);
    const double value_width = window[1] - window[0];
    std::vector<ImVec2> curve;
    for (int n = 0; n <= columns; ++n) {
        const double u = double(n) / columns;
        const double next = double(n + 1) / columns;
        const float x0 = canvas.x(u);
        const float x1 = canvas.x(next);
        const auto [from, to] = std::minmax({window[0] + u * value_width, window[0] + next * value_width});
        const double count = histogram_.height(from, to, logarithmic_counts_);
        draw->AddRectFilled({x0, canvas.y(0.94 * count)}, {x1, canvas.high.y}, IM_COL32(74, 78, 86, 255));
        const float y = canvas.y(height_of_opacity(scale_, scene::opacity_at(tf, u)));
        draw->AddRectFilled({x0, y}, {x1, canvas.high.y}, display_color(scene::color_at(tf, u), 0.38F));
        curve.emplace_back(x0, y);
    }
    for (const double line : {0.001, 0.01, 0.1, 0.25, 0.5, 0.75}) {
        const bool fits = scale_ == OpacityScale::linear ? line >= 0.25 : line <= 0.1 || line == 0.5;
        if (fits) {
            const float y = canvas.y(height_of_opacity(scale_, line));
            char words[16];
            std::snprintf(words, sizeof words, "%g", line);
            draw->AddLine({canvas.low.x, y}, {canvas.high.x, y}, IM_COL32(255, 255, 255, 18));
            draw->AddText({canvas.low.x + 4.0F, y - ImGui::GetFontSize()}, IM_COL32(150, 155, 164, 110), words);
        }
    }
    draw->AddPolyline(curve.data(), int(curve.size()), IM_COL32(226, 230, 236, 255), 0, 1.6F);
    draw->PopClipRect();
    for (int n = 0; n < int(tf.opacity.size()); ++n) {
        const scene::OpacityPoint& point = tf.opacity[std::size_t(n)];
        const ImVec2 at{canvas.x(scene::u_of_position(tf, point.position)),
                        canvas.y(height_of_opacity(scale_, point.opacity))};
        const bool selected = n == point_;
        draw->AddCircleFilled(at, selected ? 6.0F : 4.5F,
                              selected ? ImGui::GetColorU32(theme::accent) : IM_COL32(226, 230, 236, 255));
        draw->AddCircle(at, selected ? 6.0F : 4.5F, IM_COL32(0, 0, 0, 255));
    }
}

void TransferFunctionEditor::edit_colors(scene::TransferFunction& tf, WidgetPlaces& places) {
    const float em = ImGui::GetFontSize();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::GetContentRegionAvail().x, 2.0F * em};
    const Canvas canvas{{low.x + margin, low.y}, {low.x + size.x - margin, low.y + 1.15F * em}};
    ImGui::InvisibleButton("tf-colors", size, ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    places.note_last("tf-colors");
    const ImVec2 mouse = ImGui::GetMousePos();
    const auto x_of = [&](int n) { return canvas.x(scene::u_of_position(tf, tf.color[std::size_t(n)].position)); };
    int nearest = -1;
    for (int n = 0; n < int(tf.color.size()); ++n) {
        if (std::abs(x_of(n) - mouse.x) <= reach &&
            (nearest < 0 || std::abs(x_of(n) - mouse.x) < std::abs(x_of(nearest) - mouse.x))) {
            nearest = n;
        }
    }
    const double u = std::clamp(double(mouse.x - canvas.low.x) / (canvas.high.x - canvas.low.x), 0.0, 1.0);
    if (ImGui::IsItemHovered() && ImGui::IsMouseClicked(0)) {
        color_ =
            nearest >= 0 ? nearest : insert_sorted(tf.color, {scene::position_of_u(tf, u), scene::color_at(tf, u)});
        point_ = -1;
        grasping_ = true;
        grasp_ = {x_of(color_), mouse.y};
        if (ImGui::IsMouseDoubleClicked(0)) {
            grasping_ = false;
            ImGui::OpenPopup("tf-picker");
        }
    }
    if (ImGui::IsItemHovered() && ImGui::IsMouseClicked(1) && nearest >= 0) {
        remove_point(tf.color, nearest);
        color_ = -1;
    }
    const bool free_for_keys = !ImGui::GetIO().WantTextInput;
    if (color_ >= 0 && free_for_keys && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Delete), false)) {
        remove_point(tf.color, color_);
    }
    if (grasping_ && color_ >= 0 && ImGui::GetIO().MouseDelta.x != 0.0F) {
        follow_hand(grasp_);
        scene::ColorPoint& point = tf.color[std::size_t(color_)];
        point.position =
            clamped(scene::position_of_u(tf, double(grasp_.x - canvas.low.x) / (canvas.high.x - canvas.low.x)),
                    between_neighbours(tf.color, color_, tf.domain));
    }
    if (ImGui::IsItemHovered() && !ImGui::IsAnyMouseDown()) {
        ImGui::SetTooltip(nearest >= 0 ? "double click: choose the colour" : "click: add a colour");
    }

    ImDrawList* draw = ImGui::GetWindowDrawList();
    const int columns = std::max(1, int(size.x) / 2);
    for (int n = 0; n < columns; ++n) {
        draw->AddRectFilled({canvas.x(double(n) / columns), canvas.low.y},
                            {canvas.x(double(n + 1) / columns), canvas.high.y},
                            display_color(scene::color_at(tf, (n + 0.5) / columns), 1.0F));
    }
    for (int n = 0; n < int(tf.color.size()); ++n) {
        const float x = x_of(n);
        const float y = canvas.high.y + 2.0F;
        const float half = 0.36F * em;
        const ImVec2 corners[3] = {{x, y - 4.0F}, {x - half, y + 0.65F * em}, {x + half, y + 0.65F * em}};
        draw->AddTriangleFilled(corners[0], corners[1], corners[2],
                                display_color(tf.color[std::size_t(n)].color, 1.0F));
        draw->AddTriangle(corners[0], corners[1], corners[2],
                          n == color_ ? ImGui::GetColorU32(theme::accent) : IM_COL32(210, 214, 220, 255), 1.5F);
    }
    pick_color(tf);
}

void TransferFunctionEditor::pick_color(scene::TransferFunction& tf) {
    if (!ImGui::BeginPopup("tf-picker")) {
        return;
    }
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) {
        ImGui::CloseCurrentPopup();
    }
    if (color_ >= 0) {
        glm::dvec3& linear = tf.color[std::size_t(color_)].color;
        float encoded[3];
        for (int n = 0; n < 3; ++n) {
            encoded[n] = float(srgb_of_linear(linear[n]));
        }
        if (ImGui::ColorPicker3("##picker", encoded,
                                ImGuiColorEditFlags_PickerHueWheel | ImGuiColorEditFlags_NoSidePreview)) {
            linear = linear_of_encoded(encoded);
        }
    }
    ImGui::EndPopup();
}

void TransferFunctionEditor::edit_window(scene::TransferFunction& tf, std::array<double, 2> window,
                                         WidgetPlaces& places) {
    const float em = ImGui::GetFontSize();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::GetContentRegionAvail().x, 1.9F * em};
    ImGui::InvisibleButton("tf-window", size);
    places.note_last("tf-window");
    const double smallest = histogram_.smallest();
    const double width = histogram_.largest() > smallest ? histogram_.largest() - smallest : 1.0;
    const Canvas canvas{{low.x + margin, low.y}, {low.x + size.x - margin, low.y + size.y}};
    const auto x_of = [&](double value) { return canvas.x(std::clamp((value - smallest) / width, 0.0, 1.0)); };
    const float ends[2] = {x_of(window[0]), x_of(window[1])};
    const float mouse = ImGui::GetMousePos().x;
    if (ImGui::IsItemActivated()) {
        const int nearer = std::abs(ends[0] - mouse) <= std::abs(ends[1] - mouse) ? 0 : 1;
        const auto [left, right] = std::minmax(ends[0], ends[1]);
        const bool inside = mouse > left + reach && mouse < right - reach;
        window_part_ = inside ? 2 : nearer;
    }
    if (!ImGui::IsItemActive()) {
        window_part_ = -1;
    }
    const ImGuiIO& io = ImGui::GetIO();
    if (window_part_ >= 0 && io.MouseDelta.x != 0.0F) {
        const double shift =
            width * double(io.MouseDelta.x) / (canvas.high.x - canvas.low.x) * (io.KeyShift ? fine_control : 1.0);
        std::array<double, 2> moved = window;
        moved[0] += window_part_ != 1 ? shift : 0.0;
        moved[1] += window_part_ != 0 ? shift : 0.0;
        const double narrowest = 1e-4 * width;
        if (moved[1] - moved[0] >= narrowest) {
            tf.window = moved;
        }
    }
    if (ImGui::IsItemHovered() && !ImGui::IsAnyMouseDown()) {
        ImGui::SetTooltip("all data from %.5g to %.5g; drag the ends of the window, or the window", smallest,
                          smallest + width);
    }
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(low, {low.x + size.x, low.y + size.y}, IM_COL32(17, 18, 20, 255), 3.0F);
    const int columns = std::max(1, int(canvas.high.x - canvas.low.x) / 2);
    for (int n = 0; n < columns; ++n) {
        const double from = smallest + width * n / columns;
        const double to = smallest + width * (n + 1) / columns;
        draw->AddRectFilled(
            {canvas.x(double(n) / columns), canvas.y(0.9 * histogram_.height(from, to, logarithmic_counts_))},
            {canvas.x(double(n + 1) / columns), canvas.high.y}, IM_COL32(84, 88, 96, 255));
    }
    draw->AddRectFilled({ends[0], low.y}, {ends[1], low.y + size.y}, ImGui::GetColorU32({0.36F, 0.66F, 0.80F, 0.16F}));
    for (const float x : ends) {
        draw->AddRectFilled({x - 2.5F, low.y}, {x + 2.5F, low.y + size.y}, ImGui::GetColorU32(theme::accent), 2.0F);
    }
}

void TransferFunctionEditor::choose_scales(WidgetPlaces& places) {
    int scale = int(scale_);
    ImGui::SetNextItemWidth(9.5F * ImGui::GetFontSize());
    ImGui::Combo("opacity", &scale, "linear\0near 0: root\0near 0: log\0");
    places.note_last("tf-scale");
    scale_ = OpacityScale(scale);
    tooltip("the scale of the opacity axis: the stretched ones let a hand set 0.001");
    ImGui::SameLine();
    ImGui::Checkbox("log counts", &logarithmic_counts_);
    tooltip("histogram by the logarithm of the counts");
}

void TransferFunctionEditor::edit_numbers(scene::TransferFunction& tf, WidgetPlaces& places) {
    const float half = 0.5F * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    if (point_ >= 0) {
        scene::OpacityPoint& point = tf.opacity[std::size_t(point_)];
        double position = point.position;
        double opacity = point.opacity;
        ImGui::SetNextItemWidth(half);
        if (ImGui::InputDouble("##position", &position, 0.0, 0.0, "at %.6g")) {
            point.position = clamped(position, between_neighbours(tf.opacity, point_, tf.domain));
        }
        note_number_box(false);
        tooltip("position of the selected point in the transfer function's domain");
        ImGui::SameLine();
        ImGui::SetNextItemWidth(half);
        if (ImGui::InputDouble("##opacity", &opacity, 0.0, 0.0, "opacity %.6g")) {
            point.opacity = std::clamp(opacity, 0.0, 1.0);
        }
        note_number_box(false);
        places.note_last("tf-point-opacity");
        tooltip("share of the light lost over the reference length");
    } else if (color_ >= 0) {
        scene::ColorPoint& point = tf.color[std::size_t(color_)];
        double position = point.position;
        ImGui::SetNextItemWidth(0.7F * half);
        if (ImGui::InputDouble("##position", &position, 0.0, 0.0, "at %.6g")) {
            point.position = clamped(position, between_neighbours(tf.color, color_, tf.domain));
        }
        note_number_box(false);
        ImGui::SameLine();
        ImGui::SetNextItemWidth(1.3F * half);
        edit_color("##color", point.color);
    } else {
        ImGui::TextDisabled("Click the curve or the colours to add a point.");
    }
}

}  // namespace bruma::app
