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

// For so few components, calling each is faster than looking them up by the demand of the condition.
constexpr std::size_t few = 4;

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

Query::Reply refused(ReturnCode code, std::string reason) { return rois::refused<Query::Reply>(code, std::move(reason)); }

}  // namespace

// A query that is being answered. It lives until the components that must be asked have answered.
class Engine::Core::Inquiry : public Questions::Round, public std::enable_shared_from_this<Inquiry> {
public:
    Inquiry(Core& core, SharedAsked asked, std::string query_type, Selection selection, Instant now)
        : core_{core},
          asked_{std::move(asked)},
          query_type_{std::move(query_type)},
          selection_{std::move(selection)},
          until_{now.steady + core.settings_.question_deadline} {}

    Later of_one_component(Session&, std::vector<RegisteredComponent*> const& able, Instant now);
    Later of_whole_engine(Session const&, std::vector<RegisteredComponent*> const& able, Instant now);

private:
    using Then = Later (Inquiry::*)(Session&, Instant now);
    // A component that may answer. `rows`: its answer; nullopt if it was not asked, or has not answered in time.
    struct Possible {
        SharedComponent component;
        bool needs_rows = false;  // the condition or SortBy may depend on them
        std::optional<std::vector<Results>> rows{};
    };
    // A row of results that matches; without a row, the component matches whatever it answers.
    struct Match {
        std::size_t place = 0;  // in possible_
        std::optional<std::size_t> row;
    };

    bool engine_knows() const { return query_type_ == "component_status" || query_type_ == "get_parameter"; }
    static bool is_ready(RegisteredComponent const& component, Session const& session) {
        return component.status_for(&session) == ComponentStatus::ready;
    }
    // Asks for the rows of the components that need them, or of one. `then` is called once all have answered, or at `due`.
    void ask_all(Steady due, Then then, Instant now);
    void ask(std::size_t place, Steady due, Then then, Instant now);
    void take(std::size_t place, std::optional<ComponentAnswer>&&) override;
    void end(Instant now) override;
    // Answers the operation, now or later.
    Later choose(Session&, Instant now);
    Later choose(Perspective&, Session&, Instant now);
    std::vector<Match> matches(Perspective&) const;
    void sort(std::vector<Match>&, Perspective&) const;
    Later next_match(Session&, Instant now);
    Later after_match(Session&, Instant now);
    Query::Reply answer(Session const&, Possible&, std::size_t row) const;
    Later joined(Session&, Instant now);
    Reply why_nobody_answered() const;

    Core& core_;
    SharedAsked asked_;
    std::string query_type_;
    Selection selection_;
    Steady until_;
    std::vector<Possible> possible_;
    Then then_ = nullptr;
    std::vector<Match> matches_;  // in order of preference, READY ones first
    std::size_t next_ = 0;        // of matches_
    bool is_late_ = false;        // a component did not answer in time
    std::string failed_;          // the ref of a component that could not answer
};

// Decision 18: one component that has the query type answers. The order is: READY components, then those of the robot that the
// session works with, then the order of SortBy, or the lowest code. The answer is the first row of the component that matches. If
// a component fails or does not answer in time, the next one is asked (decision 36).
Engine::Core::Later Engine::Core::perform(Session& session, Query const& query, SharedAsked const& asked, Instant now) {
    auto vocabulary = this->vocabulary(session, MessageKind::query, query.query_type);
    vocabulary.first = Vocabulary::First::parameters;
    auto compiled = Selection::compile(query.condition, vocabulary);
    if (auto* problem = std::get_if<std::string>(&compiled)) return refused(ReturnCode::bad_parameter, std::move(*problem));
    auto& selection = std::get<Selection>(compiled);
    auto const& able = registry_.with(MessageKind::query, query.query_type);
    bool const sees_all = may_see_everything(session.rights.get());
    bool const of_whole_engine = sees_all && !selection.filter().restricts() && !selection.sorts() && !able.all().empty();
    bool const looks_up = able.all().size() > few || !registry_.logical().empty();
    auto const demand = looks_up ? selection.filter().demand() : std::nullopt;
    auto meant = able.possible(demand, seen_by(session, selection.filter())).rest();
    auto const inquiry = std::make_shared<Inquiry>(*this, asked, query.query_type, std::move(selection), now);
    if (of_whole_engine && is_about_the_engine(query.query_type)) return inquiry->of_whole_engine(session, able.all(), now);
    Preference{session}.order(meant);
    return inquiry->of_one_component(session, meant, now);
}

