#include "gateway/gateway.hpp"

#include <charconv>
#include <new>
#include <thread>
#include <utility>

#include "engine/attempts.hpp"
#include "gateway/process/memory.hpp"
#include "types/asking.hpp"

namespace rois {

namespace {

Instant present() { return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()}; }

// Memory for a document while it is read and performed, in lengths of the document: measured up to 10.
constexpr std::size_t work_factor = 16;
constexpr std::size_t negligible = 1024;  // bytes of a document; most requests are that short

Fault beyond(std::uint64_t after, std::uint64_t last) {
    return {FaultCode::not_well_formed, "the position " + std::to_string(after) +
                                            " is higher than the last sequence of this session: expected at most " +
                                            std::to_string(last)};
}

// Why the principal may not perform the operation, or nullopt.
std::optional<Fault> why_not_allowed(Principal const& principal, Request const& request) {
    auto const least = least_role_for(request.operation);
    if (!principal.is_over() && principal.role >= least) return {};
    auto fault = principal.is_over() ? unauthorized() : not_allowed_for(principal.role, least);
    fault.request_id = request.request_id;
    return fault;
}

// Notes what a client has done. Without memory for its address, the entry has none.
void note(Audit const& audit, std::string_view what, Client const& client, AuditEntry entry = {}) {
    entry.what = what;
    entry.token = client.name();
    std::string address;
    try {
        address = text_of(Network{client.address});
        entry.address = address;
    } catch (std::bad_alloc const&) {
        entry.address = {};
    }
    audit(entry);
}

}  // namespace

Fault shutting_down() { return {FaultCode::shutting_down, "the gateway is shutting down"}; }

Fault no_memory_for_document(MemoryBudget& memory) {
    return {FaultCode::too_many, memory.refuse("there is no memory for a long document")};
}

Fault unauthorized() {
    return {FaultCode::unauthorized,
            "expected a valid token, in the header 'Authorization: Bearer TOKEN', or in the subprotocol rois.bearer.TOKEN of a "
            "WebSocket; docs/trust.md says how to get one"};
}

Fault no_such_session() { return {FaultCode::no_session, "there is no such session; connect first"}; }

NotificationDocument::NotificationDocument(Numbered const& numbered)
    : before_{xml::notification_head(numbered.notification->body)}, after_{numbered.notification->text(xml::notification_tail)} {
    digits_size_ =
        static_cast<std::size_t>(std::to_chars(digits_.begin(), digits_.end(), numbered.sequence).ptr - digits_.begin());
}

void NotificationDocument::append_to(std::string& out) const {
    out.append(before_).append(digits_.data(), digits_size_).append(after_);
}

Gateway::Gateway(Engine& engine, Readers& readers, Telemetry& telemetry, ClientLimits limits, MemoryBudget& memory,
                 Tokens* tokens)
    : engine_{engine},
      readers_{readers},
      telemetry_{telemetry},
      memory_{memory},
      tokens_{tokens},
      quota_{limits.sessions_per_connection, limits.sessions_per_address},
      streams_per_session_{limits.streams_per_session},
      log_{{.ended = [this](std::uint64_t session) { quota_.ended(session); },
            .restored = [this](std::uint64_t session, Rights const* rights) { session_restored(session, rights); }}} {
    engine_.report_to(log_);
    engine_.keep_within(memory);
    show_limits(limits);
}

// Components that have a thread of their own may still report.
Gateway::~Gateway() {
    engine_.on_report([] {});
}

void Gateway::show_limits(ClientLimits const& limits) {
    telemetry_.set(Telemetry::Limit::sessions_per_connection, limits.sessions_per_connection);
    telemetry_.set(Telemetry::Limit::sessions_per_address, limits.sessions_per_address);
    telemetry_.set(Telemetry::Limit::streams_per_session, limits.streams_per_session);
}

void Gateway::use(ClientLimits limits, EngineSettings const& settings) {
    Lock const lock{*this};
    quota_.limit(limits.sessions_per_connection, limits.sessions_per_address);
    streams_per_session_ = limits.streams_per_session;
    show_limits(limits);
    engine_.use(settings);
}

