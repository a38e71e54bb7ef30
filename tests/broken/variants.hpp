// Correct gateways that differ from ours. Each is our gateway behind a proxy that rewrites requests and answers.
#pragma once

#include <map>
#include <string>

#include "broken/proxy.hpp"

namespace rois::broken {

// A gateway that has only what RoIS marks as mandatory: it lacks the optional parameters, results and events, refuses to set
// them, and knows the Minimum Standard Filter of ISO 19143 alone.
Breaking has_mandatory_parts_only();

// New names by the names of our gateway. The new names of one robot's components have the order of the old ones, by which the
// gateway chooses "the lowest code".
using Names = std::map<std::string, std::string>;

// The names of the components of one robot, each with `prefix` before it.
Names component_names(std::string const& prefix, std::string const& new_prefix);
// Other words for the components of one robot: `drive_unit` for `navigation`.
Names other_component_names();

// Components and engines have these names. Robots keep their codes unless these are in `names`, too.
Breaking has_names(Names const& names);

// Sessions, commands, events and errors have other ids, with characters that must be escaped in XML. Over a WebSocket only: over
// HTTP, the session stands in a header field, too.
Breaking has_other_ids();

// Puts the engines of robot1 and robot2 into engines of their own: main > building > ground_floor > robot1 and
// main > building > robot2. The names are the new ones.
Breaking has_nested_engines(Names const& names);

}  // namespace rois::broken
