#include "base/memory.h"

#include <fstream>
#include <limits>
#include <string>

namespace bruma {

std::uint64_t available_memory() {
    std::ifstream facts("/proc/meminfo");
    std::string key;
    std::uint64_t kibibytes = 0;
    for (std::string unit; facts >> key >> kibibytes; std::getline(facts, unit)) {
        if (key == "MemAvailable:") {
            return kibibytes * 1024;
        }
    }
    return std::numeric_limits<std::uint64_t>::max();
}

}  // namespace bruma
