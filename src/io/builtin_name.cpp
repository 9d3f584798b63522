#include "io/builtin_name.h"

namespace bruma::io {
namespace {

constexpr std::string_view prefix = "builtin:";

}  // namespace

bool is_builtin(std::string_view file) {
    return file.starts_with(prefix);
}

std::string builtin_name(std::string_view file) {
    return std::string(file.substr(prefix.size()));
}

}  // namespace bruma::io
