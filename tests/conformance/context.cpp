#include "conformance/context.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <ctime>
#include <future>
#include <utility>

#include "kit/line.hpp"

namespace rois::conformance {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds longest_check{60};  // or six times the patience if that is longer
constexpr std::chrono::milliseconds until_a_command_fails{500};
constexpr std::chrono::hours clocks_differ{1};  // tolerance for the clock of the gateway

// Returns a time like "2026-11-22T10:00:00": every time in the future is later, even if the clocks differ.
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

Context::Context(kit::Address address, Transport transport, Catalogue const& catalogue, Traffic& traffic, double room,
                 std::string disturbance)
    : address_{std::move(address)},
      transport_{transport},
      catalogue_{catalogue},
      traffic_{traffic},
      room_{room},
      disturbance_{std::move(disturbance)},
      end_{std::chrono::steady_clock::now() + std::max<Clock::duration>(longest_check, 6 * address_.patience)} {}

Component const& Context::component_of_kind(std::vector<std::string> const& kinds) const {
    for (auto const& kind : kinds)
        for (auto const& component : catalogue_.components)
            if (component.basic() == kind) return component;
    throw Skipped{"the gateway has no component of the type " + list(kinds)};
}

Component const& Context::detector() const {
    std::vector<std::string> const kinds{"persondetection", "facedetection", "sounddetection"};
    for (auto const& kind : kinds)
        for (auto const& component : catalogue_.components)
            if (component.basic() == kind && component.event(component.detection_event())) return component;
    throw Skipped{"the gateway has no component of the type " + list(kinds) + " with the event of its detection"};
}

std::pair<Component const*, Component const*> Context::two_common_components() const {
    std::vector<Component const*> common;
    for (auto const& component : catalogue_.components)
        if (component.is_common) common.push_back(&component);
    if (common.size() < 2) throw Skipped{"the gateway has fewer than two components with start and stop"};
    for (auto one = common.begin(); one != common.end(); ++one)
        for (auto other = one + 1; other != common.end(); ++other)
            if ((*one)->engine == (*other)->engine) return {*one, *other};
    return {common[0], common[1]};
}

double Context::room() const {
    if (room_ == 0) throw Skipped{"robots must not move (--room 0)"};
    return room_;
}

void Context::can_disturb() const {
    if (disturbance_.empty()) throw Skipped{"no command makes a component fail (--disturb)"};
}

// The ref is from the gateway, so it is not a part of the command.
std::future<int> Context::disturb(std::string const& ref) const {
    ::setenv("COMPONENT", ref.c_str(), 1);
    auto running = std::async(std::launch::async, [command = disturbance_] { return std::system(command.c_str()); });
    bool const has_ended = running.wait_for(until_a_command_fails) == std::future_status::ready;
    if (has_ended && running.get() != 0) throw Skipped{"the command of --disturb has failed for " + ref};
    return running;
}

void Context::check_deadline() const {
    require(std::chrono::steady_clock::now() < end_,
            "the check did not end within its time limit (60 s, or six times the patience if that is longer)");
}

Client::Client(Context& context, Initially initially)
    : Application{kit::connection_over(context.address(), context.transport())}, context_{context} {
    if (initially == Initially::connected) require_ok(connect());
}

Client::~Client() {
    saved_parameters_.clear();
    try {
        check_error_details();
        disconnect_if_connected();
    } catch (std::exception const&) {
        // The gateway does not answer: this check or a later one reports that.
    }
}

void Client::bind_or_skip(Component const& component) {
    auto const answer = bind(component.ref);
    if (answer.return_code() == "OUT_OF_RESOURCES") throw Skipped{"another application uses " + component.ref};
    require_ok(answer);
    saved_parameters_.try_emplace(component.ref, *this, component);
}

std::string Client::execute_one(Command const& command) {
    auto const ids = kit::command_ids(require_ok(execute(command)));
    require(ids.size() == 1, "execute: expected one command id in the answer, got " + std::to_string(ids.size()));
    return first_of("a command", ids);
}

std::string Client::status_of(std::string const& command_id) {
    require(!command_id.empty() && commands_.contains(command_id),
            "command \"" + command_id + "\" is unknown: expected an id from an answer");
    return Application::status_of(command_id);
}

std::optional<Document> Client::first_event_after(std::size_t before, std::string const& event_type,
                                                  std::string const& ref) const {
    auto const is_it = [&](Document const& received) {
        return received.text("event_type") == event_type && (ref.empty() || received.ref() == ref);
    };
    auto const found = std::find_if(history().begin() + static_cast<std::ptrdiff_t>(before), history().end(), is_it);
    return found == history().end() ? std::nullopt : std::optional{*found};
}

Document Client::start_and_receive(Component const& component, std::string const& event_type) {
    auto const before = history().size();
    require_success(execute_one(command(component, "start")), component);
    auto received = first_event_after(before, event_type, component.ref);
    while (!received || received->ref() != component.ref) received = next_event(event_type);
    return *received;
}

void Client::require_success(std::string const& command_id, Component const& component) {
    auto const known = completion_statuses(command_id);
    auto const status = known.empty() ? status_of(command_id) : known.front();
    if (status == "OUT_OF_RESOURCES") throw Skipped{"another application uses a resource that " + component.ref + " needs"};
    auto const is_error = [](Document const& received) { return received.name() == "receive_error"; };
    if ((status == "ERROR" || status == "TIMEOUT") && (std::ranges::any_of(history(), is_error) || is_error(receive())))
        throw Skipped{component.ref + " has failed: " + status};
    require_equal("the status of the command of " + component.ref, "OK", status);
}

SavedParameters::SavedParameters(Client& client, Component const& component)
    : client_{client}, component_{component}, saved_{client.get_parameter(component.ref).values("parameters")} {}

// Sets the parameters one by one: a refused one does not affect the others.
SavedParameters::~SavedParameters() {
    try {
        auto const answer = client_.get_parameter(component_.ref);
        if (answer.return_code() != "OK") return;
        auto const now = answer.values("parameters");
        for (auto const& [name, type, default_value] : component_.parameters) {
            auto const before = saved_.find(name);
            auto const after = now.find(name);
            if (before == saved_.end() || (after != now.end() && after->second == before->second)) continue;
            client_.set_parameter(component_.ref, {{name, type, before->second}});
        }
    } catch (std::exception const&) {
        // The gateway does not answer: the check has reported that.
    }
}

void Client::flush_notifications(Component const& component) { run(command(component, "resume")); }

std::string Client::command_state(std::string const& command_id) {
    return value_of(require_ok(get_command_result(command_id)).values(), "status");
}

std::string Client::component_status(std::string const& ref) {
    return value_of(require_ok(query("component_status", kit::where(kit::equal("component_ref", ref)))).values(), "status");
}

Component const* Client::position_reporter_of(Component const& component) const {
    std::vector<Component const*> reporters;
    for (auto const& each : context_.catalogue().components)
        if (each.engine == component.engine && each.query("robot_position")) reporters.push_back(&each);
    return reporters.size() == 1 ? reporters.front() : nullptr;
}

// Asks the engine of the component: another engine reports another robot (decision 18).
std::optional<Robot> Client::robot_of(Component const& component) {
    auto const* const reporter = position_reporter_of(component);
    if (!reporter) return {};
    auto const results = query("robot_position", only(*reporter)).values();
    auto const refs = results.find("robot_ref"), positions = results.find("position_data");
    if (refs == results.end() || refs->second.size() != 1) return {};
    if (positions == results.end() || positions->second.size() != 1) return {};
    return Robot{refs->second.front(), positions->second.front()};
}

std::vector<std::string> Client::completion_statuses(std::string const& command_id) const {
    std::vector<std::string> statuses;
    for (auto const& received : history())
        if (received.name() == "completed" && received.text("command_id") == command_id)
            statuses.push_back(received.text("status"));
    return statuses;
}

std::size_t Client::count_events(std::string const& type) const {
    return static_cast<std::size_t>(
        std::ranges::count_if(history(), [&](Document const& received) { return received.text("event_type") == type; }));
}

void Client::check_answer(Document const& answer, std::string const& operation, std::string const& request_id) {
    context_.check_deadline();
    auto& traffic = context_.traffic();
    traffic.validate(answer.as_received());
    bool const is_fault = !answer.fault().empty();
    traffic.check(
        "answers_match_their_requests",
        answer.attribute("request_id") == request_id && (is_fault || answer.name() == operation + "_response"),
        operation + ": expected " + operation + "_response or a fault with request_id " + request_id + ", got " + answer.whole());
    if (!is_fault && answer.return_code() != "OK")
        traffic.check("refusals_have_a_reason",
                      answer.children() == std::vector<std::string>{"reason"} && !answer.reason().empty(), answer.whole());
    if (answer.return_code() != "OK") return;
    traffic.check_located(answer.root().child("results"));
    if (operation == "connect" && !is_connected()) {
        commands_.clear();
        completed_.clear();
        subscriptions_.clear();
        errors_.clear();
        events_.clear();
        received_events_.clear();
    }
    for (auto const& id : kit::command_ids(answer)) commands_.insert(id);
    if (auto const id = answer.text("command_id"); !id.empty()) commands_.insert(id);
    if (auto const id = answer.text("subscribe_id"); !id.empty()) subscriptions_.insert(id);
}

void Client::check_notification(Document const& notification, std::uint64_t sequence) {
    context_.check_deadline();
    auto& traffic = context_.traffic();
    traffic.validate(notification.as_received());
    traffic.check("no_notification_is_sent_without_a_session", is_connected(), notification.whole());
    if (!is_connected()) return;
    traffic.check("notification_sequences_have_no_gaps", notification.attribute("sequence") == std::to_string(sequence),
                  "expected sequence " + std::to_string(sequence) + ", got " + notification.whole());
    if (notification.name() == "receive_event") check_event(notification);
    traffic.check_located(notification.root().child("results"));
    if (notification.name() == "receive_error") errors_.push_back(notification.text("error_id"));
    if (notification.name() != "completed") return;
    auto const id = notification.text("command_id");
    traffic.check("an_answer_precedes_its_notifications", commands_.contains(id),
                  "the command id is not from an earlier answer: " + notification.whole());
    traffic.check("commands_complete_once", completed_.insert(id).second,
                  "a second `completed` of the same command: " + notification.whole());
}

void Client::check_event(Document const& event) {
    auto& traffic = context_.traffic();
    traffic.check("events_match_their_subscriptions", subscriptions_.contains(event.text("subscribe_id")), event.whole());
    auto const expire = event.text("expire"), id = event.text("event_id");
    traffic.check("times_are_utc", is_of_type("DateTime", {expire}), event.whole());
    traffic.check("events_expire_in_the_future", expire.substr(0, now_less_tolerance().size()) >= now_less_tolerance(),
                  "`expire` is in the past: " + event.whole());
    auto const about = event.text("event_type") + " of " + event.ref() + ", which expires at " + expire;
    auto const& known = events_.try_emplace(id, about).first->second;
    traffic.check("event_ids_are_unique", known == about && received_events_.emplace(id, event.text("subscribe_id")).second,
                  "event_id " + id + " was used for " + known + ", now for " + event.whole());
    auto const ref = event.ref();
    auto const* const component = context_.catalogue().find(ref);
    traffic.check(
        "events_match_their_subscriptions",
        component && std::ranges::find(component->events, event.text("event_type"), &Message::name) != component->events.end(),
        "the profile of the component lacks this event: " + event.whole());
}

void Client::check_error_details() {
    if (!is_connected()) return;
    for (auto const& id : std::exchange(errors_, {})) {
        auto const answer = ask("get_error_detail", kit::text_element("error_id", id));
        auto const details = answer.values();
        context_.traffic().check("errors_have_details",
                                 answer.return_code() == "OK" && details.contains("component_ref") && details.contains("time") &&
                                     details.contains("text"),
                                 "get_error_detail of " + id + ": expected component_ref, time and text, got " + answer.whole());
    }
}

Argument argument(Component const& component, std::string const& name, std::vector<std::string> const& values) {
    auto const* const parameter = component.parameter_named(name);
    if (!parameter) throw Skipped{component.ref + " has no parameter " + name};
    return {parameter->name, parameter->type, values};
}

Argument speech_argument(Component const& speaker, std::string const& text) {
    if (speaker.parameter_named("speech_text")) return argument(speaker, "speech_text", {text});
    return argument(speaker, "SSML_text", {in_ssml(text)});
}

Argument straight_line(Component const& move, long distance) { return argument(move, "line", {std::to_string(distance) + " 0"}); }

// Most of these parameters are optional. Each accepts a time or a length that is harmless for any component.
NumberParameter number_parameter_of(Context const& context) {
    constexpr int second = 1'000, metre = 1'000;
    static std::vector<std::pair<std::string, int>> const numbers{
        {"time_limit", second}, {"detection_threshold", metre}, {"minimum_interval", second}, {"volume", 0}, {"time", second},
        {"distance", metre}};
    for (auto const& [name, base] : numbers)
        for (auto const& component : context.catalogue().components) {
            auto const* const parameter = component.parameter_named(name);
            if (!component.basic().empty() && parameter && is_same_type(parameter->type, "int"))
                return {&component, parameter->name, parameter->type, base};
        }
    throw Skipped{"no basic component has an integer parameter"};
}

Argument with_value(NumberParameter const& number, int value) { return {number.name, number.type, {number.text(value)}}; }

Command long_speech(Component const& speaker, std::string const& id) {
    std::string words, pauses;
    for (int i = 0; i < 200; ++i) {
        words += "This is a long speech. ";
        pauses += "This is it. <break time=\"60s\"/>";
    }
    if (!speaker.parameter_named("SSML_text"))
        return {.component = speaker.ref, .id = id, .arguments = {speech_argument(speaker, words)}};
    return {.component = speaker.ref, .id = id, .arguments = {argument(speaker, "SSML_text", {in_ssml(pauses)})}};
}

Command short_speech(Component const& speaker, std::string const& id) {
    return {.component = speaker.ref, .id = id, .arguments = {speech_argument(speaker, "Hi.")}};
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
