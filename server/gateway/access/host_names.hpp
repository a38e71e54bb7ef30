// Names of hosts and origins of web pages, to reject the requests of other sites' pages. A browser on this machine or in its
// network may show such a page. The page can send requests under a name of its own site that points to this machine (DNS
// rebinding), or across sites with scripts, forms, frames and WebSockets. Thread-safe.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "types/messages.hpp"

namespace rois {

// Returns this machine's name from gethostname, in lower case. Returns nothing if it is not a valid host name.
std::optional<std::string> machine_name();

// Returns the name in the form that `is_own_host` compares: in lower case, without a dot at its end. Returns nothing if it is not
// a valid host name.
std::optional<std::string> host_name(std::string_view);

// Returns whether a request may be for this host, with or without a port: localhost, an IP address, or one of `names`, which are
// results of `host_name`. No other site has these names.
bool is_own_host(std::string_view authority, std::vector<std::string> const& names);

// Returns the authority, for use in texts. Returns "localhost" if it is empty or has unusual characters.
std::string_view harmless_host(std::string_view authority);

// How this gateway serves its own pages. A port without TLS may have a proxy before it that has TLS.
enum class Scheme : std::uint8_t { any, https };

// Returns whether pages of this origin may send requests to `authority`: pages of that host, and the origins in `allowed`. Pages
// that came without TLS may be anybody's, so a gateway with TLS serves them only if they are in `allowed`.
bool is_allowed_origin(std::string_view origin, std::string_view authority, std::vector<std::string> const& allowed,
                       Scheme served);

// The fault for a request that `is_own_host` or `is_allowed_origin` rejects.
std::optional<Fault> refusal_of_host(std::string_view authority, std::vector<std::string> const& names);
std::optional<Fault> refusal_of_origin(std::string_view origin, std::string_view authority,
                                       std::vector<std::string> const& allowed, Scheme served);

}  // namespace rois