// The rows that the engine knows itself.
std::vector<Results> Engine::Core::known_answer(Session const& session, RegisteredComponent& component,
                                                std::string const& query_type) {
    Results row;
    if (query_type == "component_status") {
        row.parameters.push_back(status_of("status", component.status_for(&session)));
        return one_row(std::move(row));
    }
    auto parameters = component.all_parameters(&session);
    if (!parameters) return {};
    row.parameters = std::move(*parameters);
    return one_row(std::move(row));
}

// Without sorting, the first READY component that matches without its results is the last one that is considered: later ones
// would be asked only if all earlier ones failed.
Engine::Core::Later Engine::Core::Inquiry::of_one_component(Session& session, std::vector<RegisteredComponent*> const& able,
                                                            Instant now) {
    auto looked_at = core_.perspective(&session, Perspective::Of::present);
    bool has_choice = false;
    for (auto* component : able) {
        auto const match = selection_.match(looked_at.candidate(*component));
        if (match == rois::Match::no) continue;
        bool const needs_rows = match == rois::Match::maybe || selection_.sorts();
        if (has_choice && needs_rows) continue;
        possible_.push_back({component->shared_from_this(), needs_rows});
        if (has_choice) break;
        has_choice = !needs_rows && is_ready(*component, session);
    }
    bool const asks = std::ranges::any_of(possible_, &Possible::needs_rows);
    if (asks && !engine_knows()) {
        ask_all(until_, &Inquiry::choose, now);
        return {};
    }
    for (auto& possible : possible_)
        if (possible.needs_rows) possible.rows = known_answer(session, *possible.component, query_type_);
    return choose(looked_at, session, now);
}

void Engine::Core::Inquiry::ask_all(Steady due, Then then, Instant now) {
    for (std::size_t place = 0; place < possible_.size(); ++place)
        if (possible_[place].needs_rows) ask(place, due, then, now);
}

void Engine::Core::Inquiry::ask(std::size_t place, Steady due, Then then, Instant now) {
    then_ = then;
    Questions::begin(*this, due);
    auto& component = *possible_[place].component;
    auto const ticket = core_.questions_.add(shared_from_this(), place, component,
                                             "the component did not answer a query within question_deadline");
    component.hosted().query(ticket, query_type_, now);
}

void Engine::Core::Inquiry::end(Instant now) {
    core_.answer_later(asked_, [&](Session& asker) -> Later {
        auto const turn = core_.turn_of(asker, now);
        try {
            return (this->*then_)(asker, now);
        } catch (TooMuchEffort const&) {
            return core_.too_much_effort<Query::Reply>();
        }
    });
}

void Engine::Core::Inquiry::take(std::size_t place, std::optional<ComponentAnswer>&& answer) {
    if (!answer) {
        is_late_ = true;
        return;
    }
    auto& possible = possible_[place];
    if (auto* rows = std::get_if<std::vector<Results>>(&*answer)) {
        auto accepted = possible.component->accepted(query_type_, std::move(*rows));
        if (!accepted.empty()) possible.component->clear_failure();
        possible.rows = std::move(accepted);
    }
    if (!possible.rows || possible.rows->empty()) failed_ = possible.component->ref().code;
}

// A component that matches maybe, and has not answered, does not match. One that has matched before it was asked still matches.
std::vector<Engine::Core::Inquiry::Match> Engine::Core::Inquiry::matches(Perspective& looked_at) const {
    std::vector<Match> found;
    for (std::size_t place = 0; place < possible_.size(); ++place) {
        auto const& candidate = looked_at.candidate(*possible_[place].component);
        auto const& rows = possible_[place].rows;
        if (!rows || rows->empty()) {
            if (selection_.match(candidate) == rois::Match::yes) found.push_back({place, {}});
            continue;
        }
        for (std::size_t row = 0; row < rows->size(); ++row)
            if (selection_.match(MessageCandidate{candidate, (*rows)[row]}) == rois::Match::yes) found.push_back({place, row});
    }
    return found;
}

void Engine::Core::Inquiry::sort(std::vector<Match>& found, Perspective& looked_at) const {
    std::vector<std::unique_ptr<MessageCandidate>> with_results;
    std::vector<Candidate const*> candidates;
    for (auto const& [place, row] : found) {
        candidates.push_back(&looked_at.candidate(*possible_[place].component));
        if (!row) continue;
        auto const& results = (*possible_[place].rows)[*row];
        candidates.back() = with_results.emplace_back(std::make_unique<MessageCandidate>(*candidates.back(), results)).get();
    }
    std::vector<Match> ordered;
    ordered.reserve(found.size());
    for (auto const place : selection_.order(candidates)) ordered.push_back(found[place]);
    found = std::move(ordered);
    Preference{*looked_at.asker()}.bring_forward(found,
                                                 [&](Match const& match) { return possible_[match.place].component.get(); });
}

