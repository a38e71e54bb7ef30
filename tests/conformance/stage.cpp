#include "conformance/stage.hpp"

#include <algorithm>
#include <array>
#include <ctime>

#include "kit/line.hpp"

namespace rois::conformance {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds longest_check{60};  // or six times the patience, when that is longer
constexpr std::chrono::hours clocks_differ{1};     // at most, the gateway's and this one

// "2026-11-22T10:00:00", before which nothing that is still to come can be.
std::string now_less_tolerance() {
    auto const time = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now() - clocks_differ);
    std::tm utc{};
    gmtime_r(&time, &utc);
    std::array<char, 32> text;
    return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &utc)};
}

std::string in_ssml(std::string const& content) {
    return R"(<speak version="1.0" xmlns="http://www.w3.org/2001/10/synthesis" xml:lang="en">)" + content + "</speak>";
}

}  // namespace

Stage::Stage(kit::Address address, Way way, Catalogue const& catalogue, Traffic& traffic, double room)
    : address_{std::move(address)},
      way_{way},
      catalogue_{catalogue},
      traffic_{traffic},
      room_{room},
      end_{std::chrono::steady_clock::now() + std::max<Clock::duration>(longest_check, 6 * address_.patience)} {}

Component const& Stage::one_of(std::vector<std::string> const& kinds) const {
    for (auto const& kind : kinds)
        for (auto const& component : catalogue_.components)
            if (component.basic() == kind) return component;
    throw NotPlayed{"there is no component of the type " + list(kinds)};
}

Component const& Stage::detector() const {
    std::vector<std::string> const kinds{"persondetection", "facedetection", "sounddetection"};
    for (auto const& kind : kinds)
        for (auto const& component : catalogue_.components)
            if (component.basic() == kind && component.event(component.detection())) return component;
    throw NotPlayed{"there is no component of the type " + list(kinds) + " that tells what it detects"};
}

std::pair<Component const*, Component const*> Stage::two_common() const {
    std::vector<Component const*> common;
    for (auto const& component : catalogue_.components)
        if (component.is_common) common.push_back(&component);
    if (common.size() < 2) throw NotPlayed{"there are no two components with start and stop"};
    for (auto one = common.begin(); one != common.end(); ++one)
        for (auto other = one + 1; other != common.end(); ++other)
            if ((*one)->engine == (*other)->engine) return {*one, *other};
    return {common[0], common[1]};
}

double Stage::room() const {
    if (room_ == 0) throw NotPlayed{"the robot may not move (--room 0)"};
    return room_;
}

void Stage::mind_the_time() const {
    require(std::chrono::steady_clock::now() < end_, "the check has taken too long (a minute, or six times the patience)");
}

Guest::Guest(Stage& stage, Comes comes) : Application{kit::wire_to(stage.address(), stage.way())}, stage_{stage} {
    if (comes == Comes::connected) ok(connect());
}

Guest::~Guest() {
    kept_.clear();
    try {
        ask_for_details();
        leave();
    } catch (std::exception const&) {
        // The check has failed already, or another one will: this gateway does not answer.
    }
}

void Guest::take(Component const& component) {
    auto const answer = bind(component.ref);
    if (answer.return_code() == "OUT_OF_RESOURCES") throw NotPlayed{"another application uses " + component.ref};
    ok(answer);
    kept_.try_emplace(component.ref, *this, component);
}

std::string Guest::order(Command const& command) {
    auto const ids = kit::command_ids(ok(execute(command)));
    require(ids.size() == 1, "the answer should name one command");
    return first("a command", ids);
}

std::string Guest::status_of(std::string const& command_id) {
    require(!command_id.empty() && commands_.contains(command_id), "no answer has named the command \"" + command_id + "\"");
    return Application::status_of(command_id);
}

std::optional<Document> Guest::heard_since(std::size_t before, std::string const& event_type, std::string const& ref) const {
    auto const is_it = [&](Document const& heard) {
        return heard.text("event_type") == event_type && (ref.empty() || heard.ref() == ref);
    };
    auto const found = std::find_if(history().begin() + static_cast<std::ptrdiff_t>(before), history().end(), is_it);
    return found == history().end() ? std::nullopt : std::optional{*found};
}

Document Guest::start_until(Component const& component, std::string const& event_type) {
    auto const before = history().size();
    require_success(order(command(component, "start")), component);
    auto heard = heard_since(before, event_type, component.ref);
    while (!heard || heard->ref() != component.ref) heard = hear_event(event_type);
    return *heard;
}

