// Keeps out web pages of other sites. A browser on this machine or in its network shows them, and so they can send requests to
// the gateway: under a name of their own site that they let point to this machine (DNS rebinding), or across sites, by scripts,
// forms, frames and WebSockets. Any thread.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "net/http_answer.hpp"
#include "net/http_head.hpp"
#include "net/settings.hpp"

namespace rois::net {

// The name of this machine as gethostname gives it, in lower case. Nothing if it cannot be a host name.
std::optional<std::string> machine_name();

// The name as `is_own_host` compares it: in lower case, without a dot at its end. Nothing if it cannot be a host name.
std::optional<std::string> host_name(std::string_view);

// Whether a request may name this host, with or without a port: localhost, a literal IP address, or one of `names`, which
// `host_name` gave. No other site has these, so a page under one of them is not another site's.
bool is_own_host(std::string_view authority, std::vector<std::string> const& names);

// Whether pages of this origin may send requests to `authority`: those that come from there, and those in `allowed`.
bool is_allowed_origin(std::string_view origin, std::string_view authority, std::vector<std::string> const& allowed);

// Why this request is refused: 421 for a Host, or a target's authority, that is not the gateway's own; 403 for an Origin that is
// not allowed. Nothing if it may pass. A request without Host is HTTP/1.0, which browsers do not send.
std::optional<HttpAnswer> refusal_of_foreign(RequestHead const&, Settings const&);

}  // namespace rois::net
