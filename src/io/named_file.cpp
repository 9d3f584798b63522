#include "io/named_file.h"

#include <algorithm>

#include "io/mesh/mtl_text.h"

namespace bruma::io {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

bool is_there(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

/// What a folder holds by this name, capitals aside; the first in alphabetical order. Empty: nothing.
fs::path entry_by_any_capitals(const fs::path& folder, const fs::path& name) {
    if (is_there(folder / name)) {
        return folder / name;
    }
    fs::path found;
    std::error_code failed;
    for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
        const fs::path& entry = at->path();
        if (is_same_keyword(entry.filename().native(), name.native()) && (found.empty() || entry < found)) {
            found = entry;
        }
    }
    return found;
}

fs::path file_by_any_capitals(fs::path folder, std::span<const fs::path> steps) {
    for (const fs::path& step : steps) {
        folder = entry_by_any_capitals(folder, step);
        if (folder.empty()) {
            return {};
        }
    }
    return is_file(folder) ? folder : fs::path();
}

}  // namespace

std::vector<fs::path> folders_beside(const fs::path& file) {
    std::vector<fs::path> folders{file.parent_path()};
    std::error_code failed;
    const fs::path real = fs::canonical(file, failed).parent_path();
    if (!failed && real != fs::weakly_canonical(folders.front().empty() ? "." : folders.front(), failed)) {
        folders.push_back(real);
    }
    return folders;
}

fs::path path_of_name(std::string name) {
    name.erase(0, std::min(name.find_first_not_of(" \t\r"), name.size()));
    name.erase(name.find_last_not_of(" \t\r") + 1);
    if (name.size() >= 2 && (name.front() == '"' || name.front() == '\'') && name.back() == name.front()) {
        name = name.substr(1, name.size() - 2);
    }
    if (name.starts_with("file://")) {
        name.erase(0, 7);
    }
    std::string plain;
    for (std::size_t n = 0; n < name.size(); ++n) {
        if (name[n] != '\\') {
            plain += name[n];
        } else if (n + 1 == name.size() || name[n + 1] != ' ') {
            plain += '/';
        }
    }
    return plain;
}

NamedFile find_as_named(const std::string& name, std::span<const fs::path> folders) {
    const fs::path path = path_of_name(name);
    for (const fs::path& folder : folders) {
        if (!path.empty() && is_file(folder / path)) {  // an absolute path leaves no folder before it
            return {folder / path, true};
        }
    }
    return {};
}

NamedFile find_named_file(const std::string& name, std::span<const fs::path> folders) {
    if (NamedFile found = find_as_named(name, folders)) {
        return found;
    }
    const fs::path path = path_of_name(name);
    std::vector<fs::path> steps;
    for (const fs::path& step : path.relative_path()) {
        if (!step.empty() && step != ".") {
            steps.push_back(step);
        }
    }
    for (std::size_t first = 0; first < steps.size(); ++first) {
        for (const fs::path& folder : folders) {
            const fs::path from = folder.empty() ? fs::path(".") : folder;
            if (fs::path found = file_by_any_capitals(from, std::span(steps).subspan(first)); !found.empty()) {
                return {folder.empty() ? found.lexically_relative(".") : found, false};
            }
        }
    }
    return {};
}

}  // namespace bruma::io
