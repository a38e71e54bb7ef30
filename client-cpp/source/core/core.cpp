#include "core/core.hpp"

#include <algorithm>
#include <random>

namespace rois::detail {

using client::Call;
using client::Steady;

namespace {

// Limits the times, so that they can be doubled and added to a clock.
Settings within_bounds(Settings settings) {
    for (auto* const time : {&settings.deadline, &settings.connect_deadline, &settings.ping_interval, &settings.stream_silence,
                             &settings.first_pause, &settings.longest_pause})
        *time = client::bounded(*time);
    return settings;
}

}  // namespace

Core::Core(Settings settings, Observers observers)
    : settings_{within_bounds(std::move(settings))},
      observers_{std::move(observers)},
      target_{client::read_url(settings_.url, settings_.token)},
      name_{std::random_device{}()},
      session_{settings_.session},
      random_{name_} {}

void Core::start() {
    loop_.start(shared_from_this());
    loop_.post([self = shared_from_this()] {
        if (self->phase_ != Phase::resting) return;
        self->change(State::connecting);
        self->attempt();
    });
}

void Core::close() {
    loop_.post([self = shared_from_this()] { self->begin_close(Farewell::due); });
}

void Core::destroy() {
    if (loop_.is_here()) muted_ = true;
    loop_.post([self = shared_from_this()] {
        self->destroyed_ = true;
        self->begin_close(Farewell::due);
        if (self->phase_ == Phase::closed) self->loop_.finish();
    });
    loop_.join();
}

SessionId Core::session() const {
    std::lock_guard const lock{session_mutex_};
    return session_;
}

// In a shared session the id contains name_: other programs give ids, too.
CommandId Core::fresh_command_id() {
    auto const whose = is_joined() ? std::to_string(name_) + "-" : "";
    return {"command-" + whose + std::to_string(++last_command_)};
}

NoAnswer Core::closed() const {
    return {NoAnswer::Why::closed, "the connection is closed" + (last_reason_.empty() ? "" : ": " + last_reason_)};
}

void Core::change(State state, std::string reason) {
    state_ = state;
    if (!reason.empty()) last_reason_ = reason;
    if (observers_.state && !muted_) observers_.state({state, std::move(reason)});
}

namespace {

// The return type of a coroutine that is not awaited.
struct Detached {
    struct promise_type {
        Detached get_return_object() const { return {}; }
        std::suspend_never initial_suspend() const noexcept { return {}; }
        std::suspend_never final_suspend() const noexcept { return {}; }
        void return_void() const {}
        void unhandled_exception() const { std::terminate(); }
    };
};

Detached run(Task<> task) { co_await task; }

}  // namespace

void Core::spawn(Task<> task) {
    loop_.post([self = shared_from_this(), kept = std::make_shared<Task<>>(std::move(task))] { run(std::move(*kept)); });
}

Task<> Core::pass(std::chrono::milliseconds time) {
    auto const self = shared_from_this();
    if (is_closed()) co_return;
    auto const over = std::make_shared<client::Flag>();
    std::erase_if(sleeping_, [](auto const& sleeper) { return sleeper.expired(); });
    sleeping_.push_back(over);
    auto const ticket = loop_.in(time, [over] { over->raise(); });
    co_await over->raised();
    loop_.cancel(ticket);
}

// --- Calls ---

std::shared_ptr<Call> Core::send(Call::Kind kind, std::string document, std::string request_id, client::Deadline deadline) {
    auto call = std::make_shared<Call>(kind, std::move(document), std::move(request_id), deadline);
    if (is_closed()) {
        call->give(closed());
        return call;
    }
    calls_.push_back(call);
    sent_raw_ = sent_raw_ || kind == Call::Kind::raw;
    if (call->deadline.due < next_deadline_) watch_deadlines(call->deadline.due);
    if (is_open()) {
        call->sent = true;
        send_on_link({call, &call->text});
    }
    return call;
}

// Uses one alarm for all deadlines: most are never reached.
void Core::watch_deadlines(Steady earliest) {
    next_deadline_ = earliest;
    loop_.cancel(deadlines_);
    if (earliest != Steady::max()) deadlines_ = loop_.at(earliest, [this] { end_late_calls(); });
}

void Core::end_late_calls() {
    auto const now = std::chrono::steady_clock::now();
    auto earliest = Steady::max();
    std::vector<std::shared_ptr<Call>> late;
    for (auto const& call : calls_) {
        if (call->is_over()) continue;
        if (call->deadline.due <= now) {
            late.push_back(call);
        } else {
            earliest = std::min(earliest, call->deadline.due);
        }
    }
    watch_deadlines(earliest);
    for (auto const& call : late) {
        auto reason = "no answer within " + std::to_string(call->deadline.whole.count()) + " ms";
        if (!is_open() && !last_reason_.empty()) reason += ": " + last_reason_;
        // A sent call keeps its place in the queue until its answer has arrived, or the link has broken.
        if (!call->sent || !is_open()) std::erase(calls_, call);
        call->give(NoAnswer{NoAnswer::Why::deadline, std::move(reason)});
    }
}

// Answers arrive in the order of the requests. The request_id is only checked: raw documents may have any request_id.
void Core::take_answer(std::string_view document, std::optional<xml::EngineMessage>& received) {
    auto const first = std::ranges::find_if(calls_, [](auto const& call) { return call->sent; });
    if (first == calls_.end()) {
        if (!received) give_up_misunderstood(document);
        return;
    }
    auto const call = *first;  // NOLINT(performance-unnecessary-copy-initialization): calls_ lets go of it below
    auto const take_first = [&] {
        calls_.erase(first);
        failures_ = 0;
    };
    if (call->kind == Call::Kind::raw) {
        take_first();
        call->give(std::string{document});
        return;
    }
    auto* const answered = received ? std::get_if<xml::Answered>(&*received) : nullptr;
    auto* const fault = received ? std::get_if<Fault>(&*received) : nullptr;
    auto const& id = answered != nullptr ? answered->request_id : fault != nullptr ? fault->request_id : call->id;
    if (!received || (!id.empty() && id != call->id)) {
        give_up_misunderstood(document);
    } else if (answered != nullptr) {
        take_first();
        call->give(std::in_place_type<Answer>, std::move(answered->reply));
    } else if (fault->code == FaultCode::no_session) {
        call->sent = false;  // the engine did not run it: it is sent in the next session
        session_gone();
    } else {
        take_first();
        call->give(std::in_place_type<Answer>, std::move(*fault));
    }
}

// Sends the waiting calls.
void Core::flush() {
    for (auto const& call : calls_) {
        if (call->sent) continue;
        call->sent = true;
        send_on_link({call, &call->text});
    }
}

// --- The end ---

void Core::begin_close(Farewell farewell) {
    if (is_closed()) return;
    auto const self = shared_from_this();
    bool const sends_disconnect = is_open() && farewell == Farewell::due && !is_joined();
    bool const awaits_stream_end = is_open() && farewell == Farewell::said && settings_.way == Way::http;
    phase_ = Phase::closing;
    state_ = State::closed;  // `finish` notifies the observers, after the last notification
    loop_.cancel(attempt_);
    for (auto const& call : std::exchange(calls_, {})) call->give(closed());
    for (auto const& stream : subscriptions_.streams()) stream->end();
    for (auto const& [id, watch] : std::exchange(watches_, {})) watch->abort(closed().reason);
    for (auto const& sleeper : std::exchange(sleeping_, {}))
        if (auto const flag = sleeper.lock()) flag->raise();
    if (!sends_disconnect && !awaits_stream_end) {
        finish();
        opened.raise();
        return;
    }
    opened.raise();
    constexpr auto longest = std::chrono::milliseconds{1'000};
    if (sends_disconnect) send_on_link(client::document_of({Disconnect{}, "disconnect"}));
    attempt_ = loop_.in(std::min(longest, settings_.connect_deadline), [this] { finish(); });
}

// The thread continues until `destroy`, because other threads may still call functions.
void Core::finish() {
    if (phase_ == Phase::closed) return;
    phase_ = Phase::closed;
    if (link_) link_->cut();
    link_.reset();
    change(State::closed, last_reason_);
    if (destroyed_) loop_.finish();
}

}  // namespace rois::detail
