#pragma once
#include <string>
#include <string_view>

namespace bruma::io {

/// Whether a name means a volume or scene made by code, as in "builtin:bucky".
bool is_builtin(std::string_view file);
/// The part behind "builtin:".
std::string builtin_name(std::string_view file);

}  // namespace bruma::io
