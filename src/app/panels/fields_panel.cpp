#include "app/panels/fields_panel.h"

#include <fmt/core.h>
#include <imgui/imgui.h>
#include <imgui/imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "app/panels/number_boxes.h"
#include "io/picture/picture_file.h"

namespace bruma::app {
namespace {

struct Shown {
    double factor = 1.0;  ///< shown value = stored value * factor
    std::string unit;
};
Shown shown(const Field& field) {
    if (field.unit == "m" && field.panel_max < 100.0) {
        return {1e3, " mm"};
    }
    return {1.0, field.unit.empty() ? std::string() : fmt::format(" {}", field.unit)};
}

std::string label_of(const Field& field) {
    return readable(field.name) + "##" + std::string(field.name);
}

/// Widgets leave a steady share of the line to their labels.
void narrow() {
    ImGui::SetNextItemWidth(0.56F * ImGui::GetContentRegionAvail().x);
}

double clamped(const Field& field, double value) {
    return std::clamp(value, field.min, field.max);
}

/// Numbers without a slider: a hundred pixels of drag about double them.
float drag_speed(double largest) {
    return float(std::max(0.01 * std::abs(largest), 1e-3));
}

}  // namespace

std::string readable(std::string_view name) {
    std::string words(name);
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
}

bool is_for_another_word(std::string_view sentence, std::span<const std::string_view> words, std::size_t chosen) {
    std::string_view opening = sentence.substr(0, sentence.find(':'));
    if (opening.size() == sentence.size()) {
        return false;
    }
    for (bool is_last = false; !is_last;) {
        const std::size_t comma = opening.find(", ");
        const std::string_view word = opening.substr(0, comma);
        const auto found = std::find(words.begin(), words.end(), word);
        if (found == words.end() || std::size_t(found - words.begin()) == chosen) {
            return false;
        }
        is_last = comma == std::string_view::npos;
        opening.remove_prefix(is_last ? opening.size() : comma + 2);
    }
    return true;
}

void tooltip(std::string_view words) {
    if (!words.empty() && ImGui::IsItemHovered() && !ImGui::IsAnyMouseDown()) {
        ImGui::BeginTooltip();
        ImGui::PushTextWrapPos(22.0F * ImGui::GetFontSize());
        ImGui::TextUnformatted(words.data(), words.data() + words.size());
        ImGui::PopTextWrapPos();
        ImGui::EndTooltip();
    }
}

bool edit_value(const Field& field, bool& value) {
    const bool changed = ImGui::Checkbox(label_of(field).c_str(), &value);
    tooltip(field.sentence);
    return changed;
}

bool edit_value(const Field& field, double& value) {
    const auto [factor, unit] = shown(field);
    double number = value * factor;
    bool changed = false;
    narrow();
    if (field.panel_min != field.panel_max) {
        const double low = field.panel_min * factor;
        const double high = field.panel_max * factor;
        const ImGuiSliderFlags flags = field.logarithmic ? ImGuiSliderFlags_Logarithmic : 0;
        const std::string format = (field.logarithmic ? "%.4g" : field.unit == "deg" ? "%.1f" : "%.3f") + unit;
        changed = ImGui::SliderScalar(label_of(field).c_str(), ImGuiDataType_Double, &number, &low, &high,
                                      format.c_str(), flags);
    } else {
        changed = ImGui::DragScalar(label_of(field).c_str(), ImGuiDataType_Double, &number, drag_speed(number), nullptr,
                                    nullptr, ("%.5g" + unit).c_str());
    }
    tooltip(field.sentence);
    if (changed) {
        value = clamped(field, number / factor);
    }
    return changed;
}

bool edit_value(const Field& field, std::int64_t& value) {
    narrow();
    bool changed = false;
    if (field.panel_min != field.panel_max) {
        const auto low = std::int64_t(field.panel_min);
        const auto high = std::int64_t(field.panel_max);
        changed = ImGui::SliderScalar(label_of(field).c_str(), ImGuiDataType_S64, &value, &low, &high);
    } else {
        changed = ImGui::InputScalar(label_of(field).c_str(), ImGuiDataType_S64, &value);
    }
    note_number_box(true);
    tooltip(field.sentence);
    if (changed) {
        value = std::int64_t(std::clamp(double(value), std::max(field.min, -9e18), std::min(field.max, 9e18)));
    }
    return changed;
}

bool edit_value(const Field& field, std::string& value) {
    narrow();
    const bool changed = ImGui::InputText(label_of(field).c_str(), &value);
    tooltip(field.sentence);
    return changed;
}

double srgb_of_linear(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

glm::dvec3 linear_of_encoded(const float* encoded) {
    glm::dvec3 linear;
    for (int n = 0; n < 3; ++n) {
        const double e = std::max(0.0F, encoded[n]);
        // The curve of io stops at 1; lights may be brighter.
        linear[n] = e <= 1.0 ? io::linear_of_srgb(e) : std::pow((e + 0.055) / 1.055, 2.4);
    }
    return linear;
}

bool edit_color(const char* label, glm::dvec3& linear) {
    float encoded[3];
    for (int n = 0; n < 3; ++n) {
        encoded[n] = float(srgb_of_linear(linear[n]));
    }
    const bool changed = ImGui::ColorEdit3(label, encoded, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR);
    if (changed) {
        linear = linear_of_encoded(encoded);
    }
    return changed;
}

bool edit_value(const Field& field, glm::dvec3& value) {
    narrow();
    if (field.is_color) {
        const bool changed = edit_color(label_of(field).c_str(), value);
        tooltip(std::string(field.sentence) + "; the numbers shown are sRGB");
        return changed;
    }
    const auto [factor, unit] = shown(field);
    glm::dvec3 numbers = value * factor;
    bool changed = false;
    if (field.panel_min != field.panel_max) {
        const double low = field.panel_min * factor;
        const double high = field.panel_max * factor;
        changed =
            ImGui::SliderScalarN(label_of(field).c_str(), ImGuiDataType_Double, &numbers.x, 3, &low, &high, "%.3g");
    } else {
        const double largest = std::max({std::abs(numbers.x), std::abs(numbers.y), std::abs(numbers.z)});
        changed = ImGui::DragScalarN(label_of(field).c_str(), ImGuiDataType_Double, &numbers.x, 3, drag_speed(largest),
                                     nullptr, nullptr, "%.4g");
    }
    tooltip(std::string(field.sentence) + (unit.empty() ? "" : " (in" + unit + ")"));
    if (changed) {
        for (int n = 0; n < 3; ++n) {
            value[n] = clamped(field, numbers[n] / factor);
        }
    }
    return changed;
}

bool edit_direction(glm::dvec3& direction) {
    const glm::dvec3 unit = glm::normalize(direction);
    double azimuth_deg = glm::degrees(std::atan2(unit.x, unit.z));
    double elevation_deg = glm::degrees(std::asin(std::clamp(unit.y, -1.0, 1.0)));
    bool changed = edit_value({.name = "azimuth",
                               .unit = "deg",
                               .sentence = "where the light comes from: 0 is +z, 90 is +x",
                               .panel_min = -180.0,
                               .panel_max = 180.0},
                              azimuth_deg);
    // Short of the poles, where no azimuth could be told from the direction.
    changed = edit_value({.name = "elevation",
                          .unit = "deg",
                          .sentence = "height of the light above the horizon; 90 is +y",
                          .min = -89.9,
                          .max = 89.9,
                          .panel_min = -89.9,
                          .panel_max = 89.9},
                         elevation_deg) ||
              changed;
    if (changed) {
        const double azimuth = glm::radians(azimuth_deg), elevation = glm::radians(elevation_deg);
        direction = {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                     std::cos(elevation) * std::cos(azimuth)};
    }
    return changed;
}

bool edit_value(const Field& field, glm::ivec3& value) {
    narrow();
    const bool changed = ImGui::InputScalarN(label_of(field).c_str(), ImGuiDataType_S32, &value.x, 3);
    note_number_box(true);
    tooltip(field.sentence);
    if (changed) {
        for (int n = 0; n < 3; ++n) {
            value[n] = int(std::clamp(double(value[n]), std::max(field.min, -2e9), std::min(field.max, 2e9)));
        }
    }
    return changed;
}

bool edit_value(const Field& field, std::array<double, 2>& value) {
    narrow();
    const bool changed = ImGui::DragScalarN(label_of(field).c_str(), ImGuiDataType_Double, value.data(), 2,
                                            drag_speed(value[1] - value[0]), nullptr, nullptr, "%.5g");
    tooltip(field.sentence);
    return changed;
}

bool edit_word(const Field& field, std::span<const std::string_view> words, std::size_t& index) {
    bool changed = false;
    narrow();
    if (ImGui::BeginCombo(label_of(field).c_str(), readable(words[index]).c_str())) {
        for (std::size_t n = 0; n < words.size(); ++n) {
            if (ImGui::Selectable(readable(words[n]).c_str(), n == index) && n != index) {
                index = n;
                changed = true;
            }
        }
        ImGui::EndCombo();
    }
    tooltip(field.sentence);
    return changed;
}

}  // namespace bruma::app
