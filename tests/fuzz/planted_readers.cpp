#include <chrono>
#include <csignal>
#include <stdexcept>
#include <thread>

#include "readers.h"

namespace bruma::fuzz {

// Each falls into its fault whenever its input is not the sound one.
std::vector<Reader> planted_readers() {
    const auto planted = [](const std::string& name, std::function<void(const std::string&)> fault) {
        const std::string sound = "0123456789";
        return Reader{"planted-" + name, {sound}, {}, [fault, sound](const std::string& input, const auto&) {
                          if (input != sound) {
                              fault(input);
                          }
                      }};
    };
    return {
        planted("stray-pointer",
                [](const std::string&) {
                    volatile int* volatile nowhere = nullptr;
                    *nowhere = 1;
                }),
            planted("abort", [](const std::string&) { std::abort(); }),
            planted("exit", [](const std::string&) { std::_Exit(7); }),
            planted("other-exception", [](const std::string&) { throw std::out_of_range("nobody expects this"); }),
            planted("endless-loop",
                    [](const std::string&) {
                        const volatile bool is_endless = true;
                        while (is_endless) {
                        }
                    }),
            planted("endless-wait", [](const std::string&) { std::this_thread::sleep_for(std::chrono::hours(9)); }),
            planted("memory",
                    [](const std::string&) {
                        for (std::vector<std::vector<char>> all;; all.emplace_back(1 << 28, 'x')) {
                        }
                    }),
#if defined(__SANITIZE_ADDRESS__)
            planted("end-of-array",
                    [](const std::string& input) {
                        const std::vector<char> copy(input.begin(), input.end());
                        const volatile char* volatile at = copy.data();
                        const char beyond = at[copy.size()];
                        static_cast<void>(beyond);
                    }),
            planted("overflow", [](const std::string&) {
                volatile int largest = 2147483647;
                largest = largest + 1;
            }),
#endif
    };
}

}  // namespace bruma::fuzz
