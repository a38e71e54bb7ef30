// The context of a check: the gateway, the transport, and the service applications.
#pragma once

#include <chrono>
#include <future>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "conformance/catalogue.hpp"
#include "conformance/check.hpp"
#include "conformance/traffic.hpp"
#include "kit/application.hpp"
#include "kit/http_client.hpp"
#include "kit/websocket_client.hpp"

namespace rois::conformance {

using kit::Argument;
using kit::Command;
using kit::Document;
using kit::Transport;

class Context {
public:
    Context(kit::Address address, Transport transport, Catalogue const& catalogue, Traffic& traffic, double room,
            std::string disturbance);

    kit::Address const& address() const { return address_; }
    Transport transport() const { return transport_; }
    Catalogue const& catalogue() const { return catalogue_; }
    Traffic& traffic() { return traffic_; }
    // Returns the greatest distance of a robot from its starting point, in mm. Throws Skipped if robots must not move (--room 0).
    double room() const;
    // Makes a component fail for some seconds (--disturb). The end of the future waits for the end of the command. `can_disturb`
    // throws Skipped if there is no such command.
    void can_disturb() const;
    std::future<int> disturb(std::string const& ref) const;
    std::chrono::milliseconds patience() const { return address_.patience; }

    // Returns a basic component of one of these kinds; earlier kinds come first. Throws Skipped if the gateway has none.
    Component const& component_of_kind(std::vector<std::string> const& kinds) const;
    Component const& speaker() const { return component_of_kind({"speechsynthesis"}); }
    // Returns a detection component: its first measurement after `start` is an event (decision 8), even if no person is present.
    Component const& detector() const;
    // Returns two components with start and stop, of the same engine if possible. Throws Skipped if the gateway has fewer.
    std::pair<Component const*, Component const*> two_common_components() const;

    // Throws Broken if the check exceeds its time limit.
    void check_deadline() const;

private:
    kit::Address address_;
    Transport transport_;
    Catalogue const& catalogue_;
    Traffic& traffic_;
    double room_;
    std::string disturbance_;
    std::chrono::steady_clock::time_point end_;
};

// A WebSocket without the notifications that may come at any time: the profile of the gateway may change.
class WebSocket : public kit::WebSocketClient {
public:
    explicit WebSocket(Context const& context) : WebSocketClient{context.address()} { skip("profile_changed"); }
};

class Client;

// Saves the parameters of a bound component. The destructor restores them if the component is still bound.
class SavedParameters {
public:
    SavedParameters(Client& client, Component const& component);
    ~SavedParameters();
    SavedParameters(SavedParameters const&) = delete;
    SavedParameters& operator=(SavedParameters const&) = delete;

private:
    Client& client_;
    Component const& component_;
    kit::Values saved_;
};

// A robot, as the query robot_position reports it (table 34).
struct Robot {
    std::string ref;
    std::string position;  // "x, y, th"
};

// A service application that checks each answer and notification. The destructor restores parameters and disconnects.
class Client : public kit::Application {
public:
    enum class Initially { connected, disconnected };
    explicit Client(Context&, Initially = Initially::connected);
    ~Client() override;

    // Binds the component and saves its parameters for the destructor. Throws Skipped if another application uses the component.
    void bind_or_skip(Component const&);
    // Executes one command and returns its id.
    std::string execute_one(Command const&);
    // Waits until the command completes, and returns its status. Throws Broken if no answer contained this id.
    std::string status_of(std::string const& command_id);
    // Executes one command, waits until it completes, and returns its status.
    std::string run(Command const& command) { return status_of(execute_one(command)); }
    // Requires that the command completes with OK. Throws Skipped if the component has failed, with a receive_error (decision
    // 16).
    void require_success(std::string const& command_id, Component const&);
    // Waits until the notifications of all earlier requests have arrived. The component must be bound and not suspended: this
    // executes `resume`, which then has no effect and completes at once.
    void flush_notifications(Component const&);
    // Returns the `status` in get_command_result.
    std::string command_state(std::string const& command_id);
    std::string component_status(std::string const& ref);
    // Returns the component that reports robot_position for this component's robot. Returns null unless exactly one component of
    // the engine does.
    Component const* position_reporter_of(Component const&) const;
    // Returns the robot of a component, or nothing if robot_position does not report exactly one.
    std::optional<Robot> robot_of(Component const&);
    // Returns the status of each `completed` of this command.
    std::vector<std::string> completion_statuses(std::string const& command_id) const;
    std::size_t count_events(std::string const& type) const;
    // Returns the first event of this type after the first `before` notifications of the history. If `ref` is not empty, the
    // event must be of this component.
    std::optional<Document> first_event_after(std::size_t before, std::string const& event_type,
                                              std::string const& ref = {}) const;
    // Starts a component, and returns its first event of this type. The event may precede the end of `start`.
    Document start_and_receive(Component const&, std::string const& event_type);

private:
    void check_answer(Document const& answer, std::string const& operation, std::string const& request_id) override;
    void check_notification(Document const&, std::uint64_t sequence) override;
    void check_event(Document const&);
    void check_error_details();

    Context& context_;
    std::map<std::string, SavedParameters> saved_parameters_;  // by component_ref
    std::set<std::string> commands_;                           // ids from answers
    std::set<std::string> completed_;                          // ids
    std::set<std::string> subscriptions_;
    std::vector<std::string> errors_;                                // ids
    std::map<std::string, std::string> events_;                      // event id -> the parts that are equal for all subscriptions
    std::set<std::pair<std::string, std::string>> received_events_;  // ids of event and subscription
};

// Returns an argument with the type from the profile. Throws Skipped if the component has no such parameter.
Argument argument(Component const&, std::string const& name, std::vector<std::string> const& values);
// Returns the argument with this text for a speech component: SSML_text if it lacks speech_text.
Argument speech_argument(Component const& speaker, std::string const& text);
// Returns the argument `line` for a straight move; `distance` in millimetres.
Argument straight_line(Component const& move, long distance);

// An integer parameter of a basic component. Its valid values include `base` + 40 to `base` + 60.
struct NumberParameter {
    Component const* component;
    std::string name;
    std::string type;
    int base;

    std::string text(int value) const { return std::to_string(base + value); }
};
NumberParameter number_parameter_of(Context const&);
Argument with_value(NumberParameter const&, int value);  // `value`: 40 to 60, added to `base`

// Returns a `start` of speech that takes longer than any check.
Command long_speech(Component const& speaker, std::string const& id);
Command short_speech(Component const& speaker, std::string const& id);
Command command(Component const&, std::string const& type, std::string const& id = "", std::optional<int> delay = {});
kit::Xml only(Component const&);  // a condition that selects this component
std::string unique_name();        // a command id that no other application uses

}  // namespace rois::conformance
