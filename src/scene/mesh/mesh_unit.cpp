#include "scene/mesh/mesh_unit.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

namespace bruma::scene {
namespace {

/// Millimetres of a word such as "cm" or "Meters"; 0 for other words.
double unit_word_mm(std::string_view word) {
    static constexpr std::array<std::pair<std::string_view, double>, 23> known{
        {{"m", 1e3},          {"meter", 1e3},       {"meters", 1e3},       {"metre", 1e3},       {"metres", 1e3},
         {"cm", 10.0},        {"centimeter", 10.0}, {"centimeters", 10.0}, {"centimetre", 10.0}, {"centimetres", 10.0},
         {"mm", 1.0},         {"millimeter", 1.0},  {"millimeters", 1.0},  {"millimetre", 1.0},  {"millimetres", 1.0},
         {"inch", 25.4},      {"inches", 25.4},     {"foot", 304.8},       {"feet", 304.8},      {"km", 1e6},
         {"kilometers", 1e6}, {"um", 1e-3},         {"micrometers", 1e-3}}};
    for (const auto& [name, millimetres] : known) {
        if (word == name) {
            return millimetres;
        }
    }
    return 0.0;
}

std::string_view next_word(std::string_view& text) {
    const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
    while (!text.empty() && !is_letter(text.front())) {
        text.remove_prefix(1);
    }
    std::size_t length = 0;
    while (length < text.size() && is_letter(text[length])) {
        ++length;
    }
    const std::string_view word = text.substr(0, length);
    text.remove_prefix(length);
    return word;
}

}  // namespace

UnitLength proposed_unit(double longest_side) {
    if (!(longest_side > 0.0) || !std::isfinite(longest_side)) {
        return {1.0, "the default", true};
    }
    if (longest_side >= 9.5 && longest_side <= 2100.0) {
        return {1.0,
                fmt::format("proposed: plausible as millimetres, the longest side is then {:.4g} mm", longest_side),
                true};
    }
    const double exponent = std::clamp(std::round(2.0 - std::log10(longest_side)), -12.0, 12.0);
    const double millimetres = std::pow(10.0, exponent);
    return {millimetres, fmt::format("proposed: the longest side is then {:.3g} mm", millimetres * longest_side), true};
}

double commented_unit_mm(std::string_view head) {
    while (!head.empty()) {
        const std::size_t end = std::min(head.find_first_of("\r\n"), head.size());
        std::string line(head.substr(0, end));
        head.remove_prefix(std::min(end + 1, head.size()));
        if (line.find('#') != line.find_first_not_of(" \t")) {
            continue;
        }
        for (char& c : line) {
            c = char(std::tolower(static_cast<unsigned char>(c)));
        }
        // The word 'unit' or 'units', then the name of one within the same comment.
        bool about_units = false;
        for (std::string_view rest = line; !rest.empty();) {
            const std::string_view word = next_word(rest);
            if (about_units && unit_word_mm(word) > 0.0) {
                return unit_word_mm(word);
            }
            about_units = about_units || word == "unit" || word == "units";
        }
    }
    return 0.0;
}

}  // namespace bruma::scene
