#include "gateway/gateway.hpp"

#include <charconv>
#include <thread>
#include <utility>

#include "engine/attempts.hpp"
#include "gateway/process/memory.hpp"

namespace rois {

namespace {

Instant present() { return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()}; }

// Memory for a document while it is read and performed, in lengths of the document: measured up to 10.
constexpr std::size_t work_factor = 16;
constexpr std::size_t negligible = 1024;  // bytes of a document; most requests are that short

Fault beyond(std::uint64_t after, std::uint64_t last) {
    return {FaultCode::not_well_formed,
            "the position " + std::to_string(after) + " is higher than the last sequence of this session: expected at most " +
                std::to_string(last),
            {},
            {}};
}

// Notes how a successful operation changes the connection that asked for it.
void take_turn(Answer& answer, Operation const& operation, Reply const& reply) {
    if (auto const* connected = std::get_if<Connect::Reply>(&reply)) {
        answer.turn = Answer::Turn::connected;
        answer.session = connected->session;
    } else if (auto const* resume = std::get_if<Resume>(&operation)) {
        answer.turn = Answer::Turn::resumed;
        answer.session = resume->session;
        answer.last_sequence = resume->last_sequence;
    } else if (std::holds_alternative<Disconnect>(operation)) {
        answer.turn = Answer::Turn::disconnected;
    }
}

}  // namespace

Hold::Hold(Gateway& gateway, std::shared_ptr<NotificationQueue> queue)
    : gateway_{&gateway}, queue_{std::move(queue)}, place_{queue_->hold()} {}

Hold& Hold::operator=(Hold&& other) noexcept {
    release();
    gateway_ = std::exchange(other.gateway_, nullptr);
    queue_ = std::move(other.queue_);
    place_ = other.place_;
    return *this;
}

void Hold::release() {
    auto* const gateway = std::exchange(gateway_, nullptr);
    if (!gateway) return;
    if (!queue_->release(place_)) return;
    std::lock_guard const lock{gateway->mutex_};
    gateway->readers_.notify(*queue_);
}

// Must not fail: neither call allocates.
Reading::~Reading() {
    if (!queue_) return;
    std::lock_guard const lock{gateway_.mutex_};
    gateway_.readers_.leave(session(), reader_);
    gateway_.engine_.link_closed(session(), link_, closing_, present());
}

void Reading::heard_pong() {
    std::lock_guard const lock{gateway_.mutex_};
    gateway_.engine_.heard_pong(session(), present());
}

Reading::Then Reading::take(std::size_t most, std::vector<Numbered>& into) {
    auto const before = into.size();
    auto const then = queue_->read(after_, most, into);
    if (into.size() > before) after_ = into.back().sequence;
    return then;
}

Reading::Taken Reading::take(std::size_t most) {
    Taken taken;
    taken.then = take(most, taken.notifications);
    return taken;
}

Fault shutting_down() { return {FaultCode::shutting_down, "the gateway is shutting down", {}, {}}; }

Fault no_memory_for_document(MemoryBudget& memory) {
    return {FaultCode::too_many, memory.refuse("there is no memory for a long document"), {}, {}};
}

Fault no_such_session() { return {FaultCode::no_session, "there is no such session; connect first", {}, {}}; }

NotificationDocument::NotificationDocument(Numbered const& numbered)
    : before_{xml::notification_head(numbered.notification->body)}, after_{numbered.notification->text(xml::notification_tail)} {
    digits_size_ =
        static_cast<std::size_t>(std::to_chars(digits_.begin(), digits_.end(), numbered.sequence).ptr - digits_.begin());
}

void NotificationDocument::append_to(std::string& out) const {
    out.append(before_).append(digits_.data(), digits_size_).append(after_);
}

Gateway::Gateway(Engine& engine, Readers& readers, Telemetry& telemetry, ClientLimits limits, MemoryBudget& memory)
    : engine_{engine},
      readers_{readers},
      telemetry_{telemetry},
      memory_{memory},
      quota_{limits.sessions_per_connection, limits.sessions_per_address},
      streams_per_session_{limits.streams_per_session},
      log_{[this](std::uint64_t session) { quota_.ended(session); }} {
    engine_.report_to(log_);
    engine_.keep_within(memory);
    telemetry.set(Telemetry::Limit::sessions_per_connection, limits.sessions_per_connection);
    telemetry.set(Telemetry::Limit::sessions_per_address, limits.sessions_per_address);
    telemetry.set(Telemetry::Limit::streams_per_session, limits.streams_per_session);
}

