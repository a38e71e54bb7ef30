// Functions for the commands subscribe, watch and record.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "command/context.hpp"

namespace rois::command {

// Binds and starts the components of --start.
void start_components(Context&);

// Subscribes to these event types, or to all of the engine's components if none is given, with inline results. Throws Trouble.
std::vector<SubscribeId> subscribe_to(Context&, std::vector<std::string> const& event_types, QueryExpression const&);

// Selects the updates of a command. In a shared session, the command also receives older notifications and events of other
// subscriptions.
struct Wanted {
    std::uint64_t after = 0;            // only notifications after this sequence
    std::vector<SubscribeId> events{};  // only events of these subscriptions; empty: all

    bool operator()(Update const&) const;
};

// Calls `handle` with each wanted update until --count events have arrived, --for is over, or a signal arrives. Throws Trouble if
// the connection closes.
void listen(Context&, std::function<void(Update const&)> const& handle, Wanted const& = {});

}  // namespace rois::command
