// One command of a session on its way through the engine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "engine/component.hpp"
#include "engine/deadlines.hpp"
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
    ParameterList arguments;                         // with the profile's names
    Session* session = nullptr;                      // who hears of it; null once the session has ended
    std::shared_ptr<RegisteredComponent> component;  // also when it has gone meanwhile
    bool binding_lost = false;                       // its component was released before its turn came (decision 13)

    State state = State::waiting;
    std::optional<Deadlines::Ticket> start_deadline;  // until the component says that it has started
    CompletedStatus status = CompletedStatus::ok;     // once ended, as are the following
    Results results;
    std::string reason;  // why not with OK, for people; may be empty
    Steady ended_at;

    // How far its end has come: each step is done once, also if another one fails and is done by a later tick.
    bool told = false;      // to the journal and its session
    bool kept = false;      // among the session's results
    bool finished = false;  // nothing is left to be done
    bool given_up = false;  // something of it failed for want of memory: the next tick ends it

    // Where it stands in its sequence; none for set_parameter by itself.
    std::shared_ptr<Execution> execution;  // until it has ended
    std::size_t node = 0;
};

}  // namespace rois
