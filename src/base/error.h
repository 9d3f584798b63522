#pragma once
#include <stdexcept>
#include <string>

namespace bruma {

/// Process exit codes; documented in `bruma --help`.
enum class ExitCode { done = 0, answer_is_no = 1, user_input = 2, machine = 3 };

/// A fault to be told at the user's door in one sentence: what, where, found, expected, next step.
class Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string& sentence) : std::runtime_error(sentence), code_(code) {}
    ExitCode code() const { return code_; }

  private:
    ExitCode code_;
};

/// The user's input is at fault: a file, an option, a scene (exit 2).
class InputError : public Error {
  public:
    explicit InputError(const std::string& sentence) : Error(ExitCode::user_input, sentence) {}
};

/// This machine cannot do it: no OpenGL 4.5, no memory (exit 3).
class MachineError : public Error {
  public:
    explicit MachineError(const std::string& sentence) : Error(ExitCode::machine, sentence) {}
};

}  // namespace bruma
