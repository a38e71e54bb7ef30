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

    // The steps of ending it. Each step is done once. A later tick repeats a step that failed.
    bool told = false;      // the journal and the session were notified
    bool kept = false;      // the result is among the session's results
    bool finished = false;  // no step is left
    bool given_up = false;  // it failed for lack of memory: the next tick ends it

    // Where it stands in its sequence; none for set_parameter by itself.
    std::shared_ptr<Execution> execution;  // until it has ended
    std::size_t node = 0;
};

}  // namespace rois
