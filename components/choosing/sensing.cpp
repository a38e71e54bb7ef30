#include "choosing/sensing.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "engine/frames/space.hpp"
#include "types/text/to_number.hpp"

namespace rois::choosing {

namespace {

using namespace std::chrono_literals;

constexpr double metre = 1'000;                             // mm
constexpr double default_heading_variance = 100;            // square degrees
constexpr double elsewhere = 0.05;                          // metres; a smaller change of an estimate is not reported
constexpr std::chrono::milliseconds default_interval{250};  // of minimum_interval
constexpr std::chrono::milliseconds one_event{1'500};       // equal events of several members within this time are reported once
constexpr std::chrono::milliseconds longest_pause{150};     // longest time between two lists of a member while persons move

std::chrono::milliseconds interval_of(ParameterList const& parameters) {
    auto const* given = find(parameters, "minimum_interval");
    if (given == nullptr || given->values.empty()) return default_interval;
    return std::chrono::milliseconds{to_number<std::int64_t>(given->values.front()).value_or(default_interval.count())};
}

std::string rounded(double millimetres) { return std::to_string(static_cast<std::int64_t>(std::lround(millimetres))); }

// The first two rows and columns of a covariance, in square metres.
std::optional<Matrix> covariance_of(Located const& located) {
    auto const* given = std::get_if<Located::Covariance>(&located.certainty);
    if (given == nullptr) return {};
    auto const size = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(given->rows.size()))));
    if (size < 2 || size * size != given->rows.size()) return {};
    Matrix matrix;
    matrix << given->rows[0], given->rows[1], given->rows[size], given->rows[size + 1];
    return matrix / (metre * metre);
}

// The third row of the covariance is that of the heading.
std::optional<Details::Heading> heading_of(Located const& located) {
    if (located.orientation.size() != 3) return {};
    auto const* given = std::get_if<Located::Covariance>(&located.certainty);
    bool const is_known = given != nullptr && given->rows.size() == 9;
    return Details::Heading{located.orientation[2], is_known ? given->rows[8] : default_heading_variance};
}

}  // namespace

Sensing::Sensing(ComponentDescription description, std::shared_ptr<Roster> roster, std::shared_ptr<Sightings> sightings)
    : Logical{std::move(description), std::move(roster)},
      sightings_{std::move(sightings)},
      events_{events_of(*Logical::description().profile)} {}

Sensing::~Sensing() {
    if (!is_attached()) return;  // the other logical components may be running on another thread
    end_sensing();
    sightings_->remove(*this);
}

void Sensing::attach(ComponentPort& port) {
    sightings_->add(*this);
    Logical::attach(port);
}

std::vector<Sensing::Event> Sensing::events_of(ComponentProfile const& profile) {
    std::vector<Event> events;
    for (auto const& message : profile.messages) {
        if (message.kind != MessageKind::event) continue;
        auto& event = events.emplace_back(Event{.type = message.name, .kind = message.name.substr(0, message.name.find('_'))});
        bool const has_names = find_parameter(message.results, event.kind + "_ref") != nullptr;
        if (has_names)
            event.reports = find_parameter(message.results, "position_data") != nullptr ? Reports::positions : Reports::names;
        else if (find_parameter(message.results, "number") != nullptr)
            event.reports = Reports::number;
    }
    return events;
}

Sensing::Event const* Sensing::find(std::string_view type) const {
    auto const found = std::ranges::find(events_, type, &Event::type);
    return found == events_.end() ? nullptr : &*found;
}

// --- Commands ---

std::optional<std::string> Sensing::why_never(std::string_view command_type) const {
    if (command_type == "start" || command_type == "set_parameter") return {};
    return "only one of its members could carry it out; use the member's ref";
}

std::vector<std::string> Sensing::candidates(ParameterList const&) {
    std::vector<std::string> refs;
    for (auto const* member : members())
        if (member->can_act()) refs.push_back(member->ref);
    return refs;
}