void Guest::require_success(std::string const& command_id, Component const& component) {
    auto const known = endings(command_id);
    auto const status = known.empty() ? status_of(command_id) : known.front();
    if (status == "OUT_OF_RESOURCES") throw NotPlayed{"another application uses what " + component.ref + " needs"};
    auto const is_error = [](Document const& heard) { return heard.name() == "receive_error"; };
    if ((status == "ERROR" || status == "TIMEOUT") && (std::ranges::any_of(history(), is_error) || is_error(hear())))
        throw NotPlayed{component.ref + " has failed: " + status};
    same("the status of the command of " + component.ref, "OK", status);
}

Keeping::Keeping(Guest& guest, Component const& component)
    : guest_{guest}, component_{component}, before_{guest.get_parameter(component.ref).values("parameters")} {}

// One by one: a refused parameter does not affect the others.
Keeping::~Keeping() {
    try {
        auto const answer = guest_.get_parameter(component_.ref);
        if (answer.return_code() != "OK") return;
        auto const now = answer.values("parameters");
        for (auto const& [name, type, default_value] : component_.parameters) {
            auto const before = before_.find(name);
            auto const after = now.find(name);
            if (before == before_.end() || (after != now.end() && after->second == before->second)) continue;
            guest_.set_parameter(component_.ref, {{name, type, before->second}});
        }
    } catch (std::exception const&) {
        // The gateway does not answer any more, which the check has said.
    }
}

void Guest::settle(Component const& component) { ending(command(component, "resume")); }

std::string Guest::state_of(std::string const& command_id) {
    return value_of(ok(get_command_result(command_id)).values(), "status");
}

std::string Guest::component_status(std::string const& ref) {
    return value_of(ok(query("component_status", kit::where(kit::equal("component_ref", ref)))).values(), "status");
}

Component const* Guest::teller_of(Component const& component) const {
    std::vector<Component const*> tellers;
    for (auto const& each : stage_.catalogue().components)
        if (each.engine == component.engine && each.query("robot_position")) tellers.push_back(&each);
    return tellers.size() == 1 ? tellers.front() : nullptr;
}

// It is the one of which the engine of the component tells: another engine's query would be of another robot (decision 18).
std::optional<Robot> Guest::robot_of(Component const& component) {
    auto const* const teller = teller_of(component);
    if (!teller) return {};
    auto const told = query("robot_position", only(*teller)).values();
    auto const refs = told.find("robot_ref"), positions = told.find("position_data");
    if (refs == told.end() || refs->second.size() != 1) return {};
    if (positions == told.end() || positions->second.size() != 1) return {};
    return Robot{refs->second.front(), positions->second.front()};
}

std::vector<std::string> Guest::endings(std::string const& command_id) const {
    std::vector<std::string> statuses;
    for (auto const& heard : history())
        if (heard.name() == "completed" && heard.text("command_id") == command_id) statuses.push_back(heard.text("status"));
    return statuses;
}

std::size_t Guest::heard_events(std::string const& type) const {
    return static_cast<std::size_t>(
        std::ranges::count_if(history(), [&](Document const& heard) { return heard.text("event_type") == type; }));
}

void Guest::check_answer(Document const& answer, std::string const& operation, std::string const& request_id) {
    stage_.mind_the_time();
    auto& traffic = stage_.traffic();
    traffic.validate(answer.as_received());
    bool const is_fault = !answer.fault().empty();
    traffic.see("answers_belong_to_their_requests",
                answer.attribute("request_id") == request_id && (is_fault || answer.name() == operation + "_response"),
                operation + " with the request_id " + request_id + " was answered with " + answer.whole());
    if (!is_fault && answer.return_code() != "OK")
        traffic.see("refusals_give_a_reason", answer.children() == std::vector<std::string>{"reason"} && !answer.reason().empty(),
                    answer.whole());
    if (answer.return_code() != "OK") return;
    traffic.look_at_located(answer.root().child("results"));
    if (operation == "connect" && !is_connected()) {
        commands_.clear();
        completed_.clear();
        subscriptions_.clear();
        errors_.clear();
        events_.clear();
        told_.clear();
    }
    for (auto const& id : kit::command_ids(answer)) commands_.insert(id);
    if (auto const id = answer.text("command_id"); !id.empty()) commands_.insert(id);
    if (auto const id = answer.text("subscribe_id"); !id.empty()) subscriptions_.insert(id);
}

void Guest::check_notification(Document const& notification, std::uint64_t sequence) {
    stage_.mind_the_time();
    auto& traffic = stage_.traffic();
    traffic.validate(notification.as_received());
    traffic.see("nothing_is_sent_outside_of_a_session", is_connected(), notification.whole());
    if (!is_connected()) return;
    traffic.see("notifications_are_counted_without_gaps", notification.attribute("sequence") == std::to_string(sequence),
                "the sequence should be " + std::to_string(sequence) + ": " + notification.whole());
    if (notification.name() == "receive_event") check_event(notification);
    traffic.look_at_located(notification.root().child("results"));
    if (notification.name() == "receive_error") errors_.push_back(notification.text("error_id"));
    if (notification.name() != "completed") return;
    auto const id = notification.text("command_id");
    traffic.see("answers_come_before_what_they_cause", commands_.contains(id), "no answer has named " + notification.whole());
    traffic.see("commands_complete_once", completed_.insert(id).second, "again: " + notification.whole());
}

