// Query interface (7.4.2, table 4).
#include <utility>

#include "engine/core.hpp"
#include "types/texts.hpp"

namespace rois {

// Decision 18: the one component that knows the query type, preferring READY, then the lowest ref or what SortBy says.
Reply Engine::Core::perform(Session& session, Query const& query, Instant now) {
    auto compiled = Selection::compile(query.condition, vocabulary());
    if (auto* problem = std::get_if<std::string>(&compiled))
        return refused<Query::Reply>(ReturnCode::bad_parameter, std::move(*problem));
    auto const& selection = std::get<Selection>(compiled);
    auto const& able = registry_.with(MessageKind::query, query.query_type);
    Perspective looked_at{registry_, places_, &session, Perspective::Of::present};
    RegisteredComponent* chosen = nullptr;
    for (auto* component : selection.sorts() ? select(selection, able, session) : able) {
        if (selection.match(looked_at.candidate(*component)) != Match::yes) continue;
        bool const ready = component->status_for(&session) == ComponentStatus::ready;
        if (chosen == nullptr || ready) chosen = component;
        if (ready) break;
    }
    if (chosen == nullptr)
        return refused<Query::Reply>(ReturnCode::unsupported,
                                     "no component that matches answers queries of the type " + quoted(query.query_type));
    return answer(session, *chosen, query.query_type, now);
}

Reply Engine::Core::answer(Session& session, RegisteredComponent& component, std::string const& query_type, Instant now) {
    Query::Reply reply;
    reply.component_ref = component.ref();
    if (query_type == "component_status") {
        reply.results.parameters.push_back(status_of("status", component.status_for(&session)));
        return reply;
    }
    std::optional<Results> results;
    if (query_type == "get_parameter") {
        if (auto parameters = component.all_parameters()) results = Results{std::move(*parameters), {}};
    } else {
        results = component.answer(query_type, now);
    }
    if (results) {
        component.failed = false;
        reply.results = std::move(*results);
        return reply;
    }
    return refused<Query::Reply>(ReturnCode::error, "the component " + quoted(component.ref().code) + " could not answer");
}

}  // namespace rois