// A request that was read, and its answer.
class Exchange final : public Asked {
public:
    Exchange(Gateway& gateway, std::shared_ptr<NotificationQueue> of, NotificationQueue::Hold until_answered, Request&& request,
             Instant begun, std::weak_ptr<Waker> waits, std::shared_ptr<Rights const> of_client, Via via)
        : Asked{std::move(of), until_answered, std::move(of_client), via == Via::http},
          gateway_{gateway},
          request_{std::move(request)},
          begun_{begun},
          waits_{std::move(waits)} {}
    // Refused before an operation was performed.
    Exchange(Gateway& gateway, Fault fault) : Asked{{}, 0}, gateway_{gateway}, fault_{std::move(fault)}, has_come_{true} {}

    Operation const& operation() const override { return request_.operation; }

    // Called with the engine locked. The first answer counts: memory may have been short after a question was asked.
    void answer(Reply&& reply) override {
        if (has_come()) return;
        reply_ = std::move(reply);
        come();
    }
    void refuse(Refusal refusal) override {
        if (has_come()) return;
        fault_ = gateway_.fault_of(refusal);
        fault_->request_id = request_.request_id;
        auto const* bind = std::get_if<Bind>(&operation());
        if (rights && ((bind && refusal == Refusal::not_allowed) || std::holds_alternative<Connect>(operation())))
            gateway_.audit_({.what = "refused",
                             .token = rights->holder(),
                             .component = bind ? bind->component_ref.code : std::string_view{},
                             .operation = operation_name(operation()),
                             .outcome = to_text(fault_->code)});
        come();
    }
    // From now on the reader is woken when the answer comes. Called with the engine locked.
    void wait() { is_late_ = !has_come(); }
    bool has_come() const { return has_come_.load(std::memory_order_acquire); }

    // Returns whether the operation may change the session of the connection.
    bool is_about_session() const {
        return std::holds_alternative<Connect>(operation()) || std::holds_alternative<Resume>(operation()) ||
               std::holds_alternative<Disconnect>(operation());
    }

    void session_opened(std::uint64_t number) { session_number_ = number; }

    Answer take() {
        Answer taken;
        taken.session_number = session_number_;
        if (fault_) {
            taken.document = xml::encode(*fault_);
            gateway_.telemetry_.faulted(fault_->code);
            taken.fault = std::move(fault_);
            return taken;
        }
        taken.document = xml::encode(*reply_, request_.request_id);
        auto const code = outcome_of(*reply_).return_code;
        gateway_.telemetry_.answered(operation(), code, std::chrono::steady_clock::now() - begun_.steady);
        if (code == ReturnCode::ok) take_turn(taken);
        return taken;
    }

private:
    void come() {
        has_come_.store(true, std::memory_order_release);
        if (!is_late_) return;
        if (auto const waker = waits_.lock()) waker->wake();
    }

    // Notes how a successful operation changes the connection that asked for it.
    void take_turn(Answer& taken) const {
        if (auto const* connected = std::get_if<Connect::Reply>(&*reply_)) {
            taken.turn = Answer::Turn::connected;
            taken.session = connected->session;
        } else if (auto const* resume = std::get_if<Resume>(&operation())) {
            taken.turn = Answer::Turn::resumed;
            taken.session = resume->session;
            taken.last_sequence = resume->last_sequence;
        } else if (std::holds_alternative<Disconnect>(operation())) {
            taken.turn = Answer::Turn::disconnected;
        }
    }

    Gateway& gateway_;
    Request request_;
    Instant begun_{};
    std::weak_ptr<Waker> waits_;
    std::optional<Fault> fault_;
    std::optional<Reply> reply_;
    std::uint64_t session_number_ = 0;
    bool is_late_ = false;
    std::atomic<bool> has_come_ = false;
};

bool PendingAnswer::has_come() const { return exchange_->has_come(); }

