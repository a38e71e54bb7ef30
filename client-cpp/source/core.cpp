#include "core.hpp"

#include <algorithm>
#include <random>

namespace rois::detail {

using client::Call;

Core::Core(Settings settings, Observers observers)
    : settings_{std::move(settings)},
      observers_{std::move(observers)},
      target_{client::read_url(settings_.url)},
      dice_{std::random_device{}()} {}

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

CommandId Core::fresh_command_id() { return {"command-" + std::to_string(++last_command_)}; }

void Core::change(State state, std::string reason) {
    state_ = state;
    if (!reason.empty()) last_reason_ = reason;
    if (observers_.state && !muted_) observers_.state({state, std::move(reason)});
}

namespace {

// A coroutine that nobody awaits.
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

Task<Call::Outcome> Core::send(Call::Kind kind, std::string document, std::string request_id,
                               std::chrono::milliseconds deadline) {
    auto const self = shared_from_this();
    if (is_closed()) co_return NoAnswer{NoAnswer::Why::closed, "the connection is closed"};
    auto const call = std::make_shared<Call>(kind, std::move(document), std::move(request_id));
    call->deadline = loop_.in(deadline, [this, weak = std::weak_ptr{call}, deadline] {
        auto const late = weak.lock();
        if (!late) return;
        auto reason = "no answer within " + std::to_string(deadline.count()) + " ms";
        if (!is_open() && !last_reason_.empty()) reason += ": " + last_reason_;
        settle(late, NoAnswer{NoAnswer::Why::deadline, std::move(reason)});
    });
    calls_.push_back(call);
    if (is_open()) {
        call->sent = true;
        send_on_link(call->text);
    }
    auto outcome = co_await call->outcome();
    co_return outcome;
}

// A raw one that was sent keeps its place in the row until its answer has come.
void Core::settle(std::shared_ptr<Call> const& call, Call::Outcome outcome) {
    loop_.cancel(call->deadline);
    bool const keeps_place =
        call->kind == Call::Kind::raw && call->sent && std::holds_alternative<NoAnswer>(outcome) && is_open();
    if (!keeps_place) std::erase(calls_, call);
    call->give(std::move(outcome));
}

std::shared_ptr<Call> Core::call_of(std::string const& request_id) const {
    auto const is_it = [&](auto const& call) { return call->sent && call->id == request_id; };
    auto const found = std::ranges::find_if(calls_, is_it);
    return found == calls_.end() ? nullptr : *found;
}

// The requests of the connection itself have ids of a form of their own.
void Core::take_answer(std::string_view document, std::optional<xml::Heard> heard) {
    std::string id;
    if (auto const* const answered = heard ? std::get_if<xml::Answered>(&*heard) : nullptr) id = answered->request_id;
    auto* const fault = heard ? std::get_if<Fault>(&*heard) : nullptr;
    if (fault != nullptr) id = fault->request_id;
    if (id.starts_with("rois-cpp-")) {
        auto const call = call_of(id);
        if (!call) return;  // its deadline has passed
        if (fault != nullptr && fault->code == FaultCode::no_session) {
            call->sent = false;  // it never ran: it is sent in the next session
            session_gone();
        } else if (fault != nullptr) {
            settle(call, std::move(*fault));
        } else {
            settle(call, std::move(std::get<xml::Answered>(*heard).reply));
        }
        return;
    }
    auto const raw = call_of("");
    if (raw) {
        settle(raw, std::string{document});
    } else if (!heard) {
        give_up_link("what the gateway says is not understood", client::Failure::passing);
    }
}

// Sends what waits.
void Core::flush() {
    for (auto const& call : calls_) {
        if (call->sent) continue;
        call->sent = true;
        send_on_link(call->text);
    }
}

// --- The end ---

void Core::begin_close(Farewell farewell) {
    if (is_closed()) return;
    auto const self = shared_from_this();
    bool const says_it = is_open() && farewell == Farewell::due;
    phase_ = Phase::closing;
    loop_.cancel(attempt_);
    for (auto const& call : std::exchange(calls_, {})) {
        loop_.cancel(call->deadline);
        call->give(
            NoAnswer{NoAnswer::Why::closed, "the connection is closed" + (last_reason_.empty() ? "" : ": " + last_reason_)});
    }
    for (auto const& stream : subscriptions_.streams()) stream->end();
    for (auto const& [id, watch] : std::exchange(watches_, {})) watch->complete(CompletedStatus::abort);
    for (auto const& sleeper : std::exchange(sleeping_, {}))
        if (auto const flag = sleeper.lock()) flag->raise();
    if (!says_it) {
        finish();
        opened.raise();
        return;
    }
    opened.raise();
    constexpr auto longest = std::chrono::milliseconds{1'000};
    send_on_link(xml::encode(Request{Disconnect{}, "disconnect"}));
    attempt_ = loop_.in(std::min(longest, settings_.connect_deadline), [this] { finish(); });
}

// The thread stays for those who still ask, until nobody can.
void Core::finish() {
    if (phase_ == Phase::closed) return;
    phase_ = Phase::closed;
    if (link_) link_->cut();
    link_.reset();
    change(State::closed, last_reason_);
    if (destroyed_) loop_.finish();
}

}  // namespace rois::detail
