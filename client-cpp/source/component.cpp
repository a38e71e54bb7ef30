#include "rois/component.hpp"

#include "core/core.hpp"

namespace rois {

using detail::asked;

namespace {

// Asks the engine why a command failed. Returns its reason (may be empty), or why the engine did not answer.
Task<std::string> reason_of(std::shared_ptr<detail::Core> core, CommandId id) {
    Request request{GetCommandResult{std::move(id), {}}, {}};
    auto answer = co_await core->request(std::move(request), core->settings().deadline);
    if (auto const* const none = std::get_if<NoAnswer>(&answer)) co_return none->reason;
    auto const reply = reply_of<GetCommandResult>(std::move(answer));
    auto const* const reason = find(reply.results.parameters, "reason");
    co_return reason != nullptr && !reason->values.empty() ? reason->values.front() : std::string{};
}

Task<Completion> completed_of(std::shared_ptr<detail::Core> core, std::shared_ptr<detail::Watch> watch) {
    co_await core->here();
    while (!watch->status && !core->is_closed()) co_await watch->completed.raised();
    Completion completion{watch->status.value_or(CompletedStatus::abort), watch->reason};
    if (!watch->status) {
        completion.reason = core->closed().reason;
    } else if (completion.status != CompletedStatus::ok && watch->reason.empty()) {
        completion.reason = co_await reason_of(core, watch->id);
    }
    co_return completion;
}

Task<Results> results_of(std::shared_ptr<detail::Core> core, CommandId id) {
    GetCommandResult operation{std::move(id), {}};
    auto reply = co_await asked(std::move(core), std::move(operation), "get_command_result");
    co_return std::move(reply.results);
}

Task<ParameterList> parameters_of(std::shared_ptr<detail::Core> core, Identifier ref) {
    auto whom = ref.code;
    GetParameter operation{std::move(ref)};
    auto reply = co_await asked(std::move(core), std::move(operation), "get_parameter of ", std::move(whom));
    co_return std::move(reply.parameters);
}

Task<Command> begun(std::shared_ptr<detail::Core> core, Identifier ref, std::string command_type, ParameterList arguments) {
    co_await core->here();
    auto what = command_type + " of " + ref.code;
    CommandUnit unit{{}, CommandMessage{std::move(ref), std::move(command_type), {}, std::move(arguments)}};
    CommandUnitSequence sequence;
    sequence.command_unit_list.push_back(std::move(unit));
    auto const watches = co_await core->begin(std::move(sequence), std::move(what));
    co_return Command{core, watches.front()};
}

Task<Completion> run_to_the_end(std::shared_ptr<detail::Core> core, Identifier ref, std::string command_type,
                                ParameterList arguments) {
    auto const command = co_await begun(std::move(core), std::move(ref), std::move(command_type), std::move(arguments));
    auto completion = co_await command.completed();
    co_return completion;
}

Task<Results> queried(std::shared_ptr<detail::Core> core, Identifier ref, std::string query_type) {
    auto whom = query_type + " of " + ref.code;
    Query operation{std::move(query_type), {conditions::component_ref == ref.code}};
    auto reply = co_await asked(std::move(core), std::move(operation), "", std::move(whom));
    co_return std::move(reply.results);
}

Task<ComponentStatus> status_of(std::shared_ptr<detail::Core> core, Identifier ref) {
    auto const what = "component_status of " + ref.code;
    auto const results = co_await queried(std::move(core), std::move(ref), "component_status");
    auto const* const status = find(results.parameters, "status");
    auto const code =
        status != nullptr && !status->values.empty() ? to_code<ComponentStatus>(status->values.front()) : std::nullopt;
    if (!code) throw Error{ReturnCode::error, what + ": the answer has no status"};
    co_return *code;
}

Task<EventStream> subscribed(std::shared_ptr<detail::Core> core, std::string event_type, QueryExpression condition) {
    Subscribe operation{std::move(event_type), std::move(condition), true};
    auto stream = co_await core->subscribe(std::move(operation));
    co_return EventStream{core, std::move(stream)};
}

Task<> bound(std::shared_ptr<detail::Core> core, Identifier ref, Switching switching) {
    auto whom = ref.code;
    Bind operation{std::move(ref), switching};
    co_await asked(std::move(core), std::move(operation), "bind ", std::move(whom));
}

Task<> released(std::shared_ptr<detail::Core> core, Identifier ref) {
    auto whom = ref.code;
    Release operation{std::move(ref)};
    co_await asked(std::move(core), std::move(operation), "release ", std::move(whom));
}

}  // namespace

std::string to_text(Completion const& completion) {
    return std::string{to_text(completion.status)} + (completion.reason.empty() ? "" : ": " + completion.reason);
}

Command::Command(std::shared_ptr<detail::Core> core, std::shared_ptr<detail::Watch> watch)
    : core_{std::move(core)}, watch_{std::move(watch)} {}

CommandId const& Command::id() const { return watch_->id; }

Task<Completion> Command::completed() const { return completed_of(core_, watch_); }

Task<Results> Command::results() const { return results_of(core_, watch_->id); }

Component::Component(std::shared_ptr<detail::Core> core, Identifier ref) : core_{std::move(core)}, ref_{std::move(ref)} {}

Task<Completion> Component::run(std::string command_type, ParameterList arguments) const {
    return run_to_the_end(core_, ref_, std::move(command_type), std::move(arguments));
}

Task<Command> Component::begin(std::string command_type, ParameterList arguments) const {
    return begun(core_, ref_, std::move(command_type), std::move(arguments));
}

Task<ParameterList> Component::get_parameter() const { return parameters_of(core_, ref_); }

Task<ComponentStatus> Component::component_status() const { return status_of(core_, ref_); }

Task<Results> Component::query(std::string query_type) const { return queried(core_, ref_, std::move(query_type)); }

Task<EventStream> Component::subscribe(std::string event_type, QueryExpression condition) const {
    return subscribed(core_, std::move(event_type), narrowed(std::move(condition), conditions::component_ref == ref_.code));
}

Task<> Component::bind(Switching switching) const { return bound(core_, ref_, switching); }

Task<> Component::release() const { return released(core_, ref_); }

}  // namespace rois
