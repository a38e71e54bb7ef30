#include "component_test/program.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "conformance/check.hpp"
#include "kit/process.hpp"
#include "types/data_type.hpp"
#include "types/text/texts.hpp"

namespace rois::component_test {

namespace {

using namespace std::chrono_literals;

CommandUnitSequence sequence_of(std::string const& ref, std::string const& command, std::string const& id,
                                ParameterList const& arguments) {
    CommandMessage message{.component_ref = {}, .command_type = command, .command_id = {id}, .arguments = arguments};
    message.component_ref.code = ref;
    return {{{.delay_time = {}, .unit = std::move(message)}}};
}

}  // namespace

std::string why_not(Results const& results, std::vector<ParameterProfile> const& known) {
    for (auto const& each : results.parameters) {
        auto const* profile = find_parameter(known, each.name);
        if (profile == nullptr) return "the profile lacks the result " + quoted(each.name);
        if (!(DataType::of(each.data_type_ref) == DataType::of(profile->data_type_ref)))
            return "the result " + quoted(each.name) + " is declared as " + quoted(each.data_type_ref.code) + ": expected " +
                   quoted(profile->data_type_ref.code) + ", as in the profile";
        if (auto const problem = rois::why_not(DataType::of(profile->data_type_ref), each.values))
            return "the result " + quoted(each.name) + ": " + *problem;
    }
    return {};
}

Program::Program(std::vector<std::string> command, std::chrono::milliseconds patience,
                 std::shared_ptr<xml::Schemas const> const& schemas)
    : patience_{patience},
      process_{kit::start(command.front(), {command.begin() + 1, command.end()},
                          {{"ROIS_URL", "ws://127.0.0.1:" + std::to_string(listener_.port())}, {"ROIS_NAME", "tested"}}, {})},
      validator_{std::make_unique<xml::Validator>(schemas)},
      joins_{schemas} {}

Program::~Program() {
    link_.reset();
    if (exit_code()) return;
    ::kill(process_, SIGKILL);
    kit::exit_code(process_);
}

void Program::fail(std::string const& what) { throw conformance::Broken{what}; }

void Program::ensure_ready() {
    if (link_has_ended()) {
        await_join();
        connect();
    }
    auto const reply = ask(GetProfile{});
    if (reply.return_code != ReturnCode::ok || !reply.profile) fail("get_profile: " + reply.reason);
    profile_ = reply.profile;
    components_ = reply.components;
    if (components_.empty()) fail("get_profile: expected at least one component");
    for (auto const& each : components_)
        if (!each.profile) fail("get_profile: the component " + quoted(each.ref) + " has no profile");
}

xml::Join Program::await_join() {
    link_.reset();
    pollfd waiting{listener_.descriptor(), POLLIN, 0};
    // The program may pause before it connects again.
    auto const longest = 3 * patience_;
    auto const until = Clock::now() + longest;
    while (::poll(&waiting, 1, 50) <= 0) {
        if (auto const code = exit_code())
            fail("expected that the program joins, but it has ended with exit code " + std::to_string(*code));
        if (Clock::now() > until)
            fail("the program did not connect to /rois/engines within " + std::to_string(longest.count()) + " ms");
    }
    link_ = std::make_unique<Link>(listener_.accept().value());
    auto const document = link_->next(Clock::now() + patience_);
    if (!document) fail("the program did not send join within " + std::to_string(patience_.count()) + " ms");
    auto const read = joins_.read(*document);
    if (auto const* fault = std::get_if<Fault>(&read)) fail("join: " + fault->reason);
    auto join = std::get<xml::Join>(read);
    instance_ = join.instance;
    joined_ = Clock::now();
    xml::JoinResponse response;
    response.window = window;
    link_->send(xml::encode(response));
    return join;
}

Connect::Reply Program::connect(std::chrono::milliseconds with_window) {
    last_sequence_ = 0;
    commands_.clear();
    completed_.clear();
    subscribed_.clear();
    states_.clear();
    auto reply = ask(Connect{.motion_lease = motion_lease,
                             .motion_lease_http = {},
                             .motion_proof = MotionProof::request,
                             .is_engine = true,
                             .window = with_window});
    if (reply.return_code != ReturnCode::ok) fail("connect: " + reply.reason);
    session_ = reply.session;
    return reply;
}

void Program::disconnect() {
    auto const reply = ask(Disconnect{});
    if (reply.return_code != ReturnCode::ok) fail("disconnect: expected OK, got a refusal: " + reply.reason);
    session_ = {};
}

void Program::ping() {
    auto const payload = "ping " + std::to_string(++last_request_);
    if (!link_ || !link_->ping(payload, Clock::now() + patience_))
        fail("ping: expected a pong with its payload within " + std::to_string(patience_.count()) + " ms, got none");
}

void Program::cut() {
    if (link_) link_->cut();
}

void Program::abandon_link() {
    if (!link_has_ended()) link_->send(xml::encode(Request{Disconnect{}, "end"}));
    link_.reset();
}

void Program::send(std::string const& document) {
    if (!link_) fail("the program has no open link");
    link_->send(document);
}

xml::EngineMessage Program::answer_to(Operation operation) { return answers_to({std::move(operation)}).front(); }

std::vector<xml::EngineMessage> Program::answers_to(std::vector<Operation> operations) {
    std::map<std::string, xml::EngineMessage*> missing;  // by request_id
    std::vector<xml::EngineMessage> answers(operations.size());
    for (std::size_t i = 0; i < operations.size(); ++i) {
        if (auto const* subscribe = std::get_if<Subscribe>(&operations[i])) subscribed_.insert(subscribe->event_type);
        auto const id = std::to_string(++last_request_);
        missing.emplace(id, &answers[i]);
        send(xml::encode(Request{std::move(operations[i]), id}));
    }
    while (!missing.empty()) take_next_answer(missing);
    return answers;
}

void Program::take_next_answer(std::map<std::string, xml::EngineMessage*>& missing) {
    auto const until = Clock::now() + patience_;
    while (Clock::now() < until) {
        auto answer = take(until);
        if (!answer && link_has_ended()) fail("the program closed the link before it answered");
        if (!answer) continue;
        auto const* fault = std::get_if<Fault>(&*answer);
        if (fault != nullptr && fault->request_id.empty()) continue;  // answers an earlier, malformed document
        auto const& given = fault != nullptr ? fault->request_id : std::get<xml::Answered>(*answer).request_id;
        auto const found = missing.find(given);
        if (found == missing.end())
            fail("expected the answer with request_id " + quoted(missing.begin()->first) + ", got " + quoted(given));
        *found->second = std::move(*answer);
        missing.erase(found);
        return;
    }
    fail("the program did not answer within " + std::to_string(patience_.count()) + " ms");
}

Program::Started Program::execute(std::string const& ref, std::string const& command, ParameterList const& arguments,
                                  bool check_only) {
    auto const id = "command-" + std::to_string(++last_command_);
    commands_[id] = {ref, command};
    auto reply =
        ask(Execute{.command_unit_list = sequence_of(ref, command, check_only ? "" : id, arguments), .check_only = check_only});
    if (reply.return_code != ReturnCode::ok && reply.reason.empty())
        fail("execute: expected a reason for the refusal of " + quoted(command));
    if (check_only || reply.return_code != ReturnCode::ok) commands_.erase(id);
    return {std::move(reply), id};
}

Completed Program::completed(std::string const& id, std::chrono::milliseconds within) {
    auto const until = Clock::now() + within;
    while (!completed_.contains(id) && Clock::now() < until && !link_has_ended())
        if (take(until)) fail("unexpected answer without a request");
    auto const found = completed_.find(id);
    if (found == completed_.end())
        fail("command " + quoted(commands_.at(id).second) + " did not complete within " + std::to_string(within.count()) + " ms");
    return found->second;
}

void Program::settle(std::chrono::milliseconds time) {
    auto const until = Clock::now() + time;
    while (Clock::now() < until && !link_has_ended())
        if (take(until)) fail("unexpected answer without a request, or a second answer");
}

std::optional<xml::EngineMessage> Program::take(Clock::time_point until) {
    auto const document = link_->next(until);
    if (!document) return {};
    if (auto const objection = validator_->objection_to(*document))
        fail("invalid document: " + objection->text + ": " + quoted(*document, 300));
    auto message = reader_.read(*document);
    if (!message) fail("expected an answer or a notification, got " + quoted(*document, 300));
    auto const* notification = std::get_if<xml::NumberedNotification>(&*message);
    if (notification == nullptr) return message;
    check_notification(*notification);
    return {};
}

void Program::check_notification(xml::NumberedNotification const& numbered) {
    if (numbered.sequence != last_sequence_ + 1)
        fail("expected a notification with sequence " + std::to_string(last_sequence_ + 1) + ", got " +
             std::to_string(numbered.sequence));
    last_sequence_ = numbered.sequence;
    if (session_.text.empty()) fail("unexpected notification: there is no session");
    std::visit([this](auto const& each) { check_notification(each); }, numbered.notification);
}

void Program::check_notification(Completed const& completed) {
    auto const& id = completed.command_id.text;
    auto const command = commands_.find(id);
    if (command == commands_.end()) fail("unexpected `completed` of the unknown or refused command " + quoted(id));
    auto const& [ref, name] = command->second;
    if (!completed_.emplace(id, completed).second) fail("unexpected second `completed` of " + quoted(name));
    auto const* message = find_message(profile_of(ref), MessageKind::command, name);
    if (!completed.active) fail("`completed` of " + quoted(name) + R"(: expected active="true" or active="false")");
    if (!completed.results) fail("`completed` of " + quoted(name) + ": expected an element results");
    if (auto const why = why_not(*completed.results, message == nullptr ? std::vector<ParameterProfile>{} : message->results);
        !why.empty())
        fail("`completed` of " + quoted(name) + ": " + why);
}

void Program::check_notification(ReceiveEvent const& event) {
    auto const& type = event.event_type;
    auto const* message = find_message(profile_of(event.component_ref.code), MessageKind::event, type);
    if (message == nullptr) fail("the profile lacks the event " + quoted(type));
    if (!subscribed_.contains(type)) fail("unexpected event " + quoted(type) + " without a subscription");
    if (!reported_.insert(event.event_id.text).second)
        fail("event " + quoted(type) + ": expected a new event_id, got " + quoted(event.event_id.text) + " again");
    ++events_[event.component_ref.code];
    if (!event.results) fail("event " + quoted(type) + ": expected inline results");
    if (auto const why = why_not(*event.results, message->results); !why.empty()) fail("event " + quoted(type) + ": " + why);
}

void Program::check_notification(ReceiveError const& error) {
    if (!reported_.insert(error.error_id.text).second)
        fail("error: expected a new error_id, got " + quoted(error.error_id.text) + " again");
    if (error.component_ref) ++errors_[error.component_ref->code];
}

void Program::check_notification(ComponentChanged const& changed) {
    if (!components_.empty()) profile_of(changed.component_ref.code);
    states_.insert(changed.component_ref.code);
}

ComponentProfile const& Program::profile_of(std::string const& ref) const {
    auto const found = std::ranges::find(components_, ref, &ComponentEntry::ref);
    if (found == components_.end()) fail("the profile lacks the component " + quoted(ref));
    return *found->profile;
}

std::optional<int> Program::exit_code() {
    int status = 0;
    if (!exit_code_ && ::waitpid(process_, &status, WNOHANG) == process_)
        exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    return exit_code_;
}

std::optional<int> Program::end() {
    ::kill(process_, SIGTERM);
    auto const until = Clock::now() + patience_;
    while (!exit_code() && Clock::now() < until) std::this_thread::sleep_for(10ms);
    return exit_code_;
}

}  // namespace rois::component_test
