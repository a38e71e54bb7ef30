// Errors: the engine refused an operation, or did not answer.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <variant>

#include "types/messages.hpp"

namespace rois {

// Why a call has no answer. With `deadline`, `session_lost` and `link_lost`, the engine may or may not have performed
// the operation.
struct NoAnswer {
    enum class Why : std::uint8_t {
        deadline,        // the deadline has passed
        session_lost,    // the engine has ended the session in which the request was sent
        link_lost,       // the link broke (only for Connection::send, which sends a document only once)
        closed,          // the connection is closed
        not_understood,  // the answer is not a document of RoIS
    };
    Why why = Why::closed;
    std::string reason;
};

// The end of a request: the operation's reply with any return code, a fault of the engine, or no answer.
using Answer = std::variant<Reply, Fault, NoAnswer>;

// An operation that did not end with OK. `code` is the engine's return code, TIMEOUT if the deadline passed, or ERROR for a fault
// or any other missing answer. The text names the operation and the reason.
class Error : public std::runtime_error {
public:
    Error(ReturnCode code, std::string const& what) : std::runtime_error{what}, code_{code} {}
    ReturnCode code() const { return code_; }

private:
    ReturnCode code_;
};

}  // namespace rois
