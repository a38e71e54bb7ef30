// Which endpoint a request goes to, and which methods it takes (wire.md).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "net/http_answer.hpp"
#include "net/http_head.hpp"

namespace rois::net {

enum class Endpoint : std::uint8_t {
    page,
    plain_page,
    asset,
    rois,
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
    std::string name;  // of the component or the file, decoded
};

Route route_of(std::string_view path);

// Why this request is refused before its body is looked at, or nothing: 421, 403 for an origin, 404, 405, 413 and 415, in
// this order.
std::optional<HttpAnswer> refusal(RequestHead const&, Route const&, Settings const&);

}  // namespace rois::net
