#pragma once
#include <limits>
#include <span>
#include <string_view>

/// The one table of parameters.
///
/// Every editable struct of the scene has a function `visit_fields(T&, Visitor&)` that shows each of its fields once:
///
///     visit(Field{"eye", "m", "where the camera stands"}, camera.eye_world);
///
/// Scene files, `--set`, the viewer's panels and `bruma help scene` are visitors of this table, so a parameter is
/// written down in one place only: name, unit, meaning and range.
namespace bruma::scene {

struct Field {
    std::string_view name = {};                             ///< key in scene files and last word of a --set path
    std::string_view unit = {};                             ///< SI unit as shown to people; empty for pure numbers
    std::string_view sentence = {};                         ///< what it does, one sentence, for help and tooltips
    double min = -std::numeric_limits<double>::infinity();  ///< smallest value accepted
    double max = std::numeric_limits<double>::infinity();   ///< largest value accepted
    double panel_min = 0.0;                                 ///< slider range in panels; equal ends mean a drag field
    double panel_max = 0.0;
    bool logarithmic = false;  ///< slider moves in equal ratios
    bool is_color = false;     ///< three numbers are linear Rec.709 red, green, blue
};

/// The words of an enumeration as they stand in files and menus, in the order of its values. Each enum that occurs in
/// a field specialises this.
template <class Enum>
std::span<const std::string_view> enum_words();

}  // namespace bruma::scene
