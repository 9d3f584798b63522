#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bruma::measure {

/// Where and when something was measured: times are numbers of this machine and of no other.
struct Machine {
    std::string vendor, renderer, driver;  ///< OpenGL's own words
    std::string cpu;                       ///< model name
    int cores = 0;
    std::string date;     ///< UTC, ISO 8601
    std::string version;  ///< of this program
};
/// Needs a current context.
Machine describe_machine();
nlohmann::json to_json(const Machine& machine);

/// How the document of a suite begins; what is the suite's own is added.
template <class Bench>
nlohmann::json begun_document(std::string_view suite, const Bench& bench, std::string_view note) {
    const auto& options = bench.options;
    return {{"bench", suite},
            {"machine", to_json(bench.machine)},
            {"parameters",
             {{"pixels", {options.pixels.x, options.pixels.y}},
              {"frame_pixels", {options.frame_pixels.x, options.frame_pixels.y}},
              {"repeats", options.repeats},
              {"quick", options.quick},
              {"reference_tolerance", options.reference_tolerance}}},
            {"note", note}};
}

/// What one piece of work took.
struct Duration {
    double wall_ms = 0.0;
    double cpu_ms = 0.0;  ///< of all threads of this process; with a driver that draws on the CPU, the drawing too
};

/// Runs `body` between two drained OpenGL queues.
template <class Body>
Duration drained(const Body& body);

/// The middle value, of an even number of values the upper one of the two; throws nothing, 0 for none.
double median(std::vector<double> values);

/// Drains the queue and reads both clocks, in ms.
Duration clocks_when_drained();

template <class Body>
Duration drained(const Body& body) {
    const Duration start = clocks_when_drained();
    body();
    const Duration end = clocks_when_drained();
    return {end.wall_ms - start.wall_ms, end.cpu_ms - start.cpu_ms};
}

}  // namespace bruma::measure
