// The client library of RoIS Gateway: a service application's side of the engine (docs/client-cpp.md).
//
//     rois::Client client;
//     client.wait([](rois::Client& robot) -> rois::Task<> {
//         auto navigation = co_await robot.bind_any<rois::Navigation>();
//         co_await navigation.go_to("desk");
//     }(client));
//
// Threads: as connection.hpp says, any thread may call the functions, and coroutines continue on the client's thread.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "rois/component.hpp"
#include "rois/components.hpp"
#include "rois/condition.hpp"
#include "rois/connection.hpp"
#include "rois/error.hpp"
#include "rois/events.hpp"
#include "rois/everything.hpp"
#include "rois/settings.hpp"
#include "rois/task.hpp"
#include "rois/units.hpp"

namespace rois {

// A connection with one function for each operation of an application. The functions throw Error if the engine refuses the
// operation; Connection::call returns the return code instead. The client owns its connection and closes it when it is destroyed.
// Handles (Component, Command, EventStream) may outlive it.
class Client : public Connection {
public:
    using Connection::Connection;

    // Binds the named component, or any free one that meets the condition. `switching`: what happens to a `start` if the member
    // that acts for a logical component fails (docs/choosing.md). Observers then receive each Switched.
    Task<Component> bind(std::string ref, Switching switching = Switching::none);
    Task<Component> bind_any(QueryExpression condition, Switching switching = Switching::none);

    // Binds the component also if another session has bound it: halts it first, and takes it from that session. For
    // administrators (docs/trust.md).
    Task<Component> take_over(std::string ref, Switching switching = Switching::none);

    // The same as bind and bind_any with the type of the component: bind_any<Navigation>(), bind<Navigation>("sub1.navigation").
    template <class Facade>
    Task<Facade> bind(std::string ref, Switching switching = Switching::none) {
        auto component = co_await bind(std::move(ref), switching);
        co_return Facade{std::move(component)};
    }
    template <class Facade>
    Task<Facade> bind_any(QueryExpression condition = {}, Switching switching = Switching::none) {
        auto const of_type = conditions::type == Facade::component_type;
        auto narrower = narrowed(std::move(condition), of_type);
        auto component = co_await bind_any(std::move(narrower), switching);
        co_return Facade{std::move(component)};
    }

    // Returns a component without binding it, for queries and events.
    Component component(std::string ref) const;

    Task<std::vector<Identifier>> search(QueryExpression condition = {});
    Task<GetProfile::Reply> get_profile(QueryExpression condition = {});
    // The reply names the component that answered.
    Task<Query::Reply> query(std::string query_type, QueryExpression condition = {});
    Task<Results> get_error_detail(ErrorId);

    // Runs commands in sequence and in parallel. Returns one Command for each, in document order. Fills in empty command ids.
    Task<std::vector<Command>> execute(CommandUnitSequence);

    // Subscribes to the events of all components that meet the condition. For one component, see Component::events.
    Task<EventStream> subscribe(std::string event_type, QueryExpression condition = {});
    template <class E>
    Task<Events<E>> events(QueryExpression condition = {}) {
        auto stream = co_await subscribe(std::string{E::name}, std::move(condition));
        co_return Events<E>{std::move(stream)};
    }
};

// Returns a unit of a sequence with one command.
CommandUnit command(Component const&, std::string command_type, ParameterList arguments = {}, Milliseconds delay = {});

}  // namespace rois