bool PendingAnswer::is_about_session() const { return exchange_->is_about_session(); }

bool PendingAnswer::is_disconnect() const { return std::holds_alternative<Disconnect>(exchange_->operation()); }

Answer PendingAnswer::take() {
    auto answer = exchange_->take();
    hold_.resume();
    answer.hold = std::move(hold_);
    return answer;
}

PendingAnswer Gateway::refused(Fault fault) { return {std::make_shared<Exchange>(*this, std::move(fault)), {}}; }

PendingAnswer Gateway::answer(xml::RequestReader& reader, SessionId const& session, std::string_view text, Via via,
                              std::weak_ptr<Waker> waits, std::shared_ptr<Client> const& client, Reading const* reading) {
    auto const begun = present();
    std::optional<MemoryBudget::Room> room;
    if (text.size() > negligible) room.emplace(room_for(text));
    if (room && !*room) return refused(no_memory_for_document(memory_));
    auto read = reader.read(text);
    if (auto const way = reader.checked()) telemetry_.checked(*way);
    if (auto* fault = std::get_if<Fault>(&read)) return refused(std::move(*fault));
    auto& request = std::get<Request>(read);
    if (std::holds_alternative<Resume>(request.operation) && via == Via::http)
        return refused({FaultCode::not_allowed,
                        "resume works only on a WebSocket; over HTTP, pass after=N or Last-Event-ID to /rois/notifications",
                        {},
                        request.request_id});
    if (client && client->principal)
        if (auto fault = why_not_allowed(*client->principal, request)) {
            note_refusal(*client, operation_name(request.operation), fault->code);
            return refused(std::move(*fault));
        }
    return perform(session, std::move(request), via, std::move(waits), client, reading, begun);
}

// Converts to false if there is no memory. Short documents reserve none, but their bytes are counted.
MemoryBudget::Room Gateway::room_for(std::string_view text) {
    memory_.took(text.size());
    if (text.size() > memory_.longest_document()) return {};
    return memory_.reserve(text.size() > MemoryBudget::longest_when_tight ? text.size() * work_factor : 0);
}

Fault Gateway::fault_of(Refusal refusal) {
    switch (refusal) {
        case Refusal::too_many_sessions:
            return {FaultCode::too_many,
                    "too many sessions are open, and none is idle: try again later; the key max_sessions sets the limit"};
        case Refusal::no_memory:
            return {FaultCode::too_many, memory_.refuse("there is no memory for a new session")};
        case Refusal::shutting_down:
            return rois::shutting_down();
        case Refusal::not_allowed:
            return {FaultCode::not_allowed, "the token may see this component, but not command it"};
        case Refusal::no_session:
            break;
    }
    return no_such_session();
}

PendingAnswer Gateway::perform(SessionId const& session, Request&& request, Via via, std::weak_ptr<Waker> waits,
                               std::shared_ptr<Client> const& client, Reading const* reading, Instant now) {
    auto const rights = client && client->principal ? client->principal->rights : nullptr;
    Hold hold;  // ends without the lock
    Lock lock{*this};
    auto queue = reading != nullptr ? reading->queue_
                 : via == Via::http ? engine_.note_request(session, now, rights.get())
                                    : engine_.notifications(session, rights.get());
    bool const known = queue != nullptr;
    bool const connects = std::holds_alternative<Connect>(request.operation);
    bool const opens = client && !known && connects;
    auto const* resume = std::get_if<Resume>(&request.operation);
    if (!known) note_foreign(resume != nullptr ? resume->session : session, rights.get(), operation_name(request.operation));
    if (opens)
        if (auto fault = refusal_of(*client)) {
            fault->request_id = request.request_id;
            note_refusal(*client, operation_name(request.operation), fault->code);
            return refused(std::move(*fault));
        }
    log_.take_joined();  // of an operation that failed
    // `disconnect` holds nothing: the readers receive the last notifications before the answer (decision 3).
    if (known && !std::holds_alternative<Disconnect>(request.operation)) hold = Hold{*this, queue};
    auto exchange = std::make_shared<Exchange>(*this, std::move(queue), hold.number(), std::move(request), now, std::move(waits),
                                               rights, via);
    engine_.handle(exchange, now);
    auto const number = log_.take_joined();
    exchange->session_opened(number);
    if (number != 0 && client) {
        log_.session_is_of(number, client->name());
        note(audit_, connects ? "connected" : "resumed", *client, {.what = {}, .session = number});
    }
    if (opens && number != 0) quota_.opened(number, client);
    engine_.work(lock, now);
    hold.leave();
    exchange->wait();
    return {std::move(exchange), std::move(hold)};
}

