// Correct gateways that differ from ours. Each is our gateway behind a proxy that rewrites requests and answers.
#pragma once

#include <map>
#include <string>

#include "broken/proxy.hpp"

namespace rois::broken {

// A gateway with only the mandatory parts of RoIS. It lacks the optional parameters, results and events, refuses to set them, and
// supports only the Minimum Standard Filter of ISO 19143.
Breaking has_mandatory_parts_only();

// Names of our gateway -> new names. The new names of one robot's components must have the same order as the old ones, because
// the gateway selects "the lowest code".
using Names = std::map<std::string, std::string>;

// Returns the names of the components of one robot: `prefix` and name -> `new_prefix` and name.
Names component_names(std::string const& prefix, std::string const& new_prefix);
// Returns other names for the components of one robot: `drive_unit` for `navigation`.
Names other_component_names();

// Renames components and engines. Robots keep their codes, unless `names` contains the codes.
Breaking has_names(Names const& names);

// Changes the ids of sessions, commands, events and errors: the new ids have characters that must be escaped in XML. Only for
// WebSockets: over HTTP, the id of the session is also in a header field.
Breaking has_other_ids();

// Nests the engines of two robots: main > building > ground_floor > robot1, and main > building > robot2. `names` also renames
// them.
Breaking has_nested_engines(Names const& names);

}  // namespace rois::broken
