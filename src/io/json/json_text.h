#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"

namespace bruma::io {

/// Levels of brackets within brackets that are read: a scene needs six.
constexpr int most_levels_of_json = 100;

/// A text that is no JSON, as against one that asks for too much.
class BrokenJson : public InputError {
  public:
    using InputError::InputError;
};

/// JSON for people: two blanks of indent, short arrays on one line, numbers as short as they are exact, a newline at
/// the end. Throws InputError that names the first text that is not UTF-8, since it could not be
/// read back.
std::string json_text(const nlohmann::json& document);

/// JSON that reports, as statistics do: what is not UTF-8, such as a file's name, stands there with replacement
/// characters. `indent` below 0: one line. No newline at the end.
std::string report_text(const nlohmann::json& document, int indent);

/// JSON of a text; whatever becomes JSON comes through here. A fault is told as NAME:line:column with what was found
/// and expected, as BrokenJson; a key given twice in one object and more than `most_levels_of_json` levels are faults
/// too. Throws InputError only. `name` is the file's name or an option.
nlohmann::json parse_json(const std::string& text, const std::string& name);

}  // namespace bruma::io
