// Actions and refusals of clients, for the audit log (docs/trust.md).
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

namespace rois {

// Holds no secrets, and no text of a client: names are those of tokens and components. The texts are valid during the call:
// making an entry needs no memory.
struct AuditEntry {
    std::string_view what;         // "bound"; a string literal
    std::string_view token{};      // name of the client's token; empty: it has none
    std::uint64_t session = 0;     // its number; 0: none
    std::string_view address{};    // of the client; empty: not known here
    std::string_view component{};  // its ref; empty: none
    std::string_view operation{};  // "bind", or the type of a command: "start"; empty: none
    std::string_view outcome{};    // return code, fault or status; empty: the entry says it all
};

// Must return at once, and must not throw. Called on any thread, also with the engine locked.
using Audit = std::function<void(AuditEntry const&)>;

}  // namespace rois
