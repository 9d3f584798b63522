#include "gl/shader_library.h"

#include <algorithm>

#include "base/error.h"
#include "base/log.h"

namespace bruma::gl {

Program ShaderLibrary::build(const Key& key) const {
    if (key.file.ends_with(".comp")) {
        return {root_, {key.file}, key.defines};
    }
    const std::filesystem::path own = std::filesystem::path(key.file).replace_extension(".vert");
    return {root_, {key.file, std::filesystem::exists(root_ / own) ? own.string() : "full_screen.vert"}, key.defines};
}

Program& ShaderLibrary::get(const std::string& file, const Defines& defines) {
    Key key{file, defines};
    const auto found = programs_.find(key);
    if (found != programs_.end()) {
        return found->second;
    }
    Program program = build(key);
    return programs_.emplace(std::move(key), std::move(program)).first->second;
}

std::filesystem::file_time_type ShaderLibrary::newest_file() const {
    auto newest = std::filesystem::file_time_type::min();
    std::error_code error;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root_, error)) {
        newest = std::max(newest, entry.last_write_time(error));
    }
    return newest;
}

bool ShaderLibrary::reload_if_saved() {
    const auto newest = newest_file();
    const bool first_look = seen_ == std::filesystem::file_time_type::min();
    if (newest == seen_) {
        return false;
    }
    seen_ = newest;
    if (first_look) {
        return false;
    }
    std::map<Key, Program> fresh;
    try {
        for (const auto& [key, program] : programs_) {
            fresh.emplace(key, build(key));
        }
    } catch (const Error& fault) {
        last_fault_ = fault.what();
        log_error("{}", fault.what());
        return false;
    }
    last_fault_.clear();
    programs_ = std::move(fresh);
    revision_ = next_revision();
    log_note("shaders reloaded");
    return true;
}

std::vector<std::string> ShaderLibrary::compiled_names() const {
    std::vector<std::string> names;
    for (const auto& [key, program] : programs_) {
        std::string name = key.file;
        for (const auto& [define, value] : key.defines) {
            name.append(" ").append(define).append("=").append(value);
        }
        names.push_back(name);
    }
    return names;
}

}  // namespace bruma::gl
