// The published classes of RoIS_HRI, RoIS_Service and RoIS_Common: each function is one operation of the session.
#include "psm/documents.hpp"
#include "psm/session.hpp"

using rois::psm::entries_of;
using rois::psm::identifier_of;
using rois::psm::request_with_condition;
using rois::psm::Session;

namespace {

// Runs an operation whose reply has results.
template <class Reply>
RoIS_HRI::ReturnCode_t ask_results(std::string_view operation, std::string_view child, std::string const& value,
                                   std::string const& condition, RoIS_HRI::ResultList& results) {
    return Session::instance().send<Reply>(
        condition, request_with_condition(operation, {{child, value}}, condition),
        [&](Reply const& reply, std::string const&) { results = entries_of<RoIS_HRI::Result>(reply.results.parameters); });
}

}  // namespace

namespace RoIS_HRI {

ReturnCode_t SystemIF::connect() { return Session::instance().connect(); }

ReturnCode_t SystemIF::disconnect() { return Session::instance().disconnect(); }

ReturnCode_t SystemIF::get_profile(Condition_t condition, HRI_Engine_Profile& profile) {
    return Session::instance().send<rois::GetProfile::Reply>(
        condition, request_with_condition("get_profile", {}, condition),
        [&](rois::GetProfile::Reply const&, std::string const& response) { profile = rois::psm::engine_profile_in(response); });
}

ReturnCode_t SystemIF::get_error_detail(std::string error_id, Condition_t condition, ResultList& results) {
    rois::Results read;
    auto const code = Session::instance().get_error_detail(error_id, condition, read);
    if (code == OK) results = entries_of<Result>(read.parameters);
    return code;
}

ReturnCode_t CommandIF::search(Condition_t condition, RoIS_IdentifierList& component_ref_list) {
    return Session::instance().send<rois::Search::Reply>(condition, request_with_condition("search", {}, condition),
                                                         [&](rois::Search::Reply const& reply, std::string const&) {
                                                             component_ref_list.clear();
                                                             for (auto const& ref : reply.component_ref_list)
                                                                 component_ref_list.push_back(ref.code);
                                                         });
}

ReturnCode_t CommandIF::bind(RoIS_Identifier component_ref) { return Session::instance().bind(std::move(component_ref)); }

ReturnCode_t CommandIF::bind_any(Condition_t condition, RoIS_Identifier& component_ref) {
    return Session::instance().bind_any(condition, component_ref);
}

ReturnCode_t CommandIF::release(RoIS_Identifier component_ref) { return Session::instance().release(std::move(component_ref)); }

ReturnCode_t CommandIF::get_parameter(RoIS_Identifier component_ref, ParameterList& parameters) {
    return Session::instance().call(
        rois::GetParameter{identifier_of(std::move(component_ref))},
        [&](rois::GetParameter::Reply const& reply) { parameters = entries_of<Parameter>(reply.parameters); });
}

ReturnCode_t CommandIF::set_parameter(RoIS_Identifier component_ref, ParameterList parameters, std::string& command_id) {
    return Session::instance().call(
        rois::SetParameter{identifier_of(std::move(component_ref)), rois::psm::parameters_of(parameters)},
        [&](rois::SetParameter::Reply const& reply) { command_id = reply.command_id.text; });
}

ReturnCode_t CommandIF::execute(CommandUnitSequence command_unit_list) { return Session::instance().execute(command_unit_list); }

ReturnCode_t CommandIF::get_command_result(std::string command_id, Condition_t condition, ResultList& results) {
    return ask_results<rois::GetCommandResult::Reply>("get_command_result", "command_id", command_id, condition, results);
}

ReturnCode_t QueryIF::query(std::string query_type, Condition_t condition, ResultList& results) {
    return ask_results<rois::Query::Reply>("query", "query_type", query_type, condition, results);
}

ReturnCode_t EventIF::subscribe(std::string event_type, Condition_t condition, std::string& subscribe_id) {
    return Session::instance().subscribe(event_type, condition, subscribe_id);
}

ReturnCode_t EventIF::unsubscribe(std::string subscribe_id) { return Session::instance().unsubscribe(subscribe_id); }

ReturnCode_t EventIF::get_event_detail(std::string event_id, Condition_t condition, ResultList& results) {
    return ask_results<rois::GetEventDetail::Reply>("get_event_detail", "event_id", event_id, condition, results);
}

}  // namespace RoIS_HRI

namespace RoIS_Service {

ServiceApplicationBase::ServiceApplicationBase() { Session::instance().add(this); }
ServiceApplicationBase::ServiceApplicationBase(ServiceApplicationBase const&) { Session::instance().add(this); }
ServiceApplicationBase::~ServiceApplicationBase() { Session::instance().remove(this); }

void ServiceApplicationBase::notify_error(std::string, ErrorType) {}
void ServiceApplicationBase::completed(std::string, Completed_Status) {}
void ServiceApplicationBase::notify_event(std::string, std::string, std::string, DateTime) {}

void ServiceApplicationBase::end_notifications() { Session::instance().remove(this); }

}  // namespace RoIS_Service

namespace RoIS_Common {

RoIS_HRI::ReturnCode_t Command::start() { return Session::instance().run(component_type_, "start", {}); }
RoIS_HRI::ReturnCode_t Command::stop() { return Session::instance().run(component_type_, "stop", {}); }
RoIS_HRI::ReturnCode_t Command::suspend() { return Session::instance().run(component_type_, "suspend", {}); }
RoIS_HRI::ReturnCode_t Command::resume() { return Session::instance().run(component_type_, "resume", {}); }

RoIS_HRI::ReturnCode_t Query::component_status(Component_Status& status) {
    rois::psm::EventResults results;
    auto const code = Session::instance().query(component_type_, "component_status", {}, results);
    if (code != RoIS_HRI::OK || rois::psm::read_status(results.text("status"), status)) return code;
    rois::psm::set_reason("the answer has no status");
    return RoIS_HRI::ERROR;
}

Event::Event(std::string component_type, std::vector<std::string> event_types)
    : component_type_(std::move(component_type)), event_types_(std::move(event_types)) {
    Session::instance().add(this);
}

Event::Event(Event const& other) : component_type_(other.component_type_), event_types_(other.event_types_) {
    Session::instance().add(this);
}

Event::~Event() { Session::instance().remove(this); }

void Event::deliver(std::string const&, rois::psm::EventResults const&) {}

void Event::end_notifications() { Session::instance().remove(this); }

}  // namespace RoIS_Common
