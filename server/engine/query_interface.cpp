// Query interface (7.4.2, table 4).
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <utility>

#include "engine/commands/preference.hpp"
#include "engine/core.hpp"
#include "types/data_type.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

// A component that may answer a query, with its row of results; nullopt if it was not asked yet.
struct Possible {
    RegisteredComponent* component;
    std::optional<Results> row;
    std::optional<ComponentStatus> status;  // cached
};

bool is_ready(Possible& possible, Session const& asker) {
    if (!possible.status) possible.status = possible.component->status_for(&asker);
    return possible.status == ComponentStatus::ready;
}

// For so few components, calling each is faster than looking them up by the demand of the condition.
constexpr std::size_t few = 4;

// Asks a component only if the condition or SortBy may depend on its answer. Without sorting, stops at the component that will be
// chosen.
template <class RowsOf>
std::vector<Possible> possible_answers(std::vector<RegisteredComponent*> const& able, Selection const& selection,
                                       Perspective& looked_at, RowsOf const& rows_of) {
    std::vector<Possible> found;
    for (auto* component : able) {
        auto const& candidate = looked_at.candidate(*component);
        auto const match = selection.match(candidate);
        if (match == Match::no) continue;
        bool const ask = match == Match::maybe || selection.sorts();
        auto rows = ask ? rows_of(*component) : std::vector<Results>{};
        if (rows.empty() && match == Match::yes) found.push_back({component, {}, {}});
        for (auto& row : rows)
            if (selection.match(MessageCandidate{candidate, row}) == Match::yes) found.push_back({component, std::move(row), {}});
        if (!selection.sorts() && !found.empty() && found.back().component == component &&
            is_ready(found.back(), *looked_at.asker()))
            break;
    }
    return found;
}

// Sorts by the selection, which must have a sort order.
std::vector<Possible> in_order(Selection const& selection, std::vector<Possible> found, Perspective& looked_at) {
    std::vector<std::unique_ptr<MessageCandidate>> with_results;
    std::vector<Candidate const*> candidates;
    for (auto const& [component, row, status] : found) {
        candidates.push_back(&looked_at.candidate(*component));
        if (row)
            candidates.back() = with_results.emplace_back(std::make_unique<MessageCandidate>(*candidates.back(), *row)).get();
    }
    auto const places = selection.order(candidates);
    std::vector<Possible> ordered;
    ordered.reserve(found.size());
    for (auto const place : places) ordered.push_back(std::move(found[place]));
    return ordered;
}

// The queries of System Information: it "belongs to the HRI engine" (7.6.1).
bool is_about_the_engine(std::string_view query_type) { return query_type == "robot_position" || query_type == "engine_status"; }

std::ptrdiff_t badness(std::string_view status) {
    static constexpr std::array<std::string_view, 5> from_good_to_bad{"READY", "BUSY", "WARNING", "UNINITIALIZED", "ERROR"};
    return std::ranges::find(from_good_to_bad, status) - from_good_to_bad.begin();
}

std::string const& first_value(Parameter const& parameter) {
    static std::string const none;
    return parameter.values.empty() ? none : parameter.values.front();
}

// Adds the answer of another engine: entries to the lists; of single values, the worst status, the earliest time of measurement,
// and the time since which all of them operate.
void join(Results& whole, Results part) {
    auto const operates = [](Results const& results) { return find(results.parameters, "operable_time") != nullptr; };
    bool const all_operate = operates(whole) && operates(part);
    for (auto& added : part.parameters) {
        auto const known = std::ranges::find(whole.parameters, added.name, &Parameter::name);
        if (known == whole.parameters.end()) {
            whole.parameters.push_back(std::move(added));
        } else if (DataType::of(known->data_type_ref).list) {
            known->values.insert(known->values.end(), added.values.begin(), added.values.end());
        } else if (known->name == "status"      ? badness(first_value(*known)) < badness(first_value(added))
                   : known->name == "timestamp" ? first_value(added) < first_value(*known)
                                                : first_value(*known) < first_value(added)) {
            known->values = std::move(added.values);
        }
    }
    if (!all_operate) std::erase_if(whole.parameters, [](Parameter const& each) { return each.name == "operable_time"; });
    whole.located.insert(whole.located.end(), part.located.begin(), part.located.end());
}

}  // namespace

