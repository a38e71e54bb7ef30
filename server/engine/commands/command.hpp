// A command of a session, from its acceptance until its result is forgotten.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "engine/commands/deadlines.hpp"
#include "engine/component.hpp"
#include "types/codes.hpp"
#include "types/ids.hpp"
#include "types/values.hpp"

namespace rois {

class RegisteredComponent;
class Execution;
struct Session;

struct Command {
    enum class State : std::uint8_t { waiting, running, ended };

    CommandHandle handle{};
    CommandId id;
    std::string type;
    std::string ref;                                 // of the component
    ParameterList arguments;                         // with the profile's names
    Begin begin;                                     // what the component has prepared; empty for stop, suspend and resume
    ParameterList prepared_for;                      // the parameters that were prepared
    std::uint64_t hold = 0;                          // the answer of `execute`, which is sent before the command's notifications
    std::uint64_t session_number = 0;                // of the session that asked for it, also once that has ended
    Session* session = nullptr;                      // receives the notifications; null once the session has ended
    std::shared_ptr<RegisteredComponent> component;  // valid also after it has left the engine; null: not seen since a restart
    bool has_been_stored = false;                    // by the journal, perhaps as it was earlier
    std::uint64_t stops = 0;                         // RegisteredComponent::stops, when the command was checked
    bool binding_lost = false;                       // released before the command's turn came (decision 13)

    State state = State::waiting;
    std::optional<Deadlines::Ticket> start_deadline;  // set until the component reports `started`
    CompletedStatus status = CompletedStatus::ok;     // set at the end, like the members below
    Results results;
    std::string reason;  // why the status is not OK, for people; may be empty
    Steady ended_at;
    Utc ended_utc;

    // The steps that end the command, each done once. If one fails, a later tick repeats it.
    bool reported = false;  // the trace and the session were notified
    bool kept = false;      // the result is among the session's results
    bool notified = false;  // its `completed` was given to the journal
    bool finished = false;  // no step is left
    bool given_up = false;  // it failed for lack of memory: the next tick ends it

    // The command's place in its sequence. Unset for set_parameter outside of a sequence.
    std::shared_ptr<Execution> execution;  // until the command has ended
    std::size_t node = 0;
};

}  // namespace rois
