// The client library of RoIS Gateway: a service application's side of the engine (docs/client-cpp.md).
//
//     rois::Client client;
//     client.wait([](rois::Client& robot) -> rois::Task<> {
//         auto navigation = co_await robot.bind_any<rois::Navigation>();
//         co_await navigation.go_to("desk");
//     }(client));
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

// A connection with what applications do with one. What the engine refuses is thrown as Error; the operations themselves, with
// their return codes as values, are Connection::call.
class Client : public Connection {
public:
    using Connection::Connection;

    // Binds the component that is named, or any free one that is meant.
    Task<Component> bind(std::string ref);
    Task<Component> bind_any(QueryExpression condition);

    // The same, of this type: bind_any<Navigation>(), bind<Navigation>("sub1.navigation").
    template <class Facade>
    Task<Facade> bind(std::string ref) {
        auto component = co_await bind(std::move(ref));
        co_return Facade{std::move(component)};
    }
    template <class Facade>
    Task<Facade> bind_any(QueryExpression condition = {}) {
        auto const of_type = conditions::type == Facade::component_type;
        auto narrower = narrowed(std::move(condition), of_type);
        auto component = co_await bind_any(std::move(narrower));
        co_return Facade{std::move(component)};
    }

    // A component without binding it: for queries and events.
    Component component(std::string ref) const;

    Task<std::vector<Identifier>> search(QueryExpression condition = {});
    Task<GetProfile::Reply> get_profile(QueryExpression condition = {});
    // The results name who answered.
    Task<Query::Reply> query(std::string query_type, QueryExpression condition = {});
    Task<Results> get_error_detail(ErrorId);

    // Commands in sequence and in parallel; one Command for each, in document order. Ids that are empty are given here.
    Task<std::vector<Command>> execute(CommandUnitSequence);

    // The events of all components that are meant; see Component::events for those of one.
    Task<EventStream> subscribe(std::string event_type, QueryExpression condition = {});
    template <class E>
    Task<Events<E>> events(QueryExpression condition = {}) {
        auto stream = co_await subscribe(std::string{E::name}, std::move(condition));
        co_return Events<E>{std::move(stream)};
    }
};

// A unit of a sequence: one command.
CommandUnit command(Component const&, std::string command_type, ParameterList arguments = {}, Milliseconds delay = {});

}  // namespace rois
