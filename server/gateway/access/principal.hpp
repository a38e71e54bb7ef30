// Who sends a request, and what its role allows (docs/trust.md).
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/rights.hpp"
#include "gateway/access/secrets.hpp"
#include "types/messages.hpp"

namespace rois {

// Each role may do what the one before it may, and more.
enum class Role : std::uint8_t {
    nobody,        // sent no token
    observer,      // profiles, queries, events
    operator_,     // also binds, commands and stops
    engine,        // also joins, and uses the gateway as a sub engine
    administrator  // also takes over bindings
};

// "operator", for example.
std::string_view to_text(Role);
// Returns nothing for a text that is not the role of a token.
std::optional<Role> read_role(std::string_view);
// "observer, operator, engine, administrator"
std::string const& names_of_roles();

// Returns the least role that may perform the operation.
Role least_role_for(Operation const&);
// The fault for what another role may do.
Fault not_allowed_for(Role, Role least);
// The fault for a token that may see some components only.
Fault only_for_all();

// The holder of a token. Shared by all its connections and sessions.
struct Principal {
    std::string const& name() const { return rights->holder(); }  // of the token
    // The token was revoked or changed, or has expired.
    bool is_over() const { return rights->is_withdrawn(); }

    Role role = Role::nobody;
    std::shared_ptr<Rights const> rights;                            // never null, and of this principal only
    std::optional<std::chrono::system_clock::time_point> expires{};  // nothing: never
    Sha256 hash{};                                                   // of the token

    // Those who send no token, where one is needed.
    static std::shared_ptr<Principal const> nobody();
};

// Returns the refs that the principal may see. Null: all.
std::vector<std::string> seen_by(Principal const*, std::vector<std::string> refs);

}  // namespace rois
