// Who sends the requests of a connection. A token that comes again is not hashed and looked up again.
#pragma once

#include <optional>
#include <string>

#include "gateway/access/session_quota.hpp"
#include "gateway/access/tokens.hpp"

namespace rois {

// Used by one connection.
class TokenCheck {
public:
    // Sets the client's principal: the holder of the token, or Principal::nobody() if the token is missing or refused. Returns
    // why it is refused; nullopt: it is valid.
    std::optional<Tokens::Refused> check(Tokens&, std::optional<std::string> const& token, Client&);
    // As if no valid token had been shown.
    void forget(Client&);

private:
    std::string valid_;  // the token of the client's principal; empty: it has none
};

}  // namespace rois
