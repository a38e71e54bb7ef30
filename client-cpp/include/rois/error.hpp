// What the comfortable layer throws: the engine refused, or did not answer.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <variant>

#include "types/messages.hpp"

namespace rois {

// A call that has no answer of the engine. Whether the engine acted is not known with `deadline`, `session_lost` and
// `link_lost`.
struct NoAnswer {
    enum class Why : std::uint8_t {
        deadline,        // it passed
        session_lost,    // the engine has ended the session in which it was sent
        link_lost,       // the link broke; of documents sent as they stand, which are not sent again
        closed,          // the connection is closed
        not_understood,  // the answer is no document of RoIS
    };
    Why why = Why::closed;
    std::string reason;
};

// What a request ends with: the operation's reply, whatever its return code; or the engine's refusal to look at it; or nothing.
using Answer = std::variant<Reply, Fault, NoAnswer>;

// An operation that did not end with OK. `code` is the engine's; ERROR for a fault, TIMEOUT when the deadline passed, ERROR when
// there was no answer otherwise. The text says which operation it was, and the reason.
class Error : public std::runtime_error {
public:
    Error(ReturnCode code, std::string const& what) : std::runtime_error{what}, code_{code} {}
    ReturnCode code() const { return code_; }

private:
    ReturnCode code_;
};

}  // namespace rois
