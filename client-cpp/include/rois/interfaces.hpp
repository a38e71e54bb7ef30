// The interfaces by the specification's names (7.4.2, tables 2 to 6 and 32; its C++ PSM): they wait for the answer and give the
// return code. Results come in the out parameters, which stay as they are unless the code is OK.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "rois/connection.hpp"

namespace RoIS_HRI {

// The enumerations here have their values in the order of ours (types/codes.hpp): a static_cast goes from one to the other.
enum ReturnCode_t : std::uint8_t { OK, ERROR, BAD_PARAMETER, UNSUPPORTED, OUT_OF_RESOURCES, TIMEOUT };

using DateTime = rois::Utc;
using Integer = std::int32_t;
using RoIS_Identifier = rois::Identifier;
using RoIS_IdentifierList = std::vector<rois::Identifier>;
using Condition_t = rois::QueryExpression;
using Result = rois::Parameter;
using Parameter = rois::Parameter;
using Argument = rois::Parameter;
using ResultList = rois::Results;
using ParameterList = rois::ParameterList;
using ArgumentList = rois::ParameterList;
using CommandUnitSequence = rois::CommandUnitSequence;

// The engine's profile, and the components that meet the condition with theirs.
using HRI_Engine_Profile = rois::GetProfile::Reply;

// What the four interfaces have in common. The connection must outlive them. Not to be called on the client's thread.
class Interface {
public:
    explicit Interface(rois::Connection& connection) : connection_{&connection} {}

    // Why the last operation of this interface was not OK.
    std::string const& reason() const { return reason_; }

protected:
    template <class Op>
    typename Op::Reply call(Op operation) {
        auto reply = connection_->wait(connection_->call(std::move(operation)));
        reason_ = reply.reason;
        return reply;
    }
    rois::Connection& connection() { return *connection_; }
    void set_reason(std::string reason) { reason_ = std::move(reason); }

private:
    rois::Connection* connection_;
    std::string reason_;
};

// Table 2.
class SystemIF : public Interface {
public:
    using Interface::Interface;
    ReturnCode_t connect();     // waits until there is a session
    ReturnCode_t disconnect();  // ends it, and with it the connection
    ReturnCode_t get_profile(Condition_t const& condition, HRI_Engine_Profile& profile);
    ReturnCode_t get_error_detail(rois::ErrorId const& error_id, Condition_t const& condition, ResultList& results);
};

// Table 3.
class CommandIF : public Interface {
public:
    using Interface::Interface;
    ReturnCode_t search(Condition_t const& condition, RoIS_IdentifierList& component_ref_list);
    ReturnCode_t bind(RoIS_Identifier const& component_ref);
    ReturnCode_t bind_any(Condition_t const& condition, RoIS_Identifier& component_ref);
    ReturnCode_t release(RoIS_Identifier const& component_ref);
    ReturnCode_t get_parameter(RoIS_Identifier const& component_ref, ParameterList& parameters);
    ReturnCode_t set_parameter(RoIS_Identifier const& component_ref, ParameterList const& parameters,
                               rois::CommandId& command_id);
    ReturnCode_t execute(CommandUnitSequence& command_unit_list);  // inout: ids are filled in
    ReturnCode_t get_command_result(rois::CommandId const& command_id, Condition_t const& condition, ResultList& results);
};

// Table 4.
class QueryIF : public Interface {
public:
    using Interface::Interface;
    ReturnCode_t query(std::string const& query_type, Condition_t const& condition, ResultList& results);
};

// Table 5.
class EventIF : public Interface {
public:
    using Interface::Interface;
    ReturnCode_t subscribe(std::string const& event_type, Condition_t const& condition, rois::SubscribeId& subscribe_id);
    ReturnCode_t unsubscribe(rois::SubscribeId const& subscribe_id);
    ReturnCode_t get_event_detail(rois::EventId const& event_id, Condition_t const& condition, ResultList& results);
};

}  // namespace RoIS_HRI

// What all components have in common.
namespace RoIS_Common {

enum Component_Status : std::uint8_t { UNINITIALIZED, READY, BUSY, WARNING, ERROR };

// Of one component, which is bound. Each waits until the command is accepted; how it ends is told as `completed`, of
// command_id().
class Command : public RoIS_HRI::Interface {
public:
    Command(rois::Connection& connection, RoIS_HRI::RoIS_Identifier component_ref)
        : Interface{connection}, component_ref_{std::move(component_ref)} {}
    virtual ~Command() = default;

    virtual RoIS_HRI::ReturnCode_t start() { return run("start"); }
    virtual RoIS_HRI::ReturnCode_t stop() { return run("stop"); }
    virtual RoIS_HRI::ReturnCode_t suspend() { return run("suspend"); }
    virtual RoIS_HRI::ReturnCode_t resume() { return run("resume"); }

    rois::CommandId const& command_id() const { return command_id_; }  // of the last one that was accepted

protected:
    RoIS_HRI::ReturnCode_t run(std::string command_type, RoIS_HRI::ArgumentList arguments = {});

private:
    RoIS_HRI::RoIS_Identifier component_ref_;
    rois::CommandId command_id_;
};

class Query : public RoIS_HRI::Interface {
public:
    Query(rois::Connection& connection, RoIS_HRI::RoIS_Identifier component_ref)
        : Interface{connection}, component_ref_{std::move(component_ref)} {}

    RoIS_HRI::ReturnCode_t component_status(Component_Status& status);

private:
    RoIS_HRI::RoIS_Identifier component_ref_;
};

// It has none.
class Event {};

}  // namespace RoIS_Common

namespace RoIS_Service {

enum Completed_Status : std::uint8_t { OK, ERROR, ABORT, OUT_OF_RESOURCES, TIMEOUT };
enum ErrorType : std::uint8_t { ENGINE_INTERNAL_ERROR, COMPONENT_INTERNAL_ERROR, COMPONENT_NOT_RESPONDING, USER_DEFINED_ERROR };

// Table 6: what the engine tells on its own. Derive from it, and give its observers to the connection:
//
//     MyApplication application;
//     rois::Connection connection{settings, application.observers()};
//
// It must outlive the connection. Called on the client's thread: whoever wants to ask the engine more hands that to another
// thread.
class ServiceApplicationBase {
public:
    virtual ~ServiceApplicationBase() = default;

    virtual void receive_event(rois::EventId const& event_id, std::string const& event_type,
                               rois::SubscribeId const& subscribe_id, RoIS_HRI::DateTime expire) = 0;
    virtual void receive_error(rois::ErrorId const& error_id, ErrorType error_type) = 0;
    virtual void completed(rois::CommandId const& command_id, Completed_Status status) = 0;

    rois::Observers observers();
};

}  // namespace RoIS_Service
