#include "measure/stress/stress_mesh_folder.h"

#include <stdlib.h>

#include <fstream>

#include "base/error.h"

namespace bruma::measure {

StressFolder::StressFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / ("bruma-stress-" + std::string(6, 'X'))).string();
    if (::mkdtemp(pattern.data()) == nullptr) {
        throw MachineError(pattern + ": this folder for broken files cannot be made; set TMPDIR to one that can");
    }
    path_ = pattern;
}

StressFolder::~StressFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path StressFolder::write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
}

}  // namespace bruma::measure