Engine::Core::Later Engine::Core::Inquiry::choose(Session& session, Instant now) {
    auto looked_at = core_.perspective(&session, Perspective::Of::present);
    return choose(looked_at, session, now);
}

Engine::Core::Later Engine::Core::Inquiry::choose(Perspective& looked_at, Session& session, Instant now) {
    matches_ = matches(looked_at);
    if (matches_.empty() && (is_late_ || !failed_.empty())) return why_nobody_answered();
    if (matches_.empty())
        return refused(ReturnCode::unsupported, "no component that matches the condition answers query " + quoted(query_type_));
    if (selection_.sorts()) sort(matches_, looked_at);
    std::ranges::stable_partition(matches_,
                                  [&](Match const& match) { return is_ready(*possible_[match.place].component, session); });
    return next_match(session, now);
}

// Answers with the first row that matches. A match without a row is asked for it; if it does not answer in half of the remaining
// time, or fails, the next match has its turn.
Engine::Core::Later Engine::Core::Inquiry::next_match(Session& session, Instant now) {
    while (next_ < matches_.size()) {
        auto& [place, row] = matches_[next_++];
        auto& possible = possible_[place];
        auto& [component, was_asked, rows] = possible;
        if (!row && engine_knows()) {
            rows = known_answer(session, *component, query_type_);
            if (!rows->empty()) row = 0;
            if (!row) failed_ = component->ref().code;
        }
        if (row) return answer(session, possible, *row);
        if (was_asked || engine_knows()) continue;
        bool const is_last = next_ == matches_.size();
        auto const due = is_last ? until_ : now.steady + (until_ - now.steady) / 2;
        was_asked = true;
        ask(place, due, &Inquiry::after_match, now);
        return {};
    }
    return why_nobody_answered();
}

// The match before next_ was asked.
Engine::Core::Later Engine::Core::Inquiry::after_match(Session& session, Instant now) {
    auto& match = matches_[next_ - 1];
    auto& rows = possible_[match.place].rows;
    if (rows && !rows->empty()) {
        match.row = 0;
        --next_;
    }
    return next_match(session, now);
}

// Another engine receives all rows, because it applies the condition of its application itself.
Query::Reply Engine::Core::Inquiry::answer(Session const& session, Possible& possible, std::size_t row) const {
    auto& rows = *possible.rows;
    Query::Reply reply;
    reply.component_ref = possible.component->ref();
    reply.results = std::move(rows[row]);
    if (session.is_engine && rows.size() > 1) {
        rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(row));
        reply.other_rows = std::move(rows);
    }
    return reply;
}

Reply Engine::Core::Inquiry::why_nobody_answered() const {
    if (is_late_)
        return refused(ReturnCode::timeout, "no component answered the query " + quoted(query_type_) + " within " +
                                                in_seconds(core_.settings_.question_deadline));
    return refused(ReturnCode::error, "the component " + quoted(failed_) + " could not answer");
}

// One component of each engine answers, in the order of the engines' names: READY components before others, then the lowest code.
// If an engine cannot answer, its position is missing and its status is ERROR. The answer names the component of the first
// engine.
Engine::Core::Later Engine::Core::Inquiry::of_whole_engine(Session const& session, std::vector<RegisteredComponent*> const& able,
                                                           Instant now) {
    using Choice = std::pair<bool, RegisteredComponent*>;  // the bool: is not READY
    std::map<std::string_view, Choice> chosen;             // by engine
    for (auto* component : able) {
        Choice const choice{!is_ready(*component, session), component};
        auto const [place, added] = chosen.try_emplace(component->entry().engine, choice);
        if (!added && choice.first < place->second.first) place->second = choice;
    }
    for (auto const& [engine, choice] : chosen) possible_.push_back({choice.second->shared_from_this(), true});
    ask_all(until_, &Inquiry::joined, now);
    return {};
}

Engine::Core::Later Engine::Core::Inquiry::joined(Session&, Instant) {
    Query::Reply reply;
    bool has_failed = false, has_answered = false;
    for (auto& [component, needs_rows, rows] : possible_) {
        if (!rows || rows->empty()) {
            has_failed = true;
            continue;
        }
        if (!has_answered) {
            reply.component_ref = component->ref();
            reply.results = std::move(rows->front());
        } else {
            join(reply.results, std::move(rows->front()));
        }
        has_answered = true;
    }
    if (!has_answered) return why_nobody_answered();
    if (has_failed && query_type_ == "engine_status") {
        Results failed;
        failed.parameters.push_back(status_of("status", ComponentStatus::error));
        join(reply.results, std::move(failed));
    }
    return reply;
}

}  // namespace rois
