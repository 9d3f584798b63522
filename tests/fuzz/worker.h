#pragma once
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "readers.h"

namespace bruma::fuzz {

/// Inputs of one reader, by number: the same number gives the same input in every run of one seed.
std::string input_of(const Reader& reader, std::uint64_t seed, std::uint64_t number);

struct Finding {
    std::uint64_t number = 0;  ///< of the input
    std::string what;          ///< "signal 11", "more than 5 s", "std::out_of_range: ..."
    std::string report;        ///< what the sanitizer or the library said, in short
};

struct Tally {
    std::uint64_t inputs = 0;
    std::uint64_t accepted = 0;  ///< read without complaint
    double slowest_s = 0.0;      ///< processor time of one input
    std::uint64_t slowest = 0;   ///< its number
    std::string refusal;         ///< the last sentence with which one was refused
};

/// Reads inputs `first` to `end` - 1 in a process of its own, and in another one from the next input on whenever it
/// dies or takes longer than the limit. `found` is called for each finding.
Tally run_inputs(const Reader& reader, std::uint64_t seed, std::uint64_t first, std::uint64_t end,
                 const std::function<void(const Finding&)>& found);

}  // namespace bruma::fuzz