void Sensing::begin(std::string const& command_type, ParameterList const& parameters, CommandHandle command) {
    if (command_type == "set_parameter") return change_parameters(parameters, command);
    is_active_ = true;
    end_suspension();
    parameters_ = parameters;
    for (auto const& event : events_)
        if (event.reports == Reports::positions) sightings_->begin(event.kind);
    auto const first = std::make_shared<CommandHandle>(command);
    auto const refs = candidates(parameters);
    if (refs.empty()) return complete(first, {ReturnCode::error, none_is_free()});
    for (auto const& ref : refs) start(ref, first);
}

// `for_command`: the application's `start`, which completes with the first member that begins. Null: it has completed.
void Sensing::start(std::string const& ref, std::shared_ptr<CommandHandle> const& for_command) {
    started_.insert(ref);
    start_began();
    auto const failed = [this, ref, for_command](Outcome const& why) {
        started_.erase(ref);
        release_unused(ref);
        if (!is_active_) return;
        if (started_.empty()) complete(for_command, {why.return_code, ref + ": " + why.reason});
    };
    bind_member(ref, [this, ref, for_command, failed](Outcome const& bound) {
        if (!is_active_ || bound.return_code != ReturnCode::ok) {
            failed(bound);
            return start_ended();
        }
        auto const begun = [this, failed](Outcome const& outcome) {
            if (outcome.return_code != ReturnCode::ok) failed(outcome);
            start_ended();
        };
        command(ref, "start", parameters_, begun, [this, for_command, failed](Completed const& completed) {
            if (completed.status != CompletedStatus::ok) return failed({ReturnCode::error, completed.reason});
            complete(for_command, {});
        });
    });
}

void Sensing::complete(std::shared_ptr<CommandHandle> const& command, Outcome const& outcome) {
    if (command == nullptr || *command == CommandHandle{} || !is_active_) return;
    bool const is_good = outcome.return_code == ReturnCode::ok;
    port().completed(std::exchange(*command, {}), is_good ? CompletedStatus::ok : CompletedStatus::error, {},
                     is_good ? Afterwards::active : Afterwards::idle, outcome.reason);
    if (!is_good) end_sensing();
}

void Sensing::change_parameters(ParameterList const& parameters, CommandHandle changed) {
    parameters_ = parameters;
    auto const left = std::make_shared<std::size_t>(started_.size() + 1);
    auto const one_less = [this, left, changed] {
        if (--*left == 0) port().completed(changed, CompletedStatus::ok);
    };
    for (auto const& ref : started_)
        command(
            ref, "set_parameter", parameters,
            [one_less](Outcome const& outcome) {
                if (outcome.return_code != ReturnCode::ok) one_less();
            },
            [one_less](Completed const&) { one_less(); });
    one_less();
}

void Sensing::end_sensing() {
    for (auto const* member : members())
        if (started_.contains(member->ref)) lose(*member);
    if (std::exchange(is_active_, false))
        for (auto const& event : events_)
            if (event.reports == Reports::positions) sightings_->end(event.kind);
    started_.clear();
    counts_.clear();
    reported_number_.reset();
    reported_.clear();
    told_.clear();
    misplaced_.clear();
    faulty_.clear();
}

// The member does not sense any longer.
void Sensing::lose(Member const& member) {
    counts_.erase(member.ref);
    for (auto const& event : events_)
        if (auto* fusion = event.reports == Reports::positions ? sightings_->fusion_of(event.kind) : nullptr)
            fusion->lost(member.engine, sightings_->now());
}

// --- What the members sense ---

// A member that cannot sense is given back, also if it has not confirmed a halt: nothing moves, and the others go on.
void Sensing::changed(Member const& member) {
    if (!member.can_act()) {
        if (started_.erase(member.ref) > 0) lose(member);
        give_back(member.ref);
    } else if (is_active_ && !started_.contains(member.ref)) {
        start(member.ref, nullptr);
    }
}

Member const* Sensing::shown() {
    auto const& all = members();
    auto const found =
        std::ranges::find_if(all, [&](auto const* each) { return is_active_ ? started_.contains(each->ref) : each->can_act(); });
    return found == all.end() ? nullptr : *found;
}

void Sensing::happened(ReceiveEvent const& event, Member const& member, Instant now) {
    auto const* known = find(event.event_type);
    if (is_active_ && !is_suspended() && known != nullptr && started_.contains(member.ref)) take(*known, event, member, now);
}

