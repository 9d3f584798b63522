#include "measure/bench/bench_machine.h"

#include <GL/glew.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <thread>

namespace bruma::measure {
namespace {

std::string gl_word(GLenum name) {
    const auto* word = reinterpret_cast<const char*>(glGetString(name));
    return word ? word : "";
}

std::string cpu_model() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with("model name")) {
            const std::size_t colon = line.find(": ");
            return colon == std::string::npos ? line : line.substr(colon + 2);
        }
    }
    return "unknown";
}

double ms(const timeval& t) {
    return 1e3 * double(t.tv_sec) + 1e-3 * double(t.tv_usec);
}

}  // namespace

Machine describe_machine() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char date[32];
    std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return {gl_word(GL_VENDOR),
            gl_word(GL_RENDERER),
            gl_word(GL_VERSION),
            cpu_model(),
            int(std::thread::hardware_concurrency()),
            date,
            BRUMA_VERSION};
}

nlohmann::json to_json(const Machine& machine) {
    return {{"driver", {{"vendor", machine.vendor}, {"renderer", machine.renderer}, {"version", machine.driver}}},
            {"cpu", machine.cpu},
            {"cores", machine.cores},
            {"date", machine.date},
            {"bruma", machine.version}};
}

double median(std::vector<double> values) {
    if (values.empty()) {
        return 0.0;
    }
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

Duration clocks_when_drained() {
    glFinish();
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto wall = std::chrono::steady_clock::now().time_since_epoch();
    return {std::chrono::duration<double, std::milli>(wall).count(), ms(usage.ru_utime) + ms(usage.ru_stime)};
}

}  // namespace bruma::measure
