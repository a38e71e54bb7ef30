#include "rois/interfaces.hpp"

#include <optional>
#include <utility>

#include "rois/condition.hpp"

namespace RoIS_HRI {

namespace {

static_assert(static_cast<ReturnCode_t>(rois::ReturnCode::timeout) == TIMEOUT);
static_assert(static_cast<RoIS_Common::Component_Status>(rois::ComponentStatus::error) == RoIS_Common::ERROR);
static_assert(static_cast<RoIS_Service::Completed_Status>(rois::CompletedStatus::timeout) == RoIS_Service::TIMEOUT);
static_assert(static_cast<RoIS_Service::ErrorType>(rois::ErrorType::user_defined_error) == RoIS_Service::USER_DEFINED_ERROR);

ReturnCode_t code_of(rois::Outcome const& outcome) { return static_cast<ReturnCode_t>(outcome.return_code); }

// An out parameter changes when all went well.
template <class Value>
ReturnCode_t give(rois::Outcome const& outcome, Value& out, Value& value) {
    if (code_of(outcome) == OK) out = std::move(value);
    return code_of(outcome);
}

}  // namespace

ReturnCode_t SystemIF::connect() {
    auto const problem = connection().wait(connection().opened());
    set_reason(problem ? problem->reason : "");
    if (!problem) return OK;
    return problem->why == rois::NoAnswer::Why::deadline ? TIMEOUT : ERROR;
}

ReturnCode_t SystemIF::disconnect() { return code_of(call(rois::Disconnect{})); }

ReturnCode_t SystemIF::get_profile(Condition_t const& condition, HRI_Engine_Profile& profile) {
    auto reply = call(rois::GetProfile{condition});
    return give(reply, profile, reply);
}

ReturnCode_t SystemIF::get_error_detail(rois::ErrorId const& error_id, Condition_t const& condition, ResultList& results) {
    auto reply = call(rois::GetErrorDetail{error_id, condition});
    return give(reply, results, reply.results);
}

ReturnCode_t CommandIF::search(Condition_t const& condition, RoIS_IdentifierList& component_ref_list) {
    auto reply = call(rois::Search{condition});
    return give(reply, component_ref_list, reply.component_ref_list);
}

ReturnCode_t CommandIF::bind(RoIS_Identifier const& component_ref) { return code_of(call(rois::Bind{component_ref})); }

ReturnCode_t CommandIF::bind_any(Condition_t const& condition, RoIS_Identifier& component_ref) {
    auto reply = call(rois::BindAny{condition});
    return give(reply, component_ref, reply.component_ref);
}

ReturnCode_t CommandIF::release(RoIS_Identifier const& component_ref) { return code_of(call(rois::Release{component_ref})); }

ReturnCode_t CommandIF::get_parameter(RoIS_Identifier const& component_ref, ParameterList& parameters) {
    auto reply = call(rois::GetParameter{component_ref});
    return give(reply, parameters, reply.parameters);
}

ReturnCode_t CommandIF::set_parameter(RoIS_Identifier const& component_ref, ParameterList const& parameters,
                                      rois::CommandId& command_id) {
    auto reply = call(rois::SetParameter{component_ref, parameters});
    return give(reply, command_id, reply.command_id);
}

ReturnCode_t CommandIF::execute(CommandUnitSequence& command_unit_list) {
    auto reply = call(rois::Execute{command_unit_list});
    return give(reply, command_unit_list, reply.command_unit_list);
}

ReturnCode_t CommandIF::get_command_result(rois::CommandId const& command_id, Condition_t const& condition, ResultList& results) {
    auto reply = call(rois::GetCommandResult{command_id, condition});
    return give(reply, results, reply.results);
}

ReturnCode_t QueryIF::query(std::string const& query_type, Condition_t const& condition, ResultList& results) {
    auto reply = call(rois::Query{query_type, condition});
    return give(reply, results, reply.results);
}

ReturnCode_t EventIF::subscribe(std::string const& event_type, Condition_t const& condition, rois::SubscribeId& subscribe_id) {
    auto reply = call(rois::Subscribe{event_type, condition, false});
    return give(reply, subscribe_id, reply.subscribe_id);
}

ReturnCode_t EventIF::unsubscribe(rois::SubscribeId const& subscribe_id) {
    return code_of(call(rois::Unsubscribe{subscribe_id}));
}

ReturnCode_t EventIF::get_event_detail(rois::EventId const& event_id, Condition_t const& condition, ResultList& results) {
    auto reply = call(rois::GetEventDetail{event_id, condition});
    return give(reply, results, reply.results);
}

}  // namespace RoIS_HRI

namespace RoIS_Common {

RoIS_HRI::ReturnCode_t Command::run(std::string command_type, RoIS_HRI::ArgumentList arguments) {
    RoIS_HRI::CommandUnitSequence sequence;
    sequence.command_unit_list.push_back(
        {{}, rois::CommandMessage{component_ref_, std::move(command_type), {}, std::move(arguments)}});
    auto const reply = call(rois::Execute{std::move(sequence)});
    if (reply.return_code == rois::ReturnCode::ok)
        command_id_ = std::get<rois::CommandMessage>(reply.command_unit_list.command_unit_list.at(0).unit).command_id;
    return static_cast<RoIS_HRI::ReturnCode_t>(reply.return_code);
}

RoIS_HRI::ReturnCode_t Query::component_status(Component_Status& status) {
    auto const reply = call(rois::Query{"component_status", rois::conditions::component_ref == component_ref_.code});
    if (reply.return_code != rois::ReturnCode::ok) return static_cast<RoIS_HRI::ReturnCode_t>(reply.return_code);
    auto const* const told = rois::find(reply.results.parameters, "status");
    auto const code =
        told != nullptr && !told->values.empty() ? rois::to_code<rois::ComponentStatus>(told->values.front()) : std::nullopt;
    if (!code) {
        set_reason("the answer has no status");
        return RoIS_HRI::ERROR;
    }
    status = static_cast<Component_Status>(*code);
    return RoIS_HRI::OK;
}

}  // namespace RoIS_Common

namespace RoIS_Service {

rois::Observers ServiceApplicationBase::observers() {
    rois::Observers observers;
    observers.notification = [this](rois::Notification const& notification, std::uint64_t) {
        if (auto const* const event = std::get_if<rois::ReceiveEvent>(&notification))
            receive_event(event->event_id, event->event_type, event->subscribe_id, event->expire);
        if (auto const* const error = std::get_if<rois::ReceiveError>(&notification))
            receive_error(error->error_id, static_cast<ErrorType>(error->error_type));
        if (auto const* const command = std::get_if<rois::Completed>(&notification))
            completed(command->command_id, static_cast<Completed_Status>(command->status));
    };
    return observers;
}

}  // namespace RoIS_Service