void Guest::check_event(Document const& event) {
    auto& traffic = stage_.traffic();
    traffic.see("events_are_those_that_were_subscribed", subscriptions_.contains(event.text("subscribe_id")), event.whole());
    auto const expire = event.text("expire"), id = event.text("event_id");
    traffic.see("times_are_utc", is_of_type("DateTime", {expire}), event.whole());
    traffic.see("events_expire_in_the_future", expire.substr(0, now_less_tolerance().size()) >= now_less_tolerance(),
                "it is over already: " + event.whole());
    auto const about = event.text("event_type") + " of " + event.ref() + ", which expires at " + expire;
    auto const& known = events_.try_emplace(id, about).first->second;
    traffic.see("an_event_id_names_one_event", known == about && told_.emplace(id, event.text("subscribe_id")).second,
                id + " was " + known + ", and is now " + event.whole());
    auto const ref = event.ref();
    auto const* const component = stage_.catalogue().find(ref);
    traffic.see(
        "events_are_those_that_were_subscribed",
        component && std::ranges::find(component->events, event.text("event_type"), &Message::name) != component->events.end(),
        "no event of its component: " + event.whole());
}

void Guest::ask_for_details() {
    if (!is_connected()) return;
    for (auto const& id : std::exchange(errors_, {})) {
        auto const answer = ask("get_error_detail", kit::text_element("error_id", id));
        auto const details = answer.values();
        stage_.traffic().see("errors_have_details",
                             answer.return_code() == "OK" && details.contains("component_ref") && details.contains("time") &&
                                 details.contains("text"),
                             "get_error_detail of " + id + " should tell component_ref, time and text: " + answer.whole());
    }
}

Argument argument(Component const& component, std::string const& name, std::vector<std::string> const& values) {
    auto const* const parameter = component.parameter_named(name);
    if (!parameter) throw NotPlayed{component.ref + " has no parameter " + name};
    return {parameter->name, parameter->type, values};
}

Argument spoken(Component const& speaker, std::string const& text) {
    if (speaker.parameter_named("speech_text")) return argument(speaker, "speech_text", {text});
    return argument(speaker, "SSML_text", {in_ssml(text)});
}

Argument straight_on(Component const& move, long distance) { return argument(move, "line", {std::to_string(distance) + " 0"}); }

// Most are optional; each takes a time or a length that any component can keep.
Dial dial_of(Stage const& stage) {
    constexpr int second = 1'000, metre = 1'000;
    static std::vector<std::pair<std::string, int>> const numbers{
        {"time_limit", second}, {"detection_threshold", metre}, {"minimum_interval", second}, {"volume", 0}, {"time", second},
        {"distance", metre}};
    for (auto const& [name, base] : numbers)
        for (auto const& component : stage.catalogue().components) {
            auto const* const parameter = component.parameter_named(name);
            if (!component.basic().empty() && parameter && is_same_type(parameter->type, "int"))
                return {&component, parameter->name, parameter->type, base};
        }
    throw NotPlayed{"there is no basic component with a parameter that is a number"};
}

Argument turned(Dial const& dial, int value) { return {dial.parameter, dial.type, {dial.text(value)}}; }

Command long_speech(Component const& speaker, std::string const& id) {
    std::string words, pauses;
    for (int i = 0; i < 200; ++i) {
        words += "This is a long speech. ";
        pauses += "This is it. <break time=\"60s\"/>";
    }
    if (!speaker.parameter_named("SSML_text")) return {.component = speaker.ref, .id = id, .arguments = {spoken(speaker, words)}};
    return {.component = speaker.ref, .id = id, .arguments = {argument(speaker, "SSML_text", {in_ssml(pauses)})}};
}

Command short_speech(Component const& speaker, std::string const& id) {
    return {.component = speaker.ref, .id = id, .arguments = {spoken(speaker, "Hi.")}};
}

Command command(Component const& component, std::string const& type, std::string const& id, std::optional<int> delay) {
    return {.component = component.ref, .type = type, .id = id, .delay = delay};
}

kit::Xml only(Component const& component) { return kit::where(kit::equal("component_ref", component.ref)); }

std::string unique_name() {
    static unsigned names = 0;
    return "conformance-" + std::to_string(++names);
}

}  // namespace rois::conformance
