// The exit codes of the program, which scripts may rely on (docs/rois-command.md).
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "types/codes.hpp"

namespace rois::command {

enum class Exit : std::uint8_t {
    ok = 0,
    error = 1,  // ERROR; of `health`: not healthy
    usage = 2,  // the command line or a file is wrong
    bad_parameter = 3,
    unsupported = 4,
    out_of_resources = 5,
    timeout = 6,
    aborted = 7,    // a command completed with ABORT
    no_answer = 8,  // the engine cannot be reached, or does not answer
    fault = 9,      // the engine rejected a document
    interrupted = 130,
};

Exit exit_of(ReturnCode);
Exit exit_of(CompletedStatus);

// Ends the program with this code. `main` prints the text on standard error; an empty text means that the error was printed
// already.
class Trouble : public std::runtime_error {
public:
    Trouble(Exit exit, std::string const& what) : std::runtime_error{what}, exit_{exit} {}
    Exit exit() const { return exit_; }

private:
    Exit exit_;
};

// The session to join does not exist, or has ended. The text is the reason.
class NoSession : public Trouble {
public:
    explicit NoSession(std::string const& reason) : Trouble{Exit::no_answer, reason} {}
};

}  // namespace rois::command
