#include "worker.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <ctime>
#include <fstream>
#include <new>
#include <sstream>
#include <typeinfo>

#include "base/error.h"
#include "base/log.h"
#include "mutation.h"

namespace bruma::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double most_processor_seconds = 5.0;
/// A worker that waits uses no processor; a busy machine makes every worker wait.
constexpr double most_seconds = 30.0;

/// What a worker tells while it lives, and leaves behind when it dies.
struct Shared {
    std::atomic<std::uint64_t> number;
    std::atomic<std::uint64_t> accepted;
    std::atomic<double> slowest_s;
    std::atomic<std::uint64_t> slowest;
    std::atomic<bool> is_other_exception;  ///< set before `sentence` is, read after the worker has ended
    char sentence[400];
    char refusal[400];  ///< the newest one
};

class SharedMemory {
  public:
    SharedMemory()
        : memory_(::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
        if (memory_ == MAP_FAILED) {
            throw MachineError("no memory to share with a worker");
        }
        shared_ = new (memory_) Shared{};
    }
    ~SharedMemory() { ::munmap(memory_, sizeof(Shared)); }
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;
    Shared& operator*() const { return *shared_; }
    Shared* operator->() const { return shared_; }

  private:
    void* memory_;
    Shared* shared_ = nullptr;
};

class Folder {
  public:
    Folder() {
        std::string pattern = (fs::temp_directory_path() / ("bruma-fuzz-" + std::string(6, 'X'))).string();
        if (::mkdtemp(pattern.data()) == nullptr) {
            throw MachineError(pattern + ": no folder can be made there");
        }
        path_ = pattern;
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

double processor_seconds(clockid_t clock) {
    timespec time{};
    ::clock_gettime(clock, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// A file's wrong size must not take the machine's memory. Sanitizers reserve terabytes of addresses and have a limit
/// of their own instead (main.cpp).
void limit_memory() {
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
#if !defined(__SANITIZE_ADDRESS__)
    const rlimit four_gibibytes{rlim_t(4) << 30, rlim_t(4) << 30};
    ::setrlimit(RLIMIT_AS, &four_gibibytes);
#endif
}

/// FNV-1a: the same number for a name on every machine.
std::uint64_t number_of_name(const std::string& name) {
    std::uint64_t hash = 0xCBF29CE484222325U;
    for (const char c : name) {
        hash = (hash ^ std::uint8_t(c)) * 0x100000001B3U;
    }
    return hash;
}

/// Reads inputs until the end, or until something else than an Error is thrown.
void work(const Reader& reader, std::uint64_t seed, std::uint64_t end, const fs::path& folder, Shared& shared) {
    const auto tell = [&](const std::string& sentence) {
        std::strncpy(shared.sentence, sentence.c_str(), sizeof shared.sentence - 1);
        shared.is_other_exception = true;
    };
    for (std::uint64_t number = shared.number; number < end; shared.number = ++number) {
        const std::string input = input_of(reader, seed, number);
        const fs::path own = folder / "input";
        fs::remove_all(own);
        fs::create_directory(own);
        const double begun = processor_seconds(CLOCK_PROCESS_CPUTIME_ID);
        try {
            reader.read(input, own);
            ++shared.accepted;
        } catch (const Error& refusal) {
            std::strncpy(shared.refusal, refusal.what(), sizeof shared.refusal - 1);
            // One sentence is what a mutated file deserves; a reader that refuses the sound ones is not tested at all.
            if (number < reader.sound.size()) {
                tell(std::string("a sound input is refused: ") + refusal.what());
                return;
            }
        } catch (const std::exception& fault) {
            tell(std::string(typeid(fault).name()) + ": " + fault.what());
            return;
        } catch (...) {
            tell("something that is no std::exception");
            return;
        }
        const double took = processor_seconds(CLOCK_PROCESS_CPUTIME_ID) - begun;
        if (took > shared.slowest_s) {
            shared.slowest_s = took;
            shared.slowest = number;
        }
    }
}

/// Waits for a worker; whether it had to be ended because one input took too long.
bool watch(pid_t worker, const Shared& shared, int& status) {
    clockid_t clock{};
    const bool has_clock = ::clock_getcpuclockid(worker, &clock) == 0;
    std::uint64_t number = ~std::uint64_t(0);
    double processor_begun = 0.0;
    Clock::time_point begun;
    while (::waitpid(worker, &status, WNOHANG) == 0) {
        const double processor = has_clock ? processor_seconds(clock) : 0.0;
        if (shared.number != number) {
            number = shared.number;
            processor_begun = processor;
            begun = Clock::now();
        }
        if (processor - processor_begun > most_processor_seconds ||
            std::chrono::duration<double>(Clock::now() - begun).count() > most_seconds) {
            ::kill(worker, SIGKILL);
            ::waitpid(worker, &status, 0);
            return true;
        }
        ::usleep(20'000);
    }
    return false;
}

/// The lines of a dead worker's report that tell most.
std::string shortened(const fs::path& file) {
    std::ifstream lines(file);
    std::string text;
    int taken = 0;
    for (std::string line; taken < 12 && std::getline(lines, line);) {
        const bool tells = line.find("ERROR:") != std::string::npos ||
                           line.find("runtime error") != std::string::npos ||
                           line.find("Assertion") != std::string::npos || line.find("terminate") != std::string::npos ||
                           line.find("    #") != std::string::npos;
        if (tells) {
            text += "    " + line.substr(0, 220) + "\n";
            ++taken;
        }
    }
    return text;
}

}  // namespace

std::string input_of(const Reader& reader, std::uint64_t seed, std::uint64_t number) {
    Random random(seed * 0x100000001B3U ^ number_of_name(reader.name) ^ number * 0x9E3779B97F4A7C15U);
    const std::string& sound = reader.sound[random.below(reader.sound.size())];
    // The first inputs are the sound ones themselves.
    if (number < reader.sound.size()) {
        return reader.sound[number];
    }
    return mutated(sound, reader.sound[random.below(reader.sound.size())], reader.dictionary, random);
}

Tally run_inputs(const Reader& reader, std::uint64_t seed, std::uint64_t first, std::uint64_t end,
                 const std::function<void(const Finding&)>& found) {
    const Folder folder;
    const fs::path report = folder.path() / "report";
    const SharedMemory shared;
    shared->number = first;
    while (shared->number < end) {
        shared->is_other_exception = false;
        std::fflush(nullptr);
        const pid_t worker = ::fork();
        if (worker < 0) {
            throw MachineError("no worker can be started");
        }
        if (worker == 0) {
            const int to = ::open(report.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
            ::dup2(to, STDERR_FILENO);
            ::dup2(to, STDOUT_FILENO);
            limit_memory();
            set_log_level(LogLevel::error);
            work(reader, seed, end, folder.path(), *shared);
            ::_exit(0);
        }
        int status = 0;
        const bool was_slow = watch(worker, *shared, status);
        const std::uint64_t number = shared->number;
        if (was_slow) {
            found({number, "more than 5 s", shortened(report)});
        } else if (shared->is_other_exception) {
            found({number, shared->sentence, {}});
        } else if (WIFSIGNALED(status)) {
            found({number, "signal " + std::to_string(WTERMSIG(status)), shortened(report)});
        } else if (number < end) {
            found({number, "the process ended with " + std::to_string(WEXITSTATUS(status)), shortened(report)});
        } else {
            continue;
        }
        shared->number = number + 1;
    }
    return {end - first, shared->accepted, shared->slowest_s, shared->slowest, shared->refusal};
}

}  // namespace bruma::fuzz
