// The interfaces that all components share in the C++ PSM (section 7.7; tables 31 to 33).
//
// A Command or Query of a component's namespace, for example Navigation, addresses the component of that type that this session
// has bound last, by CommandIF or by a Command. If there is none, a Command first binds any free component of that type, and a
// Query asks any component of that type without binding it. disconnect() and CommandIF::release end such a binding, too.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "RoIS_HRI.hpp"
#include "RoIS_Service.hpp"

// The published header has this line. Programs rely on it and omit the namespace.
using namespace RoIS_HRI;
using namespace RoIS_Service;

namespace rois::psm {

class EventResults;  // the library's

}  // namespace rois::psm

namespace RoIS_Common {

// Table 33.
enum Component_Status { UNINITIALIZED, READY, BUSY, WARNING, ERROR };

// Version 2.0.
enum Stream_Status { STREAMING_NOT_RUNNING, STREAMING_NOT_CONNECTED, STREAMING_RUNNING, STREAMING_SUSPENDED, STREAMING_RESUMED };

// Each function returns when the engine has accepted the command, and completed() reports how it ended. Commands are named
// "<component>.<command>.<number>".
class Command {
public:
    // Addresses the component that this session has bound last, whatever its type; ERROR if there is none.
    Command() = default;
    virtual ~Command() = default;

    virtual RoIS_HRI::ReturnCode_t start();
    virtual RoIS_HRI::ReturnCode_t stop();
    virtual RoIS_HRI::ReturnCode_t suspend();
    virtual RoIS_HRI::ReturnCode_t resume();

protected:
    // Not in the specification. The last part of the type's URN, "Navigation".
    explicit Command(std::string component_type) : component_type_(std::move(component_type)) {}
    std::string const& component_type() const { return component_type_; }

private:
    std::string component_type_;
};

class Query {
public:
    // The same as for Command.
    Query() = default;
    virtual ~Query() = default;

    // BUSY: another session has bound the component.
    virtual RoIS_HRI::ReturnCode_t component_status(Component_Status& status);

protected:
    explicit Query(std::string component_type) : component_type_(std::move(component_type)) {}
    std::string const& component_type() const { return component_type_; }

private:
    std::string component_type_;
};

// The events of a component, with their results. Derive from the Event class of a component and define its functions. The object
// subscribes to all its events at the first operation after its construction, connect() at the latest, and again with every
// connect(). It receives the events of the component of its type that the session has bound last, or of all components of its
// type while none is bound. The rules of construction, destruction and threads are those of RoIS_Service::ServiceApplicationBase.
// A component sends events only after `start`, until `stop`.
class Event {
public:
    Event() : Event(std::string(), std::vector<std::string>()) {}  // receives nothing
    Event(Event const&);
    Event& operator=(Event const&) { return *this; }
    virtual ~Event();

    // Not in the specification; called by the library.
    std::string const& component_type() const { return component_type_; }
    std::vector<std::string> const& event_types() const { return event_types_; }
    virtual void deliver(std::string const& event_type, rois::psm::EventResults const& results);

protected:
    Event(std::string component_type, std::vector<std::string> event_types);

    // Not in the specification. See ServiceApplicationBase.
    void end_notifications();

private:
    std::string component_type_;
    std::vector<std::string> event_types_;
};

}  // namespace RoIS_Common
