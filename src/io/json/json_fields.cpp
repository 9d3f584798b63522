#include "io/json/json_fields.h"

#include <fmt/core.h>

#include <cmath>

#include "base/error.h"
#include "base/nearest_name.h"

namespace bruma::io {
namespace {

/// A value as it stands in the file, cut to a length that fits a sentence.
std::string shown(const json& value) {
    constexpr std::size_t most = 60;
    // Composite values are named and not printed: a message must not carry a thousand control points.
    if (value.is_object()) {
        return fmt::format("an object of {} keys", value.size());
    }
    if (value.is_array() && value.size() > 8) {
        return fmt::format("an array of {} parts", value.size());
    }
    std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
    if (text.size() > most) {
        text.resize(most);
        text += "...";
    }
    return text;
}

[[noreturn]] void throw_expected(const json& found, const std::string& where, std::string_view expected) {
    throw InputError(fmt::format("{}: found {}, expected {}", where, shown(found), expected));
}

double number(const json& from, const Field& field, const std::string& where) {
    if (!from.is_number()) {
        throw_expected(from, where, fmt::format("a number{}{}", field.unit.empty() ? "" : " in ", field.unit));
    }
    const auto value = from.get<double>();
    if (!std::isfinite(value)) {
        throw_expected(from, where, "a finite number");
    }
    if (value < field.min) {
        throw InputError(fmt::format("{}: {} is below {}, the smallest accepted", where, value, field.min));
    }
    if (value > field.max) {
        throw InputError(fmt::format("{}: {} is above {}, the largest accepted", where, value, field.max));
    }
    return value;
}

std::int64_t whole_number(const json& from, const Field& field, const std::string& where, std::int64_t most) {
    const double value = number(from, field, where);
    const bool fits = std::abs(value) <= double(most);
    if (!from.is_number_integer() || !fits) {
        throw_expected(from, where, fits ? "a whole number" : fmt::format("a whole number of at most {}", most));
    }
    // 2^63 - 1 rounds up to 2^63 as a double, so the last step is compared as integers.
    if (from.is_number_unsigned() && from.get<std::uint64_t>() > std::uint64_t(most)) {
        throw_expected(from, where, fmt::format("a whole number of at most {}", most));
    }
    return from.get<std::int64_t>();
}

void require_array(const json& from, const std::string& where, std::size_t parts, std::string_view meaning) {
    if (!from.is_array() || from.size() != parts) {
        throw_expected(from, where, fmt::format("an array of {} numbers, {}", parts, meaning));
    }
}

std::string part(const std::string& where, std::size_t index) {
    return fmt::format("{}.{}", where, index);
}

/// Control points as arrays of position and `parts - 1` numbers, each in [0, most].
template <class Point, class Make>
void read_points(const json& from, const std::string& where, std::size_t parts, std::string_view meaning, double most,
                 std::vector<Point>& value, Make make) {
    constexpr std::size_t most_points = 65536;
    if (!from.is_array() || from.size() > most_points) {
        throw_expected(from, where, fmt::format("an array of at most {} control points {}", most_points, meaning));
    }
    std::vector<Point> points;
    points.reserve(from.size());
    for (std::size_t n = 0; n < from.size(); ++n) {
        const std::string here = part(where, n);
        require_array(from[n], here, parts, meaning);
        std::array<double, 4> numbers{};
        numbers[0] = number(from[n][0], Field{}, part(here, 0));
        for (std::size_t i = 1; i < parts; ++i) {
            numbers[i] = number(from[n][i], Field{.min = 0.0, .max = most}, part(here, i));
        }
        points.push_back(make(numbers));
    }
    value = std::move(points);
}

}  // namespace

json json_of(bool value) {
    return value;
}
json json_of(double value) {
    return value;
}
json json_of(std::int64_t value) {
    return value;
}
json json_of(const std::string& value) {
    return value;
}
json json_of(glm::ivec3 value) {
    return json::array({value.x, value.y, value.z});
}
json json_of(glm::dvec3 value) {
    return json::array({value.x, value.y, value.z});
}
json json_of(const std::array<double, 2>& value) {
    return json::array({value[0], value[1]});
}

json json_of(const std::vector<scene::OpacityPoint>& value) {
    json points = json::array();
    for (const scene::OpacityPoint& point : value) {
        points.push_back(json::array({point.position, point.opacity}));
    }
    return points;
}
json json_of(const std::vector<scene::ColorPoint>& value) {
    json points = json::array();
    for (const scene::ColorPoint& point : value) {
        points.push_back(json::array({point.position, point.color.r, point.color.g, point.color.b}));
    }
    return points;
}
json json_of(const std::vector<scene::EmissionPoint>& value) {
    json points = json::array();
    for (const scene::EmissionPoint& point : value) {
        points.push_back(json::array({point.position, point.emission}));
    }
    return points;
}

void read_value(const json& from, const Field&, const std::string& where, bool& value) {
    if (!from.is_boolean()) {
        throw_expected(from, where, "true or false");
    }
    value = from.get<bool>();
}
void read_value(const json& from, const Field& field, const std::string& where, double& value) {
    value = number(from, field, where);
}
void read_value(const json& from, const Field& field, const std::string& where, std::int64_t& value) {
    value = whole_number(from, field, where, std::numeric_limits<std::int64_t>::max());
}
void read_value(const json& from, const Field&, const std::string& where, std::string& value) {
    if (!from.is_string()) {
        throw_expected(from, where, "a text in quotes");
    }
    value = from.get<std::string>();
}
void read_value(const json& from, const Field& field, const std::string& where, glm::ivec3& value) {
    require_array(from, where, 3, "along x, y, z");
    glm::ivec3 read(0);
    for (int axis = 0; axis < 3; ++axis) {
        read[axis] = int(whole_number(from[std::size_t(axis)], field, part(where, std::size_t(axis)),
                                      std::numeric_limits<int>::max()));
    }
    value = read;
}
void read_value(const json& from, const Field& field, const std::string& where, glm::dvec3& value) {
    require_array(from, where, 3, field.is_color ? "red, green, blue" : "along x, y, z");
    glm::dvec3 read(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        read[axis] = number(from[std::size_t(axis)], field, part(where, std::size_t(axis)));
    }
    value = read;
}
void read_value(const json& from, const Field& field, const std::string& where, std::array<double, 2>& value) {
    require_array(from, where, 2, "from and to");
    value = {number(from[0], field, part(where, 0)), number(from[1], field, part(where, 1))};
}
void read_value(const json& from, const Field&, const std::string& where, std::vector<scene::OpacityPoint>& value) {
    read_points(from, where, 2, "[position, opacity]", 1.0, value, [](const auto& n) {
        return scene::OpacityPoint{n[0], n[1]};
    });
}
void read_value(const json& from, const Field&, const std::string& where, std::vector<scene::ColorPoint>& value) {
    read_points(from, where, 4, "[position, red, green, blue]", 1e6, value, [](const auto& n) {
        return scene::ColorPoint{n[0], glm::dvec3(n[1], n[2], n[3])};
    });
}
void read_value(const json& from, const Field&, const std::string& where, std::vector<scene::EmissionPoint>& value) {
    read_points(from, where, 2, "[position, strength]", 1e9, value, [](const auto& n) {
        return scene::EmissionPoint{n[0], n[1]};
    });
}

std::size_t read_word(const json& from, const std::string& where, std::span<const std::string_view> words) {
    const std::vector<std::string> known(words.begin(), words.end());
    if (!from.is_string()) {
        throw_expected(from, where, fmt::format("a word{}", suggestion("", known)));
    }
    const auto& word = from.get_ref<const std::string&>();
    const auto found =
        std::find_if(known.begin(), known.end(), [&](const std::string& each) { return same_word(each, word); });
    if (found == known.end()) {
        throw InputError(fmt::format("{}: unknown word '{}'{}", where, word, suggestion(word, known)));
    }
    return std::size_t(found - known.begin());
}

void require_object(const json& from, const std::string& where) {
    if (!from.is_object()) {
        throw_expected(from,
                       where.empty()          ? "the whole"
                       : where.ends_with(':') ? where.substr(0, where.size() - 1)
                                              : where,
                       "an object {...}");
    }
}

void require_known_keys(const json& from, const std::string& where, const std::vector<std::string>& known) {
    for (const auto& [key, value] : from.items()) {
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            throw InputError(fmt::format("{}: unknown key{}", join_path(where, key), suggestion(key, known)));
        }
    }
}

void check_version(const json& document, const char* key, std::int64_t newest, const std::string& name) {
    const std::string prefix = name.empty() ? "" : name + ": ";
    const auto found = document.find(key);
    if (found == document.end()) {
        throw InputError(
            fmt::format("{}the key '{}' is missing at the top; expected \"{}\": {}", prefix, key, key, newest));
    }
    const std::int64_t version = whole_number(*found, Field{.min = 1.0}, prefix + key, 1'000'000'000);
    if (version > newest) {
        throw InputError(
            fmt::format("{}{} is {}, but this program reads up to {}; update it or save the file from an "
                        "older one",
                        prefix, key, version, newest));
    }
}

std::string join_path(const std::string& where, std::string_view key) {
    // "scene.json:" ends a file's name and takes a blank, a key takes a dot.
    const std::string_view between = where.empty() ? "" : where.back() == ':' ? " " : ".";
    std::string path = fmt::format("{}{}{}", where, between, key);
    // A key may hold control characters; a zero would end the sentence before it began.
    std::replace_if(
        path.begin(), path.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }, '?');
    return path;
}

}  // namespace bruma::io