Answer Gateway::answer(xml::RequestReader& reader, SessionId const& session, std::string_view text, Via via,
                       std::shared_ptr<Opener> const& opener, Reading const* reading) {
    auto const begun = present();
    Answer answer;
    auto const refuse = [&](Fault fault, std::string const& request_id) {
        fault.request_id = request_id;
        answer.document = xml::encode(fault);
        telemetry_.faulted(fault.code);
        answer.fault = std::move(fault);
    };
    std::optional<MemoryBudget::Room> room;
    if (text.size() > negligible) room.emplace(room_for(text));
    if (room && !*room) return refuse(no_memory_for_document(memory_), ""), std::move(answer);
    auto const read = reader.read(text);
    if (auto const way = reader.checked()) telemetry_.checked(*way);
    if (auto const* fault = std::get_if<Fault>(&read)) return refuse(*fault, fault->request_id), std::move(answer);
    auto const& request = std::get<Request>(read);
    auto const* const resume = std::get_if<Resume>(&request.operation);
    if (resume && via == Via::http) {
        refuse({FaultCode::not_allowed,
                "resume works only on a WebSocket; over HTTP, pass after=N or Last-Event-ID to /rois/notifications",
                {},
                {}},
               request.request_id);
        return answer;
    }

    auto const said = perform(session, request.operation, via, opener, reading, begun, answer);
    if (auto const* refusal = std::get_if<Refusal>(&said))
        return refuse(answer.fault ? *answer.fault : fault_of(*refusal), request.request_id), std::move(answer);
    auto const& reply = std::get<Reply>(said);
    answer.document = xml::encode(reply, request.request_id);
    auto const code = std::visit([](Outcome const& outcome) { return outcome.return_code; }, reply);
    telemetry_.answered(request.operation, code, std::chrono::steady_clock::now() - begun.steady);
    if (code == ReturnCode::ok) take_turn(answer, request.operation, reply);
    return answer;
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
                    "too many sessions are open, and none is idle: try again later; the key max_sessions sets the limit",
                    {},
                    {}};
        case Refusal::no_memory:
            return {FaultCode::too_many, memory_.refuse("there is no memory for a new session"), {}, {}};
        case Refusal::shutting_down:
            return rois::shutting_down();
        case Refusal::no_session:
            break;
    }
    return no_such_session();
}

std::variant<Reply, Refusal> Gateway::perform(SessionId const& session, Operation const& operation, Via via,
                                              std::shared_ptr<Opener> const& opener, Reading const* reading, Instant now,
                                              Answer& answer) {
    std::lock_guard const lock{mutex_};
    auto queue = reading != nullptr ? reading->queue_ : engine_.notifications(session);
    bool const known = queue != nullptr;
    // `disconnect` holds nothing: the readers receive the last notifications before the answer (decision 3).
    if (known && !std::holds_alternative<Disconnect>(operation)) answer.hold = Hold{*this, std::move(queue)};
    if (via == Via::http) engine_.heard_from(session, now);
    bool const opens = opener && !known && std::holds_alternative<Connect>(operation);
    if (opens) answer.fault = refusal_of(*opener);
    if (answer.fault) return Refusal::too_many_sessions;
    log_.take_joined();  // of an operation that failed
    auto handled = engine_.handle(session, operation, now);
    answer.session_number = log_.take_joined();
    if (opens && answer.session_number != 0) quota_.opened(answer.session_number, opener);
    if (via == Via::http && !known) heard_from_opened(handled, now);
    return handled;
}

// Returns a fault if this connection may not open another session.
std::optional<Fault> Gateway::refusal_of(Opener const& opener) {
    auto const refused = [](std::string_view holder, std::size_t sessions, std::string_view instead, std::string_view key) {
        return Fault{FaultCode::too_many,
                     std::string{holder} + " has " + std::to_string(sessions) + " sessions open already: disconnect one" +
                         std::string{instead} + "; the key " + std::string{key} + " sets the limit",
                     {},
                     {}};
    };
    switch (quota_.verdict(opener)) {
        case SessionQuota::Verdict::full_connection:
            telemetry_.reached(Telemetry::Limit::sessions_per_connection);
            return refused("this connection", quota_.most_of_connection(), ", or use another connection",
                           "max_sessions_per_connection");
        case SessionQuota::Verdict::full_address:
            telemetry_.reached(Telemetry::Limit::sessions_per_address);
            return refused("this address", quota_.most_of_address(), "", "max_sessions_per_address");
        case SessionQuota::Verdict::open:
            break;
    }
    return {};
}

