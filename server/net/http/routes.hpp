// The endpoints, and the checks of a request before its body is read (docs/clients.md).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "gateway/access/principal.hpp"
#include "net/http/http_answer.hpp"
#include "net/http/http_head.hpp"

namespace rois::net {

enum class Endpoint : std::uint8_t {
    page,
    plain_page,
    asset,
    rois,
    engines,
    notifications,
    engine_profile,
    component_profile,
    schema_list,
    schema,
    floor_map,
    stop,
    clear,
    healthz,
    readyz,
    metrics,
    unknown
};

struct Route {
    Endpoint endpoint = Endpoint::unknown;
    std::string name;  // decoded; of a component or a file
};

Route route_of(std::string_view path);
// The path of an endpoint, "/rois/stop" for example; empty for an unknown one.
std::string_view name_of(Endpoint);

// Returns the answer to a request of another site: 421 if a Host or the target's authority is not the gateway's own, 403 if the
// Origin is not allowed.
std::optional<HttpAnswer> refusal_of_other_sites(RequestHead const&, Settings const&);

// Returns the answer to a request that its head alone makes invalid: 404, 405, 413 or 415, checked in this order. Returns nothing
// if the request is to be received.
std::optional<HttpAnswer> refusal(RequestHead const&, Route const&, Settings const&);

// Returns whether the answer tells nothing that needs a token: whether the gateway works, and the files of the console.
bool is_for_everyone(Endpoint);
// The least role that may use the endpoint; for /rois, that of operations counts, too.
Role least_role_for(Endpoint, RequestHead const&);

}  // namespace rois::net