void Sensing::take(Event const& event, ReceiveEvent const& received, Member const& member, Instant now) {
    auto const* number = rois::find(received.results->parameters, "number");
    switch (event.reports) {
        case Reports::positions:
            return take_positions(event, received, member, now);
        case Reports::names:
            return report_names(event, received, member, now);
        case Reports::number:
            if (number == nullptr || number->values.empty()) return;
            counts_[member.ref] = to_number<int>(number->values.front()).value_or(0);
            return report_number(event, now);
        case Reports::other:
            return report_once(event, *received.results, member, now);
    }
}

void Sensing::take_positions(Event const& event, ReceiveEvent const& received, Member const& member, Instant now) {
    auto const& results = *received.results;
    auto const* names = rois::find(results.parameters, event.kind + "_ref");
    auto const* positions = rois::find(results.parameters, "position_data");
    auto* fusion = sightings_->fusion_of(event.kind);
    if (names == nullptr || positions == nullptr || fusion == nullptr) return;
    sightings_->note_codebook(member.engine, names->data_type_ref.codebook_ref);
    std::vector<Sighting> sightings;
    for (std::size_t i = 0; i < names->values.size() && i < positions->values.size(); ++i) {
        auto const at = point(positions->values[i], {});
        if (!at) continue;
        auto& sighting = sightings.emplace_back(Sighting{names->values[i], Vector{at->low[0], at->low[1]} / metre});
        auto const located = std::ranges::find_if(
            results.located, [&](Located const& each) { return each.of == "position_data" && each.ref == sighting.name; });
        if (located == results.located.end()) continue;
        sighting.details.z = located->position[2] / metre;
        sighting.details.heading = heading_of(*located);
        sighting.covariance = covariance_of(*located);
    }
    fusion->configure(member.engine, {.period = interval_of(parameters_) + longest_pause});
    report_problems(member, fusion->sensed(member.engine, now.steady, sightings));
    has_news_ = true;
}

// Once, until a list of the member has no problem.
void Sensing::report_problems(Member const& member, Received const& received) {
    if (received.problems.empty()) {
        faulty_.erase(member.ref);
        return;
    }
    if (!faulty_.insert(member.ref).second) return;
    auto const& first = received.problems.front();
    auto const what = first.name.empty() ? std::string{} : quoted(first.name) + ": ";
    port().error(ErrorType::user_defined_error, member.ref + ": " + what + first.reason);
}

void Sensing::time_passed(Instant now) {
    if (!is_active_ || is_suspended()) return;
    for (auto const& event : events_) {
        auto* fusion = event.reports == Reports::positions ? sightings_->fusion_of(event.kind) : nullptr;
        if (fusion == nullptr) continue;
        report_misplaced(event);
        if (!fusion->take_changes().empty()) has_news_ = true;
        auto const since = now.steady - reported_at_;
        auto const interval = interval_of(parameters_);
        bool const is_due = since >= interval && (has_news_ || (since >= 2 * interval && differs(*fusion, now)));
        if (is_due) report_positions(event, now);
    }
    for (auto const& event : events_)
        if (event.reports == Reports::number && reported_number_ && sightings_->fusion_of(event.kind) != nullptr)
            report_number(event, now);
}

// Returns whether the present persons are others than in the last report, or somebody is elsewhere: the estimate changes also
// without a new list, such as when a person stops.
bool Sensing::differs(Fusion const& fusion, Instant now) const {
    std::size_t present = 0;
    for (auto const& person : fusion.persons(now.steady)) {
        if (person.sensed_by.empty()) continue;
        ++present;
        auto const told = told_.find(person.name);
        if (told == told_.end() || (told->second - person.position).norm() > elsewhere) return true;
    }
    return present != told_.size();
}

