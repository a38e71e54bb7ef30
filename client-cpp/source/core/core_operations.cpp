// Operations with side effects on the connection: it restores bindings and subscriptions in a new session, and runs no command
// twice.
#include <algorithm>

#include "core/core.hpp"

namespace rois::detail {

using client::Call;
using client::Interrupted;

namespace {

// Calls the function for each command of a sequence at any depth, in document order.
void for_each_command(std::vector<CommandUnit>& units, auto const& function) {
    for (auto& unit : units) {
        if (auto* const command = std::get_if<CommandMessage>(&unit.unit)) function(*command);
        if (auto* const inner = std::get_if<SequentialCommandUnit>(&unit.unit))
            for_each_command(inner->command_unit_list, function);
        if (auto* const inner = std::get_if<ParallelCommandUnit>(&unit.unit))
            for_each_command(inner->command_unit_list, function);
        if (auto* const inner = std::get_if<ConcurrentCommands>(&unit.unit)) {
            for (auto& branch : inner->branches) for_each_command(branch.command_list, function);
        }
    }
}

// Returns whether the operation contains an id of its session, which another session may give to something else.
bool is_of_session(Operation const& operation) {
    return std::holds_alternative<Unsubscribe>(operation) || std::holds_alternative<GetCommandResult>(operation) ||
           std::holds_alternative<GetEventDetail>(operation) || std::holds_alternative<GetErrorDetail>(operation);
}

bool is_of_lost_session(Answer const& answer) {
    auto const* const none = std::get_if<NoAnswer>(&answer);
    return none != nullptr && none->why == NoAnswer::Why::session_lost;
}

template <class R>
R const* good(Answer const& answer) {
    auto const* const reply = std::get_if<Reply>(&answer);
    auto const* const expected = reply != nullptr ? std::get_if<R>(reply) : nullptr;
    return expected != nullptr && expected->return_code == ReturnCode::ok ? expected : nullptr;
}

// Only the answer to a check has no command_id.
bool lacks_command(Operation const& operation, Answer const& answer) {
    auto const* const set = std::get_if<SetParameter>(&operation);
    auto const* const reply = good<SetParameter::Reply>(answer);
    return set != nullptr && reply != nullptr && !set->check_only && reply->command_id.text.empty();
}

}  // namespace

Task<Answer> Core::request(Request request, std::chrono::milliseconds deadline) {
    auto& operation = request.operation;
    if (auto* const op = std::get_if<Execute>(&operation)) return execute(std::move(*op), deadline);
    if (auto* const op = std::get_if<BindAny>(&operation)) return bind_any(std::move(*op), deadline);
    if (auto* const op = std::get_if<Subscribe>(&operation)) return subscribe_by_request(std::move(*op), deadline);
    if (auto* const op = std::get_if<Unsubscribe>(&operation)) return unsubscribe(std::move(*op), deadline);
    if (std::holds_alternative<Disconnect>(operation)) return disconnect(deadline);
    return plain(std::move(request), deadline);
}

Task<Answer> Core::plain(Request request, std::chrono::milliseconds deadline) {
    auto const self = shared_from_this();
    co_await here();
    if (std::holds_alternative<Resume>(request.operation))
        co_return Fault{FaultCode::not_allowed, "the connection resumes its session by itself"};
    request.request_id = fresh_request_id();
    auto const kind = is_of_session(request.operation) ? Call::Kind::in_session : Call::Kind::again;
    auto const call = send(kind, xml::encode(request), request.request_id, deadline);
    auto& outcome = co_await call->outcome();
    auto& answer = std::get<Answer>(outcome);
    if (lacks_command(request.operation, answer))
        co_return NoAnswer{NoAnswer::Why::not_understood, "the answer to set_parameter has no command_id"};
    if (auto const* const op = std::get_if<Bind>(&request.operation); op != nullptr && good<Bind::Reply>(answer) != nullptr)
        note_bound(*op);
    if (auto const* const op = std::get_if<Release>(&request.operation); op != nullptr && good<Release::Reply>(answer) != nullptr)
        note_released(op->component_ref);
    co_return std::move(answer);
}

// --- Commands ---

// Watches the commands before it sends them: over HTTP, `completed` may arrive before the answer.
Task<std::vector<std::shared_ptr<Watch>>> Core::begin(CommandUnitSequence sequence, std::string what) {
    auto const self = shared_from_this();
    co_await here();
    std::vector<std::shared_ptr<Watch>> watches;
    for_each_command(sequence.command_unit_list, [&](CommandMessage& command) {
        if (command.command_id.text.empty()) command.command_id = fresh_command_id();
        watches.push_back(std::make_shared<Watch>(command.command_id));
        if (!is_closed()) watches_.emplace(command.command_id, watches.back());
    });
    expect_signs_of_life();
    Execute operation{std::move(sequence)};
    auto answer = co_await execute(std::move(operation), settings_.deadline);
    auto const reply = reply_of<Execute>(std::move(answer));
    if (reply.return_code != ReturnCode::ok) {
        forget(watches);
        throw Error{reply.return_code, what + ": " + reply.reason};
    }
    co_return watches;
}

// Removes exactly these watches: other calls may watch commands with the same ids.
void Core::forget(std::vector<std::shared_ptr<Watch>> const& watches) {
    if (is_closed()) return;
    std::erase_if(watches_, [&](auto const& each) { return std::ranges::count(watches, each.second) > 0; });
}

// If the link breaks before the answer, sends the sequence again in the same session: the engine accepts each command id only
// once there. If the engine rejects it then, asks for the result of the first command to learn whether the first attempt had
// arrived.
Task<Answer> Core::execute(Execute operation, std::chrono::milliseconds deadline) {
    auto const self = shared_from_this();
    co_await here();
    client::Deadline const due{deadline};
    CommandId first;
    for_each_command(operation.command_unit_list.command_unit_list, [&](CommandMessage& command) {
        if (command.command_id.text.empty()) command.command_id = fresh_command_id();
        if (first.text.empty()) first = command.command_id;
    });
    Execute::Reply accepted;
    accepted.command_unit_list = operation.command_unit_list;
    Request request{std::move(operation), {}};
    bool doubtful = false;
    for (;;) {
        request.request_id = fresh_request_id();
        auto const kind = doubtful ? Call::Kind::in_session : Call::Kind::once;
        auto const call = send(kind, xml::encode(request), request.request_id, due);
        auto& outcome = co_await call->outcome();
        if (std::holds_alternative<Interrupted>(outcome)) {
            doubtful = true;
            continue;
        }
        auto& answer = std::get<Answer>(outcome);
        bool const refused = std::holds_alternative<Reply>(answer) && good<Execute::Reply>(answer) == nullptr;
        if (!doubtful || !refused || first.text.empty()) co_return std::move(answer);
        Request ask{GetCommandResult{first, {}}, {}};
        auto known = co_await plain(std::move(ask), due.left());
        if (std::holds_alternative<NoAnswer>(known)) co_return known;
        if (good<GetCommandResult::Reply>(known) == nullptr) co_return std::move(answer);
        Reply reply{accepted};
        co_return reply;
    }
}

// --- Bindings ---

void Core::note_bound(Bind binding) {
    note_released(binding.component_ref);
    bound_.push_back(std::move(binding));
    expect_signs_of_life();
}

void Core::note_released(Identifier const& ref) {
    std::erase_if(bound_, [&](auto const& bound) { return bound.component_ref.code == ref.code; });
}

// If the link breaks before the answer, looks for a component that the session has bound but bound_ does not contain: the engine
// answers get_parameter only to the owner of the binding.
Task<Answer> Core::bind_any(BindAny operation, std::chrono::milliseconds deadline) {
    auto const self = shared_from_this();
    co_await here();
    client::Deadline const due{deadline};
    auto const condition = operation.condition;
    auto const switching = operation.switching;
    Request request{std::move(operation), {}};
    for (;;) {
        request.request_id = fresh_request_id();
        auto const call = send(Call::Kind::once, xml::encode(request), request.request_id, due);
        auto& outcome = co_await call->outcome();
        if (!std::holds_alternative<Interrupted>(outcome)) {
            auto& answer = std::get<Answer>(outcome);
            if (auto const* const reply = good<BindAny::Reply>(answer)) note_bound({reply->component_ref, switching});
            co_return std::move(answer);
        }
        Request look{Search{condition}, {}};
        auto const candidates = co_await plain(std::move(look), due.left());
        auto const* const found = good<Search::Reply>(candidates);
        if (found == nullptr) continue;
        for (auto const& ref : found->component_ref_list) {
            if (std::ranges::any_of(bound_, [&](auto const& bound) { return bound.component_ref.code == ref.code; })) continue;
            Request ask{GetParameter{ref}, {}};
            auto const parameters = co_await plain(std::move(ask), due.left());
            if (good<GetParameter::Reply>(parameters) == nullptr) continue;
            note_bound({ref, switching});
            BindAny::Reply done;
            done.component_ref = ref;
            Reply reply{std::move(done)};
            co_return reply;
        }
    }
}

// --- Subscriptions ---

Task<Answer> Core::subscribe_at_engine(Subscribe operation, std::chrono::milliseconds deadline) {
    auto const self = shared_from_this();
    ++subscribing_;
    Request whole{std::move(operation), {}};
    auto answer = co_await plain(std::move(whole), deadline);
    co_return answer;
}

// Leaves `subscribing_` incremented: the caller notes the subscribe_id and then calls end_subscribing.
Task<Answer> Core::subscribe_by_request(Subscribe operation, std::chrono::milliseconds deadline) {
    auto const self = shared_from_this();
    co_await here();
    if (is_closed()) co_return closed();
    if (auto const* const known = subscriptions_.find(operation); known != nullptr && known->has_streams())
        operation.inline_results = true;
    auto answer = co_await subscribe_at_engine(operation, deadline);
    if (auto const* const reply = good<Subscribe::Reply>(answer)) {
        auto& subscription = subscriptions_.of(operation, reply->subscribe_id);
        subscription.by_request = true;
        Subscribe::Reply known = *reply;
        known.subscribe_id = subscription.id;
        answer = Reply{std::move(known)};
    }
    end_subscribing();
    co_return answer;
}

Task<std::shared_ptr<Stream>> Core::subscribe(Subscribe operation) {
    auto const self = shared_from_this();
    co_await here();
    if (is_closed()) throw Error{ReturnCode::error, "subscribe " + operation.event_type + ": " + closed().reason};
    operation.inline_results = true;
    auto answer = co_await subscribe_at_engine(operation, settings_.deadline);
    std::shared_ptr<Stream> stream;
    if (auto const* const reply = good<Subscribe::Reply>(answer)) {
        stream = std::make_shared<Stream>(settings_.most_waiting);
        if (is_closed()) stream->end();
        subscriptions_.of(operation, reply->subscribe_id).streams.push_back(stream);
    }
    end_subscribing();
    if (!stream) {
        auto const failed = reply_of<Subscribe>(std::move(answer));
        throw Error{failed.return_code, "subscribe " + operation.event_type + ": " + failed.reason};
    }
    co_return stream;
}

// Delivers held events from the loop, so that the coroutine that has just subscribed continues first.
void Core::end_subscribing() {
    if (--subscribing_ > 0) return;
    loop_.post([self = shared_from_this()] {
        self->deliver_held();
        self->end_unused();
    });
}

// While a new session is being restored, sends nothing: `restore` skips unused subscriptions, and all_restored ends them.
Task<Answer> Core::unsubscribe(Unsubscribe operation, std::chrono::milliseconds deadline) {
    auto const self = shared_from_this();
    co_await here();
    if (is_closed()) co_return closed();
    auto const id = operation.subscribe_id;
    bool ours = false;
    if (auto* const known = subscriptions_.find(id)) {
        ours = true;
        known->by_request = false;
        if (known->has_streams() || gap_ || subscriptions_.needs_no_unsubscribe(*known)) {
            if (!known->has_streams() && !gap_) subscriptions_.forget(id);
            Reply reply{Unsubscribe::Reply{}};
            co_return reply;
        }
        operation.subscribe_id = known->engine_id;
    }
    Request whole{std::move(operation), {}};
    auto answer = co_await plain(std::move(whole), deadline);
    if (ours && is_of_lost_session(answer)) {
        Reply reply{Unsubscribe::Reply{}};
        co_return reply;
    }
    auto const* const known = subscriptions_.find(id);
    if (known != nullptr && !known->has_streams() && !known->by_request && good<Unsubscribe::Reply>(answer) != nullptr)
        subscriptions_.forget(id);
    co_return answer;
}

// Uses a weak pointer: if the loop has ended, the function stays in its queue and must not keep the Core alive.
void Core::streams_changed() {
    loop_.post([weak = weak_from_this()] {
        if (auto const self = weak.lock()) self->end_unused();
    });
}

// Does nothing while the subscribe_id of a new subscription is unknown: it may be one of these.
void Core::end_unused() {
    if (subscribing_ > 0 || is_closed()) return;
    for (auto& id : subscriptions_.forget_unused()) spawn(unsubscribe_unused(std::move(id)));
}

Task<> Core::unsubscribe_unused(SubscribeId id) {
    auto const self = shared_from_this();
    Request request{Unsubscribe{std::move(id)}, {}};
    co_await plain(std::move(request), settings_.deadline);
}

// --- The end of the session ---

Task<Answer> Core::disconnect(std::chrono::milliseconds deadline) {
    auto const self = shared_from_this();
    co_await here();
    Request whole{Disconnect{}, {}};
    auto answer = co_await plain(std::move(whole), deadline);
    if (good<Disconnect::Reply>(answer) != nullptr) begin_close(Farewell::said);
    co_return answer;
}

}  // namespace rois::detail