// Decision 18: one component that has the query type answers. The order is: READY components, then those of the robot that the
// session works with, then the order of SortBy, or the lowest code. The answer is the first row of the component that matches.
Reply Engine::Core::perform(Session& session, Query const& query, Instant now) {
    auto vocabulary = this->vocabulary(&registry_.results(MessageKind::query, query.query_type));
    vocabulary.first = Vocabulary::First::parameters;
    auto compiled = Selection::compile(query.condition, vocabulary);
    if (auto* problem = std::get_if<std::string>(&compiled))
        return refused<Query::Reply>(ReturnCode::bad_parameter, std::move(*problem));
    auto const& selection = std::get<Selection>(compiled);
    auto const& able = registry_.with(MessageKind::query, query.query_type);
    bool const of_whole_engine = !selection.filter().restricts() && !selection.sorts() && !able.all().empty();
    if (of_whole_engine && is_about_the_engine(query.query_type)) return answer_of_whole_engine(session, query.query_type, now);
    Perspective looked_at{registry_, places_, &session, Perspective::Of::present};
    Preference const preference{session};
    auto meant = able.possible(able.all().size() > few ? selection.filter().demand() : std::nullopt).rest();
    preference.order(meant);
    auto found = possible_answers(meant, selection, looked_at, [&](RegisteredComponent& component) {
        return answers(session, component, query.query_type, now);
    });
    if (found.empty())
        return refused<Query::Reply>(ReturnCode::unsupported,
                                     "no component that matches the condition answers query " + quoted(query.query_type));
    if (selection.sorts()) {
        found = in_order(selection, std::move(found), looked_at);
        preference.bring_forward(found, &Possible::component);
    }
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

// One component of each engine answers, in the order of the engines' names: READY components before others, then the lowest code.
// If an engine cannot answer, its position is missing and its status is ERROR. The answer names the component of the first
// engine.
Reply Engine::Core::answer_of_whole_engine(Session const& session, std::string const& query_type, Instant now) {
    using Choice = std::pair<bool, RegisteredComponent*>;  // the bool: is not READY
    std::map<std::string_view, Choice> chosen;             // by engine
    for (auto* component : registry_.with(MessageKind::query, query_type).all()) {
        Choice const choice{component->status_for(&session) != ComponentStatus::ready, component};
        auto const [place, added] = chosen.try_emplace(component->entry().engine, choice);
        if (!added && choice.first < place->second.first) place->second = choice;
    }
    Query::Reply reply;
    bool has_failed = false, has_answered = false;
    for (auto const& [engine, choice] : chosen) {
        auto* component = choice.second;
        auto rows = answers(session, *component, query_type, now);
        if (rows.empty()) {
            has_failed = true;
            continue;
        }
        if (!has_answered) {
            reply.component_ref = component->ref();
            reply.results = std::move(rows.front());
        } else {
            join(reply.results, std::move(rows.front()));
        }
        has_answered = true;
    }
    if (!has_answered)
        return refused<Query::Reply>(ReturnCode::error,
                                     "the component " + quoted(chosen.begin()->second.second->ref().code) + " could not answer");
    if (has_failed && query_type == "engine_status") {
        Results failed;
        failed.parameters.push_back(status_of("status", ComponentStatus::error));
        join(reply.results, std::move(failed));
    }
    return reply;
}

// Rows of results; none if the component could not answer.
std::vector<Results> Engine::Core::answers(Session const& session, RegisteredComponent& component, std::string const& query_type,
                                           Instant now) {
    if (query_type == "component_status") {
        Results row;
        row.parameters.push_back(status_of("status", component.status_for(&session)));
        return one_row(std::move(row));
    }
    std::vector<Results> rows;
    if (query_type == "get_parameter") {
        if (auto parameters = component.all_parameters(&session)) rows.push_back({std::move(*parameters), {}});
    } else {
        rows = component.answer(query_type, now);
    }
    if (!rows.empty()) component.clear_failure();
    return rows;
}

}  // namespace rois