void Sensing::report_positions(Event const& event, Instant now) {
    has_news_ = false;
    bool const were_there = !std::exchange(told_, {}).empty();
    reported_at_ = now.steady;
    Results results;
    std::vector<std::string> names, points;
    auto const& frame = roster().frame();
    for (auto const& person : sightings_->fusion_of(event.kind)->persons(now.steady)) {
        if (person.sensed_by.empty()) continue;
        told_[person.name] = person.position;
        auto const position = person.position * metre;
        names.push_back(person.name);
        auto const& heading = person.details.heading;
        points.push_back(rounded(position.x()) + ", " + rounded(position.y()) +
                         (heading ? ", " + rounded(heading->degrees) : ""));
        Matrix const covariance = person.covariance * (metre * metre);
        auto& located = results.located.emplace_back(
            Located{.of = "position_data",
                    .ref = person.name,
                    .crs = frame,
                    .position = {position.x(), position.y(), person.details.z * metre},
                    .orientation = {},
                    .certainty = Located::Covariance{{covariance(0, 0), covariance(0, 1), covariance(1, 0), covariance(1, 1)}}});
        if (!heading) continue;
        located.orientation = {0, 0, heading->degrees};
        located.certainty = Located::Covariance{
            {covariance(0, 0), covariance(0, 1), 0, covariance(1, 0), covariance(1, 1), 0, 0, 0, heading->variance}};
    }
    if (!were_there && names.empty()) return;
    results.parameters = {date_time("timestamp", now.utc),
                          references(event.kind + "_ref", std::move(names), std::string{fused_codebook}),
                          positions("position_data", std::move(points), frame)};
    port().event(event.type, std::move(results));
}

// Replaces a member's own names by the fused ones. Other names stay, such as the permanent ones of an identification.
void Sensing::report_names(Event const& event, ReceiveEvent const& received, Member const& member, Instant now) {
    auto results = *received.results;
    auto const* fusion = sightings_->fusion_of(event.kind);
    for (auto& parameter : results.parameters) {
        if (fusion == nullptr || parameter.name != event.kind + "_ref") continue;
        for (auto& name : parameter.values) {
            auto const fused = fusion->own_name(member.engine, name);
            if (!fused) continue;
            name = *fused;
            parameter.data_type_ref.codebook_ref = fused_codebook;
        }
    }
    report_once(event, std::move(results), member, now);
}

// Reports equal events of several members within a short time once, and does not report what one member says and another hears.
void Sensing::report_once(Event const& event, Results results, Member const& member, Instant now) {
    if (event.kind == "speech" && roster().is_heard_by_others(member.engine, now.steady)) return;
    std::erase_if(reported_, [&](Reported const& each) { return now.steady - each.at > one_event; });
    auto content = results.parameters;
    std::erase_if(content, [](Parameter const& each) { return each.name == "timestamp"; });
    bool const is_known = std::ranges::any_of(reported_, [&](Reported const& each) {
        return each.engine != member.engine && each.type == event.type && each.content == content;
    });
    if (is_known) return;
    reported_.push_back({now.steady, member.engine, event.type, std::move(content)});
    port().event(event.type, std::move(results));
}

// Reports the size of the fused list; without such a list, the largest number of one member.
void Sensing::report_number(Event const& event, Instant now) {
    std::size_t number = 0;
    if (auto const* fusion = sightings_->fusion_of(event.kind)) {
        for (auto const& person : fusion->persons(now.steady))
            if (!person.sensed_by.empty()) ++number;
    }
    // Without positions; those of a person may come a little later than the number.
    if (number == 0) {
        for (auto const& [ref, count] : counts_) number = std::max(number, static_cast<std::size_t>(std::max(count, 0)));
    }
    if (reported_number_ == number) return;
    reported_number_ = number;
    port().event(event.type, {{date_time("timestamp", now.utc), integer("number", static_cast<std::int64_t>(number))}, {}});
}

// Reports a misplaced member once. The status is WARNING until it is placed correctly.
void Sensing::report_misplaced(Event const& event) {
    std::set<std::string> engines;
    for (auto const& each : sightings_->fusion_of(event.kind)->misplaced()) {
        engines.insert(each.unit);
        if (!misplaced_.contains(each.unit)) port().error(ErrorType::user_defined_error, each.text);
    }
    if (engines == misplaced_) return;
    misplaced_ = std::move(engines);
    show();
}

}  // namespace rois::choosing
