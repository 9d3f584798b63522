#include "io/json/json_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <vector>

#include "base/error.h"

namespace bruma::io {
namespace {

using nlohmann::json;

void write_json(const json& value, std::size_t indent, std::string& text) {
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
        write_json(part, indent + 2, text);
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

/// Watches a parser for keys that an object has already, and for depth: whatever visits a document afterwards calls
/// itself once a level.
class ParserWatch {
  public:
    explicit ParserWatch(const std::string& name) : name_(name) {}
    bool operator()(int depth, json::parse_event_t event, json& parsed) {
        using Event = json::parse_event_t;
        if ((event == Event::object_start || event == Event::array_start) && depth >= most_levels_of_json) {
            throw InputError(fmt::format("{}: brackets stand {} deep, but at most {} are read; is it the right file?",
                                         name_, depth + 1, most_levels_of_json));
        }
        if (event == Event::object_start) {
            open_.emplace_back();
        } else if (event == Event::object_end) {
            open_.pop_back();
        } else if (event == Event::key && !open_.back().insert(parsed.get<std::string>()).second) {
            throw InputError(fmt::format("{}: the key '{}' is given twice in one object; remove one", name_,
                                         parsed.get<std::string>()));
        }
        return true;
    }

  private:
    std::string name_;
    std::vector<std::set<std::string>> open_;
};

/// What a library's message says behind its own name: "[json.exception.out_of_range.406] number overflow ..."
/// goes on with "number overflow".
std::string without_prefix(std::string text) {
    if (const std::size_t end = text.find("] "); text.starts_with('[') && end != std::string::npos) {
        text.erase(0, end + 2);
    }
    return text;
}

/// Where a byte of a text stands, "LINE:COLUMN" from 1.
std::string line_and_column(const std::string& text, std::size_t at) {
    const auto line = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n');
    const std::size_t line_end = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
    return fmt::format("{}:{}", line, at - (line_end == std::string::npos ? 0 : line_end + 1) + 1);
}

}  // namespace

std::string json_text(const json& document) {
    std::string text;
    try {
        write_json(document, 0, text);
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
        return json::parse(text, ParserWatch(name));
    } catch (const json::parse_error& error) {
        const std::size_t at = std::min(text.size(), error.byte == 0 ? 0 : error.byte - 1);
        // The library's text goes "[...] parse error at line L, column C: WHAT - FOUND; expected WHAT".
        std::string what = without_prefix(error.what());
        if (const std::size_t colon = what.find(": "); colon != std::string::npos) {
            what.erase(0, colon + 2);
        }
        throw BrokenJson(fmt::format("{}:{}: broken JSON, {}", name, line_and_column(text, at), what));
    } catch (const json::exception& error) {
        throw BrokenJson(fmt::format("{}: JSON that cannot be used, {}", name, without_prefix(error.what())));
    }
}

}  // namespace bruma::io
