#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>

#include "base/error.h"
#include "readers.h"
#include "worker.h"

namespace bruma::fuzz {
namespace fs = std::filesystem;

fs::path put(const fs::path& folder, const std::string& name, const std::string& content) {
    std::ofstream(folder / name, std::ios::binary) << content;
    return folder / name;
}

void each(const std::vector<std::function<void()>>& ways) {
    std::size_t refused = 0;
    for (const auto& way : ways) {
        try {
            way();
        } catch (const Error&) {
            if (++refused == ways.size()) {
                throw;
            }
        }
    }
}

std::vector<Reader> all_readers() {
    std::vector<Reader> readers = text_readers();
    for (Reader& reader : picture_readers()) {
        readers.push_back(std::move(reader));
    }
    return readers;
}

namespace {

struct Options {
    std::uint64_t inputs = 2000, seed = 1;
    std::string reader, keep, more;
    std::int64_t only = -1;
    bool planted = false, list = false;
};

void keep_input(const Options& options, const Reader& reader, std::uint64_t number) {
    if (!options.keep.empty()) {
        fs::create_directories(options.keep);
        put(options.keep, fmt::format("{}-{}-{}", reader.name, options.seed, number),
            input_of(reader, options.seed, number));
    }
}

/// Findings of one reader.
std::uint64_t run_reader(const Options& options, const Reader& reader, std::uint64_t inputs) {
    std::uint64_t findings = 0;
    const std::uint64_t first = options.only >= 0 ? std::uint64_t(options.only) : 0;
    const std::uint64_t end = options.only >= 0 ? first + 1 : inputs;
    const Tally tally = run_inputs(reader, options.seed, first, end, [&](const Finding& finding) {
        ++findings;
        fmt::print("{}: input {} of seed {}: {}\n{}", reader.name, finding.number, options.seed, finding.what,
                   finding.report);
        keep_input(options, reader, finding.number);
    });
    fmt::print("{:14} {:6} inputs, {:6} read, {:6} refused, slowest {:.2f} s ({}), findings {}\n", reader.name,
               tally.inputs, tally.accepted, tally.inputs - tally.accepted - findings, tally.slowest_s, tally.slowest,
               findings);
    if (options.only >= 0) {
        keep_input(options, reader, first);
        fmt::print("{}\n", tally.refusal);
    }
    std::fflush(stdout);
    return findings;
}

/// Every planted fault must be found; the answer is the number of those that were not.
int run_planted(const Options& options) {
    int missed = 0;
    for (const Reader& reader : planted_readers()) {
        Options few = options;
        few.keep.clear();
        if (run_reader(few, reader, 3) == 0) {
            fmt::print("{}: this planted fault was not found\n", reader.name);
            ++missed;
        }
    }
    return missed > 0 ? int(ExitCode::answer_is_no) : int(ExitCode::done);
}

/// Files of a folder named like a reader are sound inputs more for it.
void add_sound(const fs::path& folder, Reader& reader) {
    std::error_code none;
    for (fs::directory_iterator at(folder / reader.name, none), end; !none && at != end; at.increment(none)) {
        std::ifstream file(at->path(), std::ios::binary);
        reader.sound.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
}

int run(const Options& options) {
    if (options.planted) {
        return run_planted(options);
    }
    std::vector<Reader> readers = all_readers();
    if (!options.reader.empty()) {
        std::erase_if(readers, [&](const Reader& reader) { return reader.name != options.reader; });
    }
    if (readers.empty() || options.list) {
        for (const Reader& reader : all_readers()) {
            fmt::print("{}\n", reader.name);
        }
        return int(options.list ? ExitCode::done : ExitCode::user_input);
    }
    std::uint64_t findings = 0;
    std::uint64_t inputs = 0;
    for (std::size_t n = 0; n < readers.size(); ++n) {
        if (!options.more.empty()) {
            add_sound(options.more, readers[n]);
        }
        const std::uint64_t share = options.inputs * (n + 1) / readers.size() - options.inputs * n / readers.size();
        findings += run_reader(options, readers[n], share);
        inputs += options.only >= 0 ? 1 : share;
    }
    fmt::print("{} inputs, {} findings\n", inputs, findings);
    return int(findings > 0 ? ExitCode::answer_is_no : ExitCode::done);
}

}  // namespace
}  // namespace bruma::fuzz

#if defined(__SANITIZE_ADDRESS__)
// A worker that takes 3 GB, or asks for 2 GB at once, has believed a number in a file; leaks are looked for elsewhere.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
    return "hard_rss_limit_mb=3000:max_allocation_size_mb=2000:detect_leaks=0:handle_abort=1";
}
#endif

int main(int argc, char** argv) {
    bruma::fuzz::Options options;
    CLI::App app("Reads mutated files with every reader of Bruma; see README.md in tests/fuzz.");
    app.add_option("--inputs", options.inputs, "inputs in all, shared equally by the readers");
    app.add_option("--seed", options.seed, "another one gives other inputs");
    app.add_option("--reader", options.reader, "this one only");
    app.add_option("--only", options.only, "the input of this number only; it is kept whatever comes of it");
    app.add_option("--keep", options.keep, "folder for inputs with findings");
    app.add_option("--more", options.more, "folder of further sound inputs, as in DIR/png/photograph.png");
    app.add_flag("--planted", options.planted, "readers with planted faults, all of which must be found");
    app.add_flag("--list", options.list, "names of the readers");
    CLI11_PARSE(app, argc, argv);
    try {
        return bruma::fuzz::run(options);
    } catch (const std::exception& fault) {
        fmt::print(stderr, "bruma_fuzz: {}\n", fault.what());
        return int(bruma::ExitCode::machine);
    }
}