// Returns a fault if this connection may not open another session.
std::optional<Fault> Gateway::refusal_of(Client const& client) {
    auto const refused = [](std::string_view holder, std::size_t sessions, std::string_view instead, std::string_view key) {
        return Fault{FaultCode::too_many, std::string{holder} + " has " + std::to_string(sessions) +
                                              " sessions open already: disconnect one" + std::string{instead} + "; the key " +
                                              std::string{key} + " sets the limit"};
    };
    switch (quota_.verdict(client)) {
        case SessionQuota::Verdict::full_connection:
            telemetry_.reached(Telemetry::Limit::sessions_per_connection);
            return refused("this connection", quota_.most_of_connection(), ", or use another connection",
                           "max_sessions_per_connection");
        case SessionQuota::Verdict::full_address:
            telemetry_.reached(Telemetry::Limit::sessions_per_address);
            return refused(client.principal ? "this token" : "this address", quota_.most_of_address(), "",
                           "max_sessions_per_address");
        case SessionQuota::Verdict::open:
            break;
    }
    return {};
}

std::variant<std::unique_ptr<Reading>, Fault> Gateway::read(SessionId const& session, Rights const* rights, LinkKind link,
                                                            std::uint64_t after, Reader& reader, Readers::Until until) {
    auto reading = std::make_unique<Reading>(*this, link, after, reader);
    Lock const lock{*this};
    auto queue = engine_.notifications(session, rights);
    if (!queue) note_foreign(session, rights, "/rois/notifications");
    if (!queue || queue->closed()) return no_such_session();
    if (auto const last = queue->last_sequence(); after > last) return beyond(after, last);
    if (until == Readers::Until::closed && link == LinkKind::stream && readers_.streams(session) >= streams_per_session_) {
        telemetry_.reached(Telemetry::Limit::streams_per_session);
        return Fault{FaultCode::too_many,
                     "this session has " + std::to_string(streams_per_session_) +
                         " event streams open already: close one; the key max_streams_per_session sets the limit"};
    }
    readers_.join(*queue, link, reader, until);
    engine_.link_opened(session, link, present());
    reading->is_of_engine_ = engine_.is_engine(session);
    reading->queue_ = std::move(queue);
    return reading;
}

void Gateway::audit_to(Audit audit) {
    log_.audit_to(audit);
    audit_ = std::move(audit);
}

void Gateway::note_refusal(Client const& client, std::string_view operation, FaultCode code) const {
    note(audit_, "refused", client, {.what = {}, .operation = operation, .outcome = to_text(code)});
}

// A client that knows the id of another's session gets the same answer as for a session that does not exist.
void Gateway::note_foreign(SessionId const& session, Rights const* rights, std::string_view operation) const {
    if (rights == nullptr || !engine_.is_of_another(session, rights)) return;
    audit_({.what = "refused", .token = rights->holder(), .operation = operation, .outcome = to_text(FaultCode::no_session)});
}

void Gateway::begin() {
    auto const now = present();
    engine_.on_report([this] { alarm_.ring(); });
    Lock lock{*this};
    engine_.begin(now);
    engine_.work(lock, now, Provider::Runner::clock);
    telemetry_.ticked(now.steady);
}

void Gateway::Alarm::ring() {
    {
        std::lock_guard const lock{mutex_};
        rings_ = true;
    }
    rung_.notify_one();
}

