// Query interface (7.4.2, table 4).
#include <algorithm>
#include <memory>
#include <utility>

#include "engine/core.hpp"
#include "types/texts.hpp"

namespace rois {

namespace {

// Who may answer a query, and with what; nothing when it is not asked yet.
struct Possible {
    RegisteredComponent* component;
    std::optional<Results> row;
    std::optional<ComponentStatus> status;  // asked for once
};

bool is_ready(Possible& possible, Session const& asker) {
    if (!possible.status) possible.status = possible.component->status_for(&asker);
    return possible.status == ComponentStatus::ready;
}

// So many components are sooner looked at than looked up by what a condition demands.
constexpr std::size_t few = 4;

// A component is asked only when the condition or SortBy may depend on what it answers; and nobody behind the one that will be
// chosen when nothing is sorted.
template <class RowsOf>
std::vector<Possible> who_may_answer(ComponentsInOrder able, Selection const& selection, Perspective& looked_at,
                                     RowsOf const& rows_of) {
    std::vector<Possible> found;
    while (auto* component = able.next()) {
        auto const& candidate = looked_at.candidate(*component);
        auto const match = selection.match(candidate);
        if (match == Match::no) continue;
        bool const ask = match == Match::maybe || selection.sorts();
        auto rows = ask ? rows_of(*component) : std::vector<Results>{};
        if (rows.empty() && match == Match::yes) found.push_back({component, {}, {}});
        for (auto& row : rows)
            if (selection.match(ToldCandidate{candidate, row}) == Match::yes) found.push_back({component, std::move(row), {}});
        if (!selection.sorts() && !found.empty() && found.back().component == component &&
            is_ready(found.back(), *looked_at.asker()))
            break;
    }
    return found;
}

// In the order of the selection, which sorts.
std::vector<Possible> in_order(Selection const& selection, std::vector<Possible> found, Perspective& looked_at) {
    std::vector<std::unique_ptr<ToldCandidate>> told;
    std::vector<Candidate const*> candidates;
    for (auto const& [component, row, status] : found) {
        candidates.push_back(&looked_at.candidate(*component));
        if (row) candidates.back() = told.emplace_back(std::make_unique<ToldCandidate>(*candidates.back(), *row)).get();
    }
    auto const places = selection.order(candidates);
    std::vector<Possible> ordered;
    ordered.reserve(found.size());
    for (auto const place : places) ordered.push_back(std::move(found[place]));
    return ordered;
}

}  // namespace

// Decision 18: the one component that knows the query type, preferring READY, then the lowest ref or what SortBy says; of its
// rows, the first that matches.
Reply Engine::Core::perform(Session& session, Query const& query, Instant now) {
    auto vocabulary = this->vocabulary(&registry_.results(MessageKind::query, query.query_type));
    vocabulary.first = Vocabulary::First::parameters;
    auto compiled = Selection::compile(query.condition, vocabulary);
    if (auto* problem = std::get_if<std::string>(&compiled))
        return refused<Query::Reply>(ReturnCode::bad_parameter, std::move(*problem));
    auto const& selection = std::get<Selection>(compiled);
    Perspective looked_at{registry_, places_, &session, Perspective::Of::present};
    auto const& able = registry_.with(MessageKind::query, query.query_type);
    auto meant = able.possible(able.all().size() > few ? selection.filter().demand() : std::nullopt);
    auto found = who_may_answer(std::move(meant), selection, looked_at, [&](RegisteredComponent& component) {
        return answers(session, component, query.query_type, now);
    });
    if (found.empty())
        return refused<Query::Reply>(ReturnCode::unsupported,
                                     "nothing that matches is answered to queries of the type " + quoted(query.query_type));
    if (selection.sorts()) found = in_order(selection, std::move(found), looked_at);
    auto const ready = std::ranges::find_if(found, [&](Possible& possible) { return is_ready(possible, session); });
    auto& chosen = ready == found.end() ? found.front() : *ready;
    if (!chosen.row) {
        auto rows = answers(session, *chosen.component, query.query_type, now);
        if (!rows.empty()) chosen.row = std::move(rows.front());
    }
    if (!chosen.row)
        return refused<Query::Reply>(ReturnCode::error,
                                     "the component " + quoted(chosen.component->ref().code) + " could not answer");
    Query::Reply reply;
    reply.component_ref = chosen.component->ref();
    reply.results = std::move(*chosen.row);
    return reply;
}

// Rows of results; none when it could not answer.
std::vector<Results> Engine::Core::answers(Session const& session, RegisteredComponent& component, std::string const& query_type,
                                           Instant now) {
    if (query_type == "component_status") {
        Results row;
        row.parameters.push_back(status_of("status", component.status_for(&session)));
        return one_row(std::move(row));
    }
    std::vector<Results> rows;
    if (query_type == "get_parameter") {
        if (auto parameters = component.all_parameters()) rows.push_back({std::move(*parameters), {}});
    } else {
        rows = component.answer(query_type, now);
    }
    if (!rows.empty()) component.succeeded();
    return rows;
}

}  // namespace rois