// Starts the idle time of a session that was just opened over HTTP: its `connect` counts as a sign of life (decision 2).
void Gateway::heard_from_opened(std::variant<Reply, Refusal> const& handled, Instant now) {
    auto const* reply = std::get_if<Reply>(&handled);
    auto const* connected = reply == nullptr ? nullptr : std::get_if<Connect::Reply>(reply);
    if (connected != nullptr) engine_.heard_from(connected->session, now);
}

std::variant<std::unique_ptr<Reading>, Fault> Gateway::read(SessionId const& session, Link link, std::uint64_t after,
                                                            Reader& reader, Readers::Until until) {
    auto reading = std::make_unique<Reading>(*this, link, after, reader);
    std::lock_guard const lock{mutex_};
    auto queue = engine_.notifications(session);
    if (!queue || queue->closed()) return no_such_session();
    if (auto const last = queue->last_sequence(); after > last) return beyond(after, last);
    if (until == Readers::Until::closed && link == Link::stream && Readers::streams(*queue) >= streams_per_session_) {
        telemetry_.reached(Telemetry::Limit::streams_per_session);
        return Fault{FaultCode::too_many,
                     "this session has " + std::to_string(streams_per_session_) +
                         " event streams open already: close one; the key max_streams_per_session sets the limit",
                     {},
                     {}};
    }
    readers_.join(*queue, link, reader, until);
    engine_.link_opened(session, link, present());
    reading->queue_ = std::move(queue);
    return reading;
}

void Gateway::begin() {
    auto const now = present();
    std::lock_guard const lock{mutex_};
    engine_.begin(now);
    telemetry_.ticked(now.steady);
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
        std::lock_guard const lock{mutex_};
        engine_.tick(now);
    }
    telemetry_.ticked(now.steady);
}

// Waits at most a second: a thread that holds the lock for longer will not release it.
void Gateway::halt_at_last() noexcept {
    std::unique_lock lock{mutex_, std::defer_lock};
    for (int tries = 0; tries < 100 && !lock.try_lock(); ++tries) std::this_thread::sleep_for(std::chrono::milliseconds{10});
    if (!lock.owns_lock()) return;
    Attempts attempts;  // a failure of one component does not keep the others from halting
    attempts([&] { engine_.stop_everything(present()); });
}

void Gateway::change(std::function<ComponentChange()> const& make) {
    std::lock_guard const lock{mutex_};
    auto change = make();
    engine_.change(std::move(change), present());
}

StopState Gateway::stop_everything() {
    auto const now = present();
    std::lock_guard const lock{mutex_};
    engine_.stop_everything(now);
    return {engine_.everything_is_stopped(), engine_.not_halted()};
}

StopState Gateway::clear() {
    std::lock_guard const lock{mutex_};
    engine_.clear();
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
    std::lock_guard const lock{mutex_};
    shutting_down_ = true;
    engine_.shut_down(now);
}

std::shared_ptr<EngineProfile const> Gateway::profile() const {
    std::lock_guard const lock{mutex_};
    return engine_.profile();
}

std::vector<ComponentEntry> Gateway::components() const {
    std::lock_guard const lock{mutex_};
    return engine_.components();
}

EngineStatistics Gateway::statistics() const {
    std::lock_guard const lock{mutex_};
    return engine_.statistics();
}

Farewell::Farewell(Gateway& gateway, SessionId session, Reader& reader)
    : gateway_{gateway}, session_{std::move(session)}, reader_{reader} {
    std::lock_guard const lock{gateway_.mutex_};
    gateway_.readers_.join(session_, reader_);
}

Farewell::~Farewell() {
    std::lock_guard const lock{gateway_.mutex_};
    gateway_.readers_.leave(session_, reader_);
}

bool Farewell::alone() const {
    std::lock_guard const lock{gateway_.mutex_};
    return gateway_.readers_.count(session_) == 1;
}

}  // namespace rois
