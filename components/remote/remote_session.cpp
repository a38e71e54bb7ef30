// The link to a sub engine, and the session there: connects, resumes the session within its window, and gives it up after that.
#include <algorithm>
#include <utility>

#include "remote/remote_engine.hpp"
#include "remote/times.hpp"
#include "types/asking.hpp"
#include "types/text/texts.hpp"
#include "types/text/to_number.hpp"

namespace rois::remote {

namespace {

using namespace std::chrono_literals;

constexpr auto between_signs_of_life = 250ms;
constexpr auto between_signs_at_rest = 1s;  // while no component there is bound: only the round trip is measured

constexpr std::uint64_t between_checks = 64;  // documents, for a sub engine that reports too much
constexpr auto until_next_look = 5ms;

// The request_id of requests that have no number.
constexpr std::string_view opening = "connect";
constexpr std::string_view sign_of_life = "alive";
// In front of a command's number: asks how it has ended.
constexpr std::string_view has_ended = "ended ";
// In front of a request's number: asks whether an execute was performed whose answer was lost.
constexpr std::string_view was_performed = "performed ";

}  // namespace

void RemoteEngine::begin() {
    earlier_ = host_->earlier_session(settings_.name);
    stop_there_ = earlier_.stop;
    show();
    attempt();
}

void RemoteEngine::run(std::function<void(RemoteEngine&)> what) {
    host_->post([self = shared_from_this(), what = std::move(what)] { what(*self); });
}

// Repeated attempts fail for the same reason: it is logged once.
void RemoteEngine::note(std::string const& what) {
    if (std::exchange(last_error_, what) == what) return;
    host_->report(settings_.name, what);
    state_.last_error = what;
    show();
}

void RemoteEngine::show() {
    using enum EngineState::Is;
    if (!is_present_)
        state_.is = absent;
    else if (is_given_up_)
        state_.is = given_up;
    else
        state_.is = lost_at_ ? lost : present;
    state_.components = records_.size();
    host_->show(state_);
}

void RemoteEngine::attempt() {
    if (is_over_) return;
    ++era_;
    try {
        link_ = host_->link(settings_, *this);
    } catch (std::exception const& problem) {
        return give_up_link(problem.what());
    }
    if (!link_) return;
    limit_attempt();
    link_->open();
}

void RemoteEngine::joined(std::shared_ptr<client::Link> link) {
    if (link_) give_up_link("it has joined again");
    ++era_;
    link->listen(*this);
    link_ = std::move(link);
    limit_attempt();
    connected();
}

void RemoteEngine::limit_attempt() {
    host_->at(host_->now() + time_for_attempt, [self = shared_from_this(), era = era_] {
        if (self->era_ == era && !self->is_open_) self->give_up_link("no session within " + shown(time_for_attempt));
    });
}

void RemoteEngine::connected() {
    if (!earlier_.id.text.empty()) return link_->attach(earlier_.id, 0);
    if (!session_.text.empty()) return link_->attach(session_, last_sequence_);
    link_->send(client::document_of({request_for_session(), std::string{opening}}));
}

Connect RemoteEngine::request_for_session() const {
    return {.motion_lease = settings_.motion_lease,
            .motion_lease_http = {},
            .motion_proof = MotionProof::request,
            .is_engine = true,
            .window = settings_.window};
}

void RemoteEngine::document(std::string_view text) {
    auto const self = shared_from_this();
    if (text.size() > settings_.longest_document)
        return reject("a document of " + std::to_string(text.size()) + " bytes: expected at most " +
                      std::to_string(settings_.longest_document) + " (longest_document)");
    auto const read = reader_.read(text);
    if (!read) return reject("invalid document: expected an answer or a notification, not " + quoted(text, 100));
    std::visit([this](auto const& message) { take(message); }, *read);
    if (++documents_ % between_checks != 0 || !link_ || !is_flooded()) return;
    link_->pause();
    go_on_when_handled(era_);
}

// All components have one provider: a full queue of one stands for all.
bool RemoteEngine::is_flooded() {
    if (notifications_.is_exceeded(host_->now())) return true;
    return std::ranges::any_of(records_, [](auto const& each) { return each.second->is_full(); });
}

// A sub engine that reports more than this engine handles has to wait, and fills no memory here.
void RemoteEngine::go_on_when_handled(std::uint64_t era) {
    host_->at(host_->now() + until_next_look, [self = shared_from_this(), era] {
        if (self->era_ != era || !self->link_) return;
        if (self->is_flooded()) return self->go_on_when_handled(era);
        self->link_->go_on();
    });
}

// This engine was restarted. The sub engine tells how the commands of the earlier session have ended, and ends that session, with
// what still runs in it. Perhaps a stop of everything was cleared here, and not yet there.
void RemoteEngine::ask_about_earlier_commands() {
    if (!host_->everything_is_stopped())
        link_->send(client::document_of({ClearStop{stop_there_.value_or(ClearStop::own)}, std::string{opening}}));
    for (auto const command : earlier_.commands)
        link_->send(client::document_of({GetCommandResult{{id_of(command)}, {}}, std::string{has_ended} + number_of(command)}));
    link_->send(client::document_of({Disconnect{}, std::string{opening}}));
}

void RemoteEngine::take_earlier(xml::Answered const& answered) {
    auto const& [reply, id] = answered;
    if (auto const* resume = std::get_if<Resume::Reply>(&reply))
        return resume->return_code == ReturnCode::ok ? ask_about_earlier_commands() : lose_earlier_session();
    if (std::holds_alternative<ClearStop::Reply>(reply)) return note_stop_there({});
    if (std::holds_alternative<Disconnect::Reply>(reply)) return end_earlier_session();
    auto const* result = std::get_if<GetCommandResult::Reply>(&reply);
    auto const number = id.starts_with(has_ended) ? to_number<std::uint64_t>(id.substr(has_ended.size())) : std::nullopt;
    if (result == nullptr || !number || result->return_code != ReturnCode::ok) return;
    CommandEnded ended{.command = CommandHandle{*number}, .results = result->results};
    auto& parameters = ended.results.parameters;
    auto const taken = [&](std::string_view name) {
        auto const found = std::ranges::find(parameters, name, &Parameter::name);
        if (found == parameters.end() || found->values.empty()) return std::string{};
        auto value = found->values.front();
        parameters.erase(found);
        return value;
    };
    auto const status = to_code<CompletedStatus>(taken("status"));
    if (!status) return;  // it waits or runs
    ended.status = *status;
    if (*status != CompletedStatus::ok) ended.reason = taken("reason");
    ended_.push_back(std::move(ended));
}

// It has ended there, but its stop of everything may last: a gateway that could not go on has not stored it.
void RemoteEngine::lose_earlier_session() {
    if (!stop_there_) note_stop_there(ClearStop::own);
    end_earlier_session();
}

void RemoteEngine::end_earlier_session() {
    earlier_.id = {};
    ++era_;
    limit_attempt();
    connected();
}

void RemoteEngine::take(Fault const& fault) {
    if (fault.code == FaultCode::no_session && !earlier_.id.text.empty()) return lose_earlier_session();
    if (fault.code == FaultCode::no_session && !session_.text.empty()) return session_ended();
    if (!is_open_) return give_up_link("no session: " + fault.reason);
    auto const number = to_number<std::uint64_t>(fault.request_id);
    auto const found = number ? unanswered_.find(*number) : unanswered_.end();
    if (found == unanswered_.end()) return;
    auto const request = std::move(found->second);
    unanswered_.erase(found);
    note("it refused a request: " + fault.reason);
    struct Meanwhile {  // also if `then` throws
        std::string& refusal;
        ~Meanwhile() { refusal.clear(); }
    } const meanwhile{refusal_ = fault.reason};
    request.then(nullptr);
}

// Ignores answers that were not asked for.
void RemoteEngine::take(xml::Answered const& answered) {
    if (!earlier_.id.text.empty()) return take_earlier(answered);
    auto const& [reply, id] = answered;
    if (id == sign_of_life) return take_sign(reply);
    if (!is_open_) {
        auto const* connect = std::get_if<Connect::Reply>(&reply);
        auto const* resume = std::get_if<Resume::Reply>(&reply);
        if (connect != nullptr && session_.text.empty()) opened(*connect);
        if (resume != nullptr && !session_.text.empty()) resumed(resume->return_code);
        return;
    }
    if (is_given_up_) {
        if (!std::holds_alternative<Disconnect::Reply>(reply)) return;
        forget_session();
        is_open_ = false;
        return connected();
    }
    bool const asks = id.starts_with(was_performed);
    auto const number = to_number<std::uint64_t>(asks ? std::string_view{id}.substr(was_performed.size()) : id);
    auto const found = number ? unanswered_.find(*number) : unanswered_.end();
    if (found == unanswered_.end()) return;  // late, twice, or never asked
    if (asks && outcome_of(reply).return_code != ReturnCode::ok) return link_->send(found->second.document);
    auto const request = std::move(found->second);
    unanswered_.erase(found);
    if (!asks) return request.then(&reply);
    Reply const performed{Execute::Reply{}};
    request.then(&performed);
}

// A sub engine that has ended the session, because this engine hung, has opened another one for the sign of life. It is ended: it
// lacks bindings and subscriptions.
void RemoteEngine::take_sign(Reply const& reply) {
    if (!is_open_ || is_given_up_) return;
    auto const* connect = std::get_if<Connect::Reply>(&reply);
    if (connect != nullptr && connect->session != session_) {
        give_up("its session has ended");
        return link_->send(client::document_of({Disconnect{}, std::string{opening}}));
    }
    if (!asked_for_sign_) return;
    state_.round_trip = host_->now() - *std::exchange(asked_for_sign_, std::nullopt);
    show();
}

void RemoteEngine::take(xml::NumberedNotification const& notification) {
    if (!earlier_.id.text.empty()) return;                // of the earlier session
    if (notification.sequence <= last_sequence_) return;  // it was received before
    last_sequence_ = notification.sequence;
    notifications_.count();
    bool const is_missing = std::exchange(has_resumed_, false) && std::holds_alternative<Lost>(notification.notification);
    if (is_missing && !commands_.empty())
        return reject("notifications were lost while its link was");  // perhaps ends of commands
    std::visit([this](auto const& each) { (*this)(each); }, notification.notification);
}

void RemoteEngine::opened(Connect::Reply const& reply) {
    if (reply.return_code != ReturnCode::ok) return give_up_link("no session: " + reply.reason);
    is_given_up_ = has_resumed_ = false;
    subscribed_.clear();
    last_sequence_ = 0;
    auto begin = [weak = weak_from_this(), era = era_, session = reply.session] {
        auto const self = weak.lock();
        if (!self) return;
        self->run([era, session](RemoteEngine& engine) {
            if (engine.era_ == era && !engine.is_open_) engine.begin_session(session);
        });
    };
    host_->session_opened(settings_.name, reply.session, std::move(begin));
}

// The session is stored: if this engine dies, the next one knows it.
void RemoteEngine::begin_session(SessionId const& session) {
    session_ = session;
    is_open_ = true;
    profile_asked_ = stop_is_asked_ = false;
    give_signs_of_life(era_);
    ask_to_stop();
    clear_stop_there();
    ask_profile();
}

void RemoteEngine::session_ended() {
    give_up("its session has ended");
    forget_session();
    failures_ = 0;  // it answers
    if (is_open_ || !link_) return give_up_link("its session has ended");
    ++era_;
    limit_attempt();
    connected();  // opens a new session on the same link
}

// The sub engine has ended the session, so nothing there acts for this engine any more.
void RemoteEngine::forget_session() {
    session_ = {};
    for (auto const& [ref, record] : records_) record->end_activity();
}

// Gives up the session: if it were resumed, it would receive the same document again. Until the session is ended there, ignores
// such documents.
void RemoteEngine::reject(std::string const& problem) {
    if (is_given_up_ && is_open_) return;
    give_up(problem);
    give_up_link(problem);
}

// If this engine has given up the session, ends it there too, so that none of its commands goes on.
void RemoteEngine::resumed(ReturnCode code) {
    if (code != ReturnCode::ok) return session_ended();
    is_open_ = true;
    if (is_given_up_) return link_->send(client::document_of({Disconnect{}, std::string{opening}}));
    lost_at_.reset();
    failures_ = 0;
    has_resumed_ = true;
    host_->report(settings_.name, "the link is back");
    last_error_.clear();
    show();
    give_signs_of_life(era_);
    send_again();
    ask_to_stop();
}

// The answers to these requests may have been lost. All may be performed twice, except an execute.
void RemoteEngine::send_again() {
    for (auto const& [number, request] : unanswered_) {
        if (request.once.text.empty())
            link_->send(request.document);
        else
            link_->send(
                client::document_of({GetCommandResult{request.once, {}}, std::string{was_performed} + std::to_string(number)}));
    }
}

void RemoteEngine::ask(Operation operation, Then then, CommandId once) {
    if (!can_ask()) return then(nullptr);
    auto const number = ++last_request_;
    auto const document = client::document_of({std::move(operation), std::to_string(number)});
    unanswered_.emplace(number, Unanswered{document, std::move(then), std::move(once)});
    if (is_open_) link_->send(document);
}

// The sub engine counts requests, not pongs, as signs of life: the thread of the links would answer pings even while this engine
// hangs.
void RemoteEngine::give_signs_of_life(std::uint64_t era) {
    if (era != era_ || !is_open_) return;
    bool const is_bound = std::ranges::any_of(records_, [](auto const& each) { return each.second->is_held; });
    auto const now = host_->now();
    if (host_->is_alive() && (is_bound || now >= last_sign_ + between_signs_at_rest)) {
        link_->send(client::document_of({request_for_session(), std::string{sign_of_life}}));
        last_sign_ = now;
        if (!asked_for_sign_) asked_for_sign_ = now;
    }
    host_->at(now + between_signs_of_life, [self = shared_from_this(), era] { self->give_signs_of_life(era); });
}

void RemoteEngine::failed(std::string const& reason, client::Failure failure) {
    if (failure == client::Failure::invalid) give_up(reason);  // resumed, the session would receive the same again
    give_up_link(reason);
}

// The session goes on if the link returns within the window. The sub engine counts the same time.
void RemoteEngine::give_up_link(std::string const& reason) {
    ++era_;
    if (auto const link = std::exchange(link_, nullptr)) link->cut();
    is_open_ = false;
    asked_for_sign_.reset();
    state_.round_trip.reset();
    if (is_over_) return;
    note(reason);
    if (is_present_ && !lost_at_) {
        lost_at_ = host_->now();
        ++state_.losses;
        if_still_lost(*lost_at_ + settings_.window, *lost_at_, &RemoteEngine::give_up,
                      "session given up: no link for " + std::to_string(settings_.window.count()) + " ms (window)");
        if_still_lost(
            *lost_at_ + settings_.resume_window, *lost_at_, &RemoteEngine::leave,
            "its components leave: no link for " + std::to_string(settings_.resume_window.count()) + " ms (resume_window)");
    }
    show();
    await_next_attempt();
}

// A new session may have begun, whose profile has not come yet: then looks again later.
void RemoteEngine::if_still_lost(Steady when, Steady lost_at, void (RemoteEngine::*then)(std::string const&), std::string what) {
    host_->at(when, [self = shared_from_this(), lost_at, then, what = std::move(what)] {
        if (self->lost_at_ != lost_at) return;
        if (self->is_open_) return self->if_still_lost(self->host_->now() + time_for_attempt, lost_at, then, what);
        ((*self).*then)(what);
    });
}

// Ends the sub engine's commands. Its components are in ERROR until there is a new session. The sub engine ends the session now,
// too.
void RemoteEngine::give_up(std::string const& reason) {
    if (session_.text.empty() || std::exchange(is_given_up_, true)) return;
    note(reason);
    auto const why = "the engine " + quoted(settings_.name) + " is lost: " + reason;
    show();
    end_commands(why);
    states_.clear();
    for (auto const& [ref, record] : records_) {
        record->is_held = false;
        record->report(std::make_shared<ComponentState const>(ComponentState{ComponentStatus::error, {}, {}}));
        record->report(ErrorOccurred{ErrorType::component_not_responding, why, Report::each});
    }
}

// Removes a command only after its end has been reported: if that throws, the next call reports it.
void RemoteEngine::end_commands(std::string const& why) {
    while (!unanswered_.empty()) {
        auto const request = unanswered_.extract(unanswered_.begin());
        request.mapped().then(nullptr);
    }
    Completed const aborted{.command_id = {}, .status = CompletedStatus::abort, .results = {}, .reason = why};
    while (!commands_.empty()) {
        auto const first = commands_.begin();
        first->second(aborted);
        commands_.erase(first);
    }
}

void RemoteEngine::recover() {
    constexpr auto why = "an exception on the thread of the links";
    give_up_link(why);
    give_up(why);
    end_commands(why);
    for (auto const& [ref, record] : records_) record->forget_questions();
}

// Removes the components until the sub engine returns.
void RemoteEngine::leave(std::string const& reason) {
    give_up(reason);
    lost_at_.reset();
    ComponentChange change{.going = {}, .coming = {}, .belongings = {}, .provider = settings_.name};
    for (auto const& [ref, record] : records_) change.going.push_back(record->ref);
    try {
        if (is_present_ || !records_.empty()) host_->change(std::move(change));
        records_.clear();
        is_present_ = false;
        host_->why_loop(settings_, {});
        show();
    } catch (std::exception const& problem) {
        note(problem.what());
    }
}

void RemoteEngine::end() {
    if (std::exchange(is_over_, true)) return;
    if (is_open_) link_->send(client::document_of({Disconnect{}, std::string{opening}}));
    leave("this engine no longer uses it");
    give_up_link("");
}

void RemoteEngine::await_next_attempt() {
    bool const may_resume = lost_at_ && host_->now() < *lost_at_ + settings_.window;
    host_->at(host_->now() + (may_resume ? pause_within_window : pause_after(failures_++)),
              [self = shared_from_this(), era = era_] {
                  if (self->era_ == era) self->attempt();
              });
}

}  // namespace rois::remote