bool Gateway::Alarm::wait_until(Steady until) {
    std::unique_lock lock{mutex_};
    rung_.wait_until(lock, until, [this] { return rings_; });
    return std::exchange(rings_, false);
}

bool Gateway::await_reports(Steady until) { return alarm_.wait_until(until); }

void Gateway::handle_reports() {
    auto const now = present();
    Lock lock{*this};
    engine_.work(lock, now, Provider::Runner::clock);
}

// Returns freed memory to the system. Otherwise it would count against the budget until the process ends.
void Gateway::save_memory(Steady now) {
    MemoryReserve::refill();
    memory_.look();
    if (!memory_.tight() || now - memory_released_ < std::chrono::seconds{1}) return;
    memory_released_ = now;
    release_memory();
    memory_.look();
}

void Gateway::tick() {
    auto const now = present();
    save_memory(now.steady);
    {
        Lock lock{*this};
        Attempts attempts;
        if (tokens_ != nullptr && tokens_->end_expired(now.utc)) attempts([&] { engine_.end_withdrawn(now); });
        attempts([&] { engine_.tick(now); });
        attempts([&] { engine_.work(lock, now, Provider::Runner::clock); });
        attempts.rethrow();
    }
    telemetry_.ticked(now.steady);
}

// Waits at most a second: a thread that holds the lock for longer will not release it.
void Gateway::halt_at_last() noexcept {
    std::unique_lock lock{mutex_, std::defer_lock};
    for (int tries = 0; tries < 100 && !lock.try_lock(); ++tries) std::this_thread::sleep_for(std::chrono::milliseconds{10});
    if (!lock.owns_lock()) return;
    Attempts attempts;  // a failure of one component does not keep the others from halting
    attempts([&] { engine_.halt_everything(present()); });
    attempts([&] { engine_.work(lock, present(), Provider::Runner::clock); });
    readers_.flush();
}

std::vector<std::string> Gateway::change(ComponentChange change) {
    auto const now = present();
    Lock lock{*this};
    auto left_out = engine_.change(std::move(change), now);
    engine_.work(lock, now);
    return left_out;
}

// A session without a token does not count: the address of its client is not known.
void Gateway::session_restored(std::uint64_t session, Rights const* rights) {
    auto const holder = rights == nullptr || tokens_ == nullptr ? nullptr : tokens_->holder_of(rights->id());
    if (!holder) return;
    log_.session_is_of(session, holder->name());
    quota_.opened(session, std::make_shared<Client>(Address{}, Limits::all, holder));
}

StopState Gateway::stop_everything(Client const* asked_by) {
    auto const now = present();
    Lock lock{*this};
    Attempts attempts;
    attempts([&] { engine_.stop_everything(now); });
    attempts([&] { engine_.work(lock, now); });
    if (asked_by != nullptr) note(audit_, "stopped everything", *asked_by);
    attempts([&] { await_journal(lock); });
    attempts.rethrow();
    return {engine_.everything_is_stopped(), engine_.not_halted()};
}

StopState Gateway::clear(Client const* asked_by) {
    Lock lock{*this};
    engine_.clear();
    if (asked_by != nullptr) note(audit_, "cleared the stop", *asked_by);
    await_journal(lock);
    return {engine_.everything_is_stopped(), engine_.not_halted()};
}

bool Gateway::everything_is_stopped() const {
    std::lock_guard const lock{mutex_};
    return engine_.everything_is_stopped();
}

std::vector<std::string> Gateway::not_halted() const {
    std::lock_guard const lock{mutex_};
    return engine_.not_halted();
}

std::vector<std::string> Gateway::not_ready() const {
    std::lock_guard const lock{mutex_};
    return engine_.not_ready();
}

void Gateway::shut_down() {
    auto const now = present();
    Lock lock{*this};
    shutting_down_ = true;
    engine_.shut_down(now);
    engine_.work(lock, now);
}

}  // namespace rois
