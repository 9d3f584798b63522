#include "base/installation.h"

#include <fmt/core.h>

#include <map>
#include <string>

#include "base/error.h"

namespace bruma {
namespace {

std::map<std::string, std::filesystem::path, std::less<>>& overrides() {
    static std::map<std::string, std::filesystem::path, std::less<>> folders;
    return folders;
}

}  // namespace

std::filesystem::path program_path() {
    std::error_code error;
    return std::filesystem::read_symlink("/proc/self/exe", error);
}

void use_folder(std::string_view name, std::filesystem::path folder) {
    overrides()[std::string(name)] = std::move(folder);
}

std::filesystem::path installed_folder(std::string_view name) {
    if (const auto found = overrides().find(name); found != overrides().end()) {
        return found->second;
    }
    const std::filesystem::path installed = program_path().parent_path().parent_path() / "share" / "bruma" / name;
    const std::filesystem::path source = std::filesystem::path(BRUMA_SOURCE_FOLDER) / name;
    for (const std::filesystem::path& place : {installed, source}) {
        std::error_code error;
        if (std::filesystem::is_directory(place, error)) {
            return place;
        }
    }
    throw MachineError(fmt::format("the folder '{}' is neither at {} nor at {}; was the program moved without it?",
                                   name, installed.string(), source.string()));
}

}  // namespace bruma
