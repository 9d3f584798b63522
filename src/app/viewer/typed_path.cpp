#include "app/viewer/typed_path.h"

#include <pwd.h>

#include <charconv>
#include <cstdlib>
#include <filesystem>

namespace bruma::app {
namespace {

std::string trimmed(const std::string& text) {
    constexpr const char* blanks = " \t\r\n";
    const std::size_t first = text.find_first_not_of(blanks);
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string unquoted(const std::string& text) {
    const bool quoted =
        text.size() >= 2 && text.front() == text.back() && (text.front() == '\'' || text.front() == '"');
    return quoted ? text.substr(1, text.size() - 2) : text;
}

/// %41 becomes A (RFC 3986); a percent sign that no two hexadecimal digits follow stays.
std::string percent_decoded(const std::string& text) {
    std::string decoded;
    for (std::size_t n = 0; n < text.size(); ++n) {
        unsigned byte = 0;
        const char* digits = text.data() + n + 1;
        const bool is_code = text[n] == '%' && n + 2 < text.size() &&
                             std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2 && byte != 0;
        decoded += is_code ? char(byte) : text[n];
        n += is_code ? 2 : 0;
    }
    return decoded;
}

/// The path of a file:// URL (RFC 8089) on this machine; other texts are left as they are.
std::string without_scheme(const std::string& text) {
    constexpr std::string_view scheme = "file:";
    std::string opening = text.substr(0, scheme.size());
    for (char& c : opening) {
        c = char(std::tolower(static_cast<unsigned char>(c)));
    }
    if (opening != scheme) {
        return text;
    }
    std::string rest = text.substr(scheme.size());
    if (rest.starts_with("//")) {
        const std::size_t path = rest.find('/', 2);
        const std::string host = rest.substr(2, path == std::string::npos ? path : path - 2);
        if (path == std::string::npos || !(host.empty() || host == "localhost")) {
            return text;
        }
        rest = rest.substr(path);
    }
    return rest.starts_with("/") ? percent_decoded(rest) : text;
}

std::string with_home(const std::string& text) {
    if (!text.starts_with("~")) {
        return text;
    }
    const std::size_t end = std::min(text.find('/'), text.size());
    const std::string name = text.substr(1, end - 1);
    const char* home = name.empty() ? std::getenv("HOME") : nullptr;
    if (!name.empty()) {
        const passwd* person = ::getpwnam(name.c_str());
        home = person != nullptr ? person->pw_dir : nullptr;
    }
    return home != nullptr ? home + text.substr(end) : text;
}

}  // namespace

std::string typed_path(const std::string& typed) {
    std::error_code error;
    if (std::filesystem::exists(typed, error)) {
        return typed;
    }
    return with_home(without_scheme(unquoted(trimmed(typed))));
}

}  // namespace bruma::app
