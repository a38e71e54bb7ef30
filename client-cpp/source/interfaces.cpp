#include "rois/interfaces.hpp"

#include <utility>

namespace RoIS_HRI {

namespace {

// An out parameter changes when all went well.
template <class Value>
ReturnCode_t give(rois::Outcome const& outcome, Value& out, Value& value) {
    if (outcome.return_code == ReturnCode_t::ok) out = std::move(value);
    return outcome.return_code;
}

}  // namespace

ReturnCode_t SystemIF::connect() {
    auto const problem = connection().wait(connection().opened());
    set_reason(problem ? problem->reason : "");
    if (!problem) return ReturnCode_t::ok;
    return problem->why == rois::NoAnswer::Why::deadline ? ReturnCode_t::timeout : ReturnCode_t::error;
}

ReturnCode_t SystemIF::disconnect() { return call(rois::Disconnect{}).return_code; }

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

ReturnCode_t CommandIF::bind(RoIS_Identifier const& component_ref) { return call(rois::Bind{component_ref}).return_code; }

ReturnCode_t CommandIF::bind_any(Condition_t const& condition, RoIS_Identifier& component_ref) {
    auto reply = call(rois::BindAny{condition});
    return give(reply, component_ref, reply.component_ref);
}

ReturnCode_t CommandIF::release(RoIS_Identifier const& component_ref) { return call(rois::Release{component_ref}).return_code; }

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
    return call(rois::Unsubscribe{subscribe_id}).return_code;
}

ReturnCode_t EventIF::get_event_detail(rois::EventId const& event_id, Condition_t const& condition, ResultList& results) {
    auto reply = call(rois::GetEventDetail{event_id, condition});
    return give(reply, results, reply.results);
}

}  // namespace RoIS_HRI

namespace RoIS_Service {

rois::Observers ServiceApplicationBase::observers() {
    rois::Observers observers;
    observers.notification = [this](rois::Notification const& notification, std::uint64_t) {
        if (auto const* const event = std::get_if<rois::ReceiveEvent>(&notification))
            receive_event(event->event_id, event->event_type, event->subscribe_id, event->expire);
        if (auto const* const error = std::get_if<rois::ReceiveError>(&notification))
            receive_error(error->error_id, error->error_type);
        if (auto const* const command = std::get_if<rois::Completed>(&notification))
            completed(command->command_id, command->status);
    };
    return observers;
}

}  // namespace RoIS_Service
