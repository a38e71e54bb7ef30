// The link and the session: connects, resumes the session, and restores bindings and subscriptions in a new one.
#include <algorithm>

#include "core/core.hpp"
#include "types/text/texts.hpp"

namespace rois::detail {

using client::Call;
using client::Failure;

namespace {

// Returns whether this is the answer to `disconnect`, or the fault that the session has ended.
bool is_farewell(xml::EngineMessage const& received) {
    if (std::holds_alternative<Fault>(received)) return std::get<Fault>(received).code == FaultCode::no_session;
    auto const* const answered = std::get_if<xml::Answered>(&received);
    return answered != nullptr && std::holds_alternative<Disconnect::Reply>(answered->reply);
}

// Returns whether a retry would end with the same fault.
bool is_lasting(FaultCode code) {
    return code == FaultCode::unauthorized || code == FaultCode::not_allowed || code == FaultCode::not_found ||
           code == FaultCode::method_not_allowed;
}

}  // namespace

void Core::attempt() {
    phase_ = Phase::connecting;
    auto const make = settings_.way == Way::websocket && !is_joined() ? client::websocket_link : client::http_link;
    try {
        link_ = make(loop_, target_, settings_, *this);
    } catch (std::exception const& problem) {  // the file of trusted certificates cannot be read
        give_up_link(problem.what(), Failure::lasting);
        return;
    }
    attempt_ = loop_.in(settings_.connect_deadline, [this] {
        auto const time = std::to_string(settings_.connect_deadline.count()) + " ms";
        give_up_link("no session with " + target_.authority + " within " + time, Failure::passing);
    });
    link_->open();
}

void Core::connected() {
    phase_ = Phase::attaching;
    if (session_.text.empty()) {
        open_session();
    } else {
        link_->attach(session_, last_sequence_);
    }
}

// Asks the engine to count only requests as signs of life: this thread answers pings and keeps the event stream open even while
// the application's own thread hangs.
void Core::open_session() {
    Connect const connect{.motion_lease = settings_.motion_lease,
                          .motion_lease_http = {},
                          .motion_proof = MotionProof::request,
                          .switches = settings_.switches};
    send_on_link(client::document_of({connect, "connect"}));
}

void Core::send_on_link(client::Link::Document document) {
    last_sent_at_ = std::chrono::steady_clock::now();
    if (observers_.tap && !muted_) observers_.tap(Direction::out, *document);
    if (link_) link_->send(std::move(document));
}

void Core::document(std::string_view text) {
    auto const self = shared_from_this();
    if (observers_.tap && !muted_) observers_.tap(Direction::in, text);
    auto received = reader_.read(text);
    if (received && std::holds_alternative<xml::NumberedNotification>(*received)) {
        take(std::get<xml::NumberedNotification>(*std::move(received)));
    } else if (phase_ == Phase::closing) {
        // Over HTTP, waits for the end of the event stream: it may still bring `completed` for commands that the session ended.
        if (received && is_farewell(*received) && settings_.way == Way::websocket) finish();
    } else if (is_open()) {
        take_answer(text, received);
    } else if (!received) {
        give_up_misunderstood(text);
    } else if (phase_ == Phase::attaching) {
        take_opening(*std::move(received));
    } else {
        if (auto const* const answered = std::get_if<xml::Answered>(&*received)) take_restored(*answered);
        if (auto const* const fault = std::get_if<Fault>(&*received)) take_restored(*fault);
    }
}

// Takes the answer to `connect` or `resume`.
void Core::take_opening(xml::EngineMessage received) {
    if (auto const* const fault = std::get_if<Fault>(&received)) {
        if (fault->code == FaultCode::no_session && !session_.text.empty()) {
            session_gone();
            return;
        }
        give_up_link("no session: " + fault->reason, is_lasting(fault->code) ? Failure::lasting : Failure::passing);
        return;
    }
    auto const& reply = std::get<xml::Answered>(received).reply;
    if (auto const* const resumed = std::get_if<Resume::Reply>(&reply)) {
        if (resumed->return_code == ReturnCode::ok) {
            attached();
        } else {
            session_gone();
        }
        return;
    }
    auto const* const connected = std::get_if<Connect::Reply>(&reply);
    if (connected == nullptr) {
        give_up_link("no session: the gateway sent a reply of another operation than connect", Failure::passing);
        return;
    }
    if (connected->return_code != ReturnCode::ok) {
        give_up_link("no session: " + connected->reason, Failure::lasting);
        return;
    }
    {
        std::lock_guard const lock{session_mutex_};
        session_ = connected->session;
    }
    last_sequence_ = 0;
    sent_raw_ = false;
    if (settings_.way == Way::http) {
        link_->attach(session_, 0);
    } else {
        attached();
    }
}

// The engine no longer knows the session. Opens a new one on a new link; closes the connection if the session was another
// program's.
void Core::session_gone() {
    {
        std::lock_guard const lock{session_mutex_};
        session_ = {};
    }
    if (is_joined()) {
        give_up_link("the session does not exist, or has ended", Failure::lasting);
    } else {
        give_up_link("the engine has ended the session", Failure::passing);
    }
}

void Core::attached() {
    if (gap_) {
        restore();
        return;
    }
    had_session_ = true;
    become_open();
}

void Core::failed(std::string const& reason, Failure failure) { give_up_link(reason, failure); }

void Core::give_up_link(std::string const& reason, Failure failure) {
    auto const self = shared_from_this();
    loop_.cancel(attempt_);
    if (link_) link_->cut();
    link_.reset();
    if (phase_ == Phase::closing) {
        finish();
        return;
    }
    if (is_closed()) return;
    bool const was_open = is_open();
    auto const refused = was_open && failure == Failure::too_large ? take_largest() : nullptr;
    if (phase_ == Phase::restoring) {
        --subscribing_;
        restoring_.clear();
    }
    phase_ = Phase::resting;
    last_reason_ = reason;
    if (session_.text.empty() && had_session_) leave_session();
    if (was_open) change(State::lost, reason);
    if (was_open && opened_at_ + settings_.longest_pause <= std::chrono::steady_clock::now()) failures_ = 0;
    ++failures_;
    if (!was_open) ++attempts_;
    if (failure == Failure::lasting || (settings_.attempts && attempts_ >= *settings_.attempts && !was_open)) {
        begin_close(Farewell::said);
        return;
    }
    if (refused) refuse_too_large(*refused, reason);
    if (is_closed()) return;  // an observer has closed it
    auto const retry_in = pause();
    attempt_ = loop_.in(retry_in, [this] { attempt(); });
    if (!was_open && observers_.attempt_failed && !muted_) observers_.attempt_failed({attempts_, reason, retry_in});
}

// Removes and returns the largest sent call, which the gateway has rejected: it would break the next link, too. Null if there is
// none.
std::shared_ptr<Call> Core::take_largest() {
    auto const size = [](auto const& call) { return call->sent ? call->text.size() : 0; };
    auto const largest = std::ranges::max_element(calls_, {}, size);
    if (largest == calls_.end() || size(*largest) == 0) return nullptr;
    auto call = *largest;
    calls_.erase(largest);
    return call;
}

void Core::refuse_too_large(Call& call, std::string const& reason) {
    if (call.is_over()) return;
    auto why = "a document of " + std::to_string(call.text.size()) + " bytes: " + reason;
    if (call.kind == Call::Kind::raw) {
        call.give(NoAnswer{NoAnswer::Why::link_lost, std::move(why)});
    } else {
        call.give(Fault{FaultCode::too_large, std::move(why)});
    }
}

// Notes a gap, to be reported in the next session. Delivers the waiting notifications while their subscribe_ids are still valid.
// If the session ended before everything was restored in it, its notifications are part of the gap.
void Core::leave_session() {
    if (gap_) {
        held_.clear();
        return;
    }
    while (!held_.empty()) deliver_first_held();
    gap_ = Gap{Gap::Why::new_session, {}, {}};
}

// Shows only the beginning: a document may contain the session, which is a secret.
void Core::give_up_misunderstood(std::string_view document) {
    constexpr std::size_t shown = 40;
    auto const beginning = document.substr(0, std::min(document.find_first_of(" \t\r\n/>"), shown));
    give_up_link("unexpected document from the gateway: it begins with " + quoted(beginning), Failure::passing);
}

// See Settings::first_pause.
std::chrono::milliseconds Core::pause() {
    auto const pauses = had_session_ ? failures_ - 1 : failures_;
    if (pauses == 0) return std::chrono::milliseconds{0};
    auto longest = settings_.first_pause;
    for (auto i = 1U; i < pauses && longest < settings_.longest_pause; ++i) longest *= 2;
    longest = std::min(longest, settings_.longest_pause);
    random_ = random_ * 6'364'136'223'846'793'005U + 1'442'695'040'888'963'407U;
    auto const cut = static_cast<std::int64_t>(random_ >> 33U) % (longest.count() / 2 + 1);
    return longest - std::chrono::milliseconds{cut};
}

// --- A new session in place of the one that has ended ---

// Repeats the bindings and the subscriptions that are still used. Holds back events that arrive before their subscribe_id is
// known.
void Core::restore() {
    phase_ = Phase::restoring;
    subscriptions_.forget_unused();
    ++subscribing_;
    std::vector<client::Link::Document> documents;
    auto const add = [&](Operation operation, std::string what) {
        auto id = "restore-" + std::to_string(++last_request_);
        documents.push_back(client::document_of({std::move(operation), id}));
        restoring_.emplace(std::move(id), std::move(what));
    };
    for (auto const& bound : bound_) add(bound, "bind " + bound.component_ref.code);
    for (auto const* const each : subscriptions_.all()) add(each->operation, "subscribe " + each->id.text);
    for (auto const& document : documents) send_on_link(document);
    if (restoring_.empty()) all_restored();
}

void Core::take_restored(xml::Answered const& answered) {
    std::visit([&](auto const& reply) { restored(answered.request_id, reply, &answered.reply); }, answered.reply);
}

void Core::take_restored(Fault const& fault) {
    if (fault.code == FaultCode::no_session) {
        session_gone();
        return;
    }
    restored(fault.request_id, {ReturnCode::error, fault.reason}, nullptr);
}

void Core::restored(std::string const& request_id, Outcome const& outcome, Reply const* reply) {
    auto const found = restoring_.find(request_id);
    if (found == restoring_.end()) {
        give_up_link("unexpected answer from the gateway to a request that was not sent: " + quoted(request_id, 100),
                     Failure::passing);
        return;
    }
    constexpr std::string_view subscribe = "subscribe ";
    auto const& what = found->second;
    auto* const subscription =
        what.starts_with(subscribe) ? subscriptions_.find(SubscribeId{what.substr(subscribe.size())}) : nullptr;
    bool const good = outcome.return_code == ReturnCode::ok && reply != nullptr;
    if (good && subscription != nullptr) {
        if (auto const* const subscribed = std::get_if<Subscribe::Reply>(reply))
            subscription->engine_id = subscribed->subscribe_id;
    } else if (!good) {
        auto const name = subscription != nullptr ? "subscribe " + subscription->operation.event_type : what;
        if (subscription == nullptr)
            std::erase_if(bound_, [&](auto const& bound) { return "bind " + bound.component_ref.code == what; });
        if (subscription != nullptr) subscription->engine_id = {};
        gap_->not_restored.push_back(name + ": " + outcome.reason);
    }
    restoring_.erase(found);
    if (restoring_.empty()) all_restored();
}

// Also ends subscriptions that became unused during `restore`: their subscribe_ids are known now.
void Core::all_restored() {
    --subscribing_;
    become_open();
    end_unused();
}

// Reports the open session first, then the gap, the outcomes of interrupted calls, and new answers and notifications.
void Core::become_open() {
    bool const same = !gap_ && state_ == State::lost;
    loop_.cancel(attempt_);
    attempts_ = 0;
    failures_ = std::min(failures_, 1U);
    opened_at_ = std::chrono::steady_clock::now();
    phase_ = Phase::open;
    std::erase_if(calls_, [](auto const& call) { return call->is_over(); });
    auto const gap = std::exchange(gap_, {});
    std::vector<std::shared_ptr<Call>> doubtful;
    std::vector<std::shared_ptr<Call>> not_again;
    for (auto const& call : calls_) {
        bool const sent = std::exchange(call->sent, false);
        if (sent && call->kind == Call::Kind::once) doubtful.push_back(call);
        if (gap && call->kind == Call::Kind::in_session) doubtful.push_back(call);
        if (sent && call->kind == Call::Kind::raw) not_again.push_back(call);
    }
    for (auto const& call : doubtful) std::erase(calls_, call);
    for (auto const& call : not_again) std::erase(calls_, call);
    flush();
    change(same ? State::resumed : State::open);
    if (gap) {
        for (auto const& [id, watch] : std::exchange(watches_, {})) watch->abort("the session ended before the command");
        report_gap(*gap);
    }
    auto const reason = std::exchange(last_reason_, {});
    for (auto const& call : not_again) call->give(NoAnswer{NoAnswer::Why::link_lost, reason});
    for (auto const& call : doubtful) {
        if (gap) {
            call->give(NoAnswer{NoAnswer::Why::session_lost, "the session ended before the answer came"});
        } else {
            call->give(client::Interrupted{});
        }
    }
    opened.raise();
    deliver_held();
    expect_signs_of_life();
}

}  // namespace rois::detail
