// Functions that break the commands of one component. `component` is the end of a ref: "navigation" selects the navigation of
// every robot.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "broken/breaking.hpp"

namespace rois::broken {

using Values = std::vector<std::string>;

// Edits each command of the component in requests of execute.
Breaking edits_commands(std::string const& component, Edit const&);
// Returns the argument with this name, if the command has it.
pugi::xml_node argument_of(pugi::xml_node command, std::string const& name);
Breaking edits_arguments(std::string const& component, std::string const& name, std::function<Values(Values)> const&);
Breaking drops_argument(std::string const& component, std::string const& name);
// Performs another operation instead of `type`.
Breaking replaces_command(std::string const& component, std::string const& type, std::string const& instead);
// suspend and resume complete with OK and have no effect.
Breaking pretends_to_suspend(std::string const& component);
// stop completes with OK, and the start before it with ABORT; the action continues.
Breaking pretends_to_stop(std::string const& component);
// start completes with OK once the gateway has accepted it.
Breaking completes_at_once(std::string const& component);
// start completes five seconds after its end.
Breaking completes_late(std::string const& component);

}  // namespace rois::broken
