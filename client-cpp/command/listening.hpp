// Hearing events: what subscribe, watch and record have in common.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "command/context.hpp"

namespace rois::command {

// Binds and starts the components of --start.
void start_components(Context&);

// Subscribes to events of these types, all that the engine's components have when none is given; results inline. Throws Trouble.
std::vector<SubscribeId> subscribe_to(Context&, std::vector<std::string> const& event_types, QueryExpression const&);

// What a command listens for. A shared session is told from its beginning, and of all its subscriptions.
struct Meant {
    std::uint64_t after = 0;            // a sequence
    std::vector<SubscribeId> events{};  // subscribed to; empty: all

    bool operator()(Heard const&) const;
};

// Hears until --count events have come, --for is over, or a signal. Throws Trouble when the connection closes.
void listen(Context&, std::function<void(Heard const&)> const& heard, Meant const& = {});

}  // namespace rois::command
