// Hearing events: what subscribe, watch and record have in common.
#pragma once

#include <functional>

#include "command/context.hpp"

namespace rois::command {

// Binds and starts the components of --start.
void start_components(Context&);

// Subscribes to events of these types, all that the engine's components have when none is given; results inline. Throws Trouble.
void subscribe_to(Context&, std::vector<std::string> const& event_types, QueryExpression const&);

// Hears until --count events have come, --for is over, or a signal. Throws Trouble when the connection closes.
void listen(Context&, std::function<void(Heard const&)> const& heard);

}  // namespace rois::command
