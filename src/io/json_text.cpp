#include "io/json_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <vector>

#include "base/error.h"

namespace bruma::io {
namespace {

using nlohmann::json;

void write(const json& value, std::size_t indent, std::string& text) {
    constexpr std::size_t longest_line = 100;
    const std::string inner(indent + 2, ' ');
    const bool holds_objects =
        value.is_object() || std::any_of(value.begin(), value.end(), [](const json& part) { return part.is_object(); });
    const std::string on_one_line = holds_objects && !value.empty() ? std::string() : value.dump();
    if (!value.is_structured() || value.empty() || (!on_one_line.empty() && on_one_line.size() < longest_line)) {
        text += on_one_line;
        return;
    }
    text += value.is_object() ? "{\n" : "[\n";
    bool first = true;
    for (const auto& [key, part] : value.items()) {
        text += fmt::format("{}{}{}", first ? "" : ",\n", inner, value.is_object() ? json(key).dump() + ": " : "");
        write(part, indent + 2, text);
        first = false;
    }
    text += fmt::format("\n{:{}}{}", "", indent, value.is_object() ? '}' : ']');
}

bool is_utf8(const std::string& text) {
    try {
        json(text).dump();
        return true;
    } catch (const json::exception&) {
        return false;
    }
}

/// The first key or text that is not UTF-8; empty when all are.
std::string first_not_utf8(const json& value) {
    if (value.is_string()) {
        const auto text = value.get<std::string>();
        return is_utf8(text) ? "" : text;
    }
    for (const auto& [key, part] : value.items()) {
        if (value.is_object() && !is_utf8(key)) {
            return key;
        }
        if (part.is_structured() || part.is_string()) {
            if (std::string found = first_not_utf8(part); !found.empty()) {
                return found;
            }
        }
    }
    return {};
}

/// Watches a parser for keys that an object has already.
class TwiceGivenKeys {
  public:
    explicit TwiceGivenKeys(const std::string& name) : name_(name) {}
    bool operator()(int, json::parse_event_t event, json& parsed) {
        if (event == json::parse_event_t::object_start) {
            open_.emplace_back();
        } else if (event == json::parse_event_t::object_end) {
            open_.pop_back();
        } else if (event == json::parse_event_t::key && !open_.back().insert(parsed.get<std::string>()).second) {
            throw InputError(fmt::format("{}: the key '{}' is given twice in one object; remove one", name_,
                                         parsed.get<std::string>()));
        }
        return true;
    }

  private:
    std::string name_;
    std::vector<std::set<std::string>> open_;
};

}  // namespace

std::string json_text(const json& document) {
    std::string text;
    try {
        write(document, 0, text);
    } catch (const json::exception&) {
        throw InputError(fmt::format("'{}': is not UTF-8, so that no JSON can name it; rename the file in UTF-8",
                                     first_not_utf8(document)));
    }
    return text + "\n";
}

std::string report_text(const json& document, int indent) {
    return document.dump(indent, ' ', false, json::error_handler_t::replace);
}

json parse_json(const std::string& text, const std::string& name) {
    try {
        return json::parse(text, TwiceGivenKeys(name));
    } catch (const json::parse_error& error) {
        const std::size_t at = std::min(text.size(), error.byte == 0 ? 0 : error.byte - 1);
        const auto line = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n');
        const std::size_t line_end = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
        const std::size_t column = at - (line_end == std::string::npos ? 0 : line_end + 1) + 1;
        // The library's text goes "[...] parse error at line L, column C: WHAT - FOUND; expected WHAT".
        std::string what = error.what();
        if (const std::size_t colon = what.find(": "); colon != std::string::npos) {
            what.erase(0, colon + 2);
        }
        throw InputError(fmt::format("{}:{}:{}: broken JSON, {}", name, line, column, what));
    } catch (const json::exception& error) {
        throw InputError(fmt::format("{}: JSON that cannot be used, {}", name, error.what()));
    }
}

}  // namespace bruma::io
