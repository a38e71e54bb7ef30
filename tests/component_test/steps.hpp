// Steps that several checks share.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "component_test/program.hpp"

namespace rois::component_test {

constexpr auto unknown_name = "unknown";  // a name that no program has

// Each throws Broken if the program gave another answer.
void require(bool holds, std::string const& message);
void require_ok(Outcome const&, std::string const& what);
void require_refusal(Execute::Reply const&, std::string const& what);
void require_no_session(xml::EngineMessage const& answer, std::string const& what);

Identifier identifier(std::string const& ref);
Parameter parameter(ParameterProfile const&, std::vector<std::string> values);
Query query_of(std::string const& ref, std::string const& query);

std::vector<MessageProfile> messages(ComponentEntry const&, MessageKind);
bool has_command(ComponentEntry const&, char const* name);
inline constexpr std::array<char const*, 4> common_commands{"start", "stop", "suspend", "resume"};
// The commands of the component besides the common ones.
std::vector<MessageProfile> own_commands(ComponentEntry const&);
// The same without set_parameter, which runs no function.
std::vector<MessageProfile> own_actions(ComponentEntry const&);

// Returns a valid value for each argument.
ParameterList arguments_of(MessageProfile const& command);
// Returns arguments with which the command may run for long: its numbers without a default value are 100 or 10, if the program
// accepts them.
ParameterList long_arguments(Program&, std::string const& ref, MessageProfile const& command);

// Ends the session, and opens a new one on the same link, with this window.
void open_session(Program&, std::chrono::milliseconds with_window);
// Cuts the link, accepts the next one after this time, and resumes the session.
void lose_link(Program&, std::chrono::milliseconds down);

void bind(Program&, std::string const& ref);
// Subscribes to all events of the component, as an engine does. Reads the events that the program has kept for the subscription.
void subscribe(Program&, ComponentEntry const&);
// Each returns the id of the command. Throws Skipped if the program refuses it.
std::string start(Program&, std::string const& ref);
std::string run(Program&, std::string const& ref, std::string const& command, ParameterList const& arguments);
// Stops the component, and waits until `stop` completes. Commands that ran before it have completed then.
void stop(Program&, std::string const& ref);

// The values of all boolean results of the component's queries, by the names of query and result.
using Switches = std::map<std::string, std::string>;
Switches switches(Program&, ComponentEntry const&);

constexpr std::chrono::milliseconds time_at_rest{1'000};  // in which a component that stands still must report nothing

// Returns whether the component reported no events before a check ran its commands. The first call measures it.
bool is_quiet(Program&, ComponentEntry const&);
// Throws Broken if the component reports events in this time. Throws Skipped if it is not quiet: its events then prove nothing.
void require_rest(Program&, ComponentEntry const&, std::string const& after, std::chrono::milliseconds time = time_at_rest);

}  // namespace rois::component_test
