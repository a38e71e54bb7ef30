// The environment of a check: the gateway, the transport, and the service applications.
#pragma once

#include <chrono>
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

namespace rois::conformance {

using kit::Argument;
using kit::Command;
using kit::Document;
using kit::Way;

class Stage {
public:
    Stage(kit::Address address, Way way, Catalogue const& catalogue, Traffic& traffic, double room);

    kit::Address const& address() const { return address_; }
    Way way() const { return way_; }
    Catalogue const& catalogue() const { return catalogue_; }
    Traffic& traffic() { return traffic_; }
    // How far a robot may move from where it stands, in mm. NotPlayed when it may not move.
    double room() const;
    std::chrono::milliseconds patience() const { return address_.patience; }

    // A basic component of one of these kinds; NotPlayed when there is none.
    Component const& one_of(std::vector<std::string> const& kinds) const;
    Component const& speaker() const { return one_of({"speechsynthesis"}); }
    // Its first measurement after `start` is an event (decision 8), also if no person is there.
    Component const& detector() const;
    // A component with start and stop, and another one: of the same engine, if there are two in one.
    std::pair<Component const*, Component const*> two_common() const;

    // Throws Broken when the check goes on for too long.
    void mind_the_time() const;

private:
    kit::Address address_;
    Way way_;
    Catalogue const& catalogue_;
    Traffic& traffic_;
    double room_;
    std::chrono::steady_clock::time_point end_;
};

class Guest;

// The parameters of a component, which are set back in the end if the guest has it bound still.
class Keeping {
public:
    Keeping(Guest& guest, Component const& component);
    ~Keeping();
    Keeping(Keeping const&) = delete;
    Keeping& operator=(Keeping const&) = delete;

private:
    Guest& guest_;
    Component const& component_;
    kit::Values before_;
};

// One robot, as the query robot_position tells it (table 34).
struct Robot {
    std::string ref;
    std::string position;  // "x, y, th"
};

// A service application. It looks at all that it hears, and leaves nothing behind.
class Guest : public kit::Application {
public:
    enum class Comes { connected, as_a_stranger };
    explicit Guest(Stage&, Comes = Comes::connected);
    ~Guest() override;

    // Binds it; NotPlayed when another application has it. Its parameters are set back in the end.
    void take(Component const&);
    // Executes one command, and gives its id.
    std::string order(Command const&);
    // The status with which a command completes that an answer has named; passes over others until then.
    std::string status_of(std::string const& command_id);
    // The same of a command that is executed now.
    std::string ending(Command const& command) { return status_of(order(command)); }
    // The command completes with OK; NotPlayed when the component has failed, which an error tells (decision 16).
    void require_success(std::string const& command_id, Component const&);
    // Waits until all that was caused before has been told. The component is bound and not suspended, so that `resume` does
    // only complete at once.
    void settle(Component const&);
    // get_command_result's `status`.
    std::string state_of(std::string const& command_id);
    std::string component_status(std::string const& ref);
    // The one component of its engine that reports robot_position; null when that cannot be known here.
    Component const* teller_of(Component const&) const;
    // The robot that a component is part of; nothing when that cannot be known here.
    std::optional<Robot> robot_of(Component const&);
    // Returns the statuses with which this command completed.
    std::vector<std::string> endings(std::string const& command_id) const;
    std::size_t heard_events(std::string const& type) const;
    // The first event of this type, and of this component if `ref` is not empty, behind the first `before` notifications of the
    // history.
    std::optional<Document> heard_since(std::size_t before, std::string const& event_type, std::string const& ref = {}) const;
    // Starts a component, and returns its first event of this type. It may come before the end of `start`, which has to wait
    // until `execute` is answered.
    Document start_until(Component const&, std::string const& event_type);

private:
    void check_answer(Document const& answer, std::string const& operation, std::string const& request_id) override;
    void check_notification(Document const&, std::uint64_t sequence) override;
    void check_event(Document const&);
    void ask_for_details();

    Stage& stage_;
    std::map<std::string, Keeping> kept_;  // by component_ref
    std::set<std::string> commands_;       // ids that answers gave
    std::set<std::string> completed_;      // ids
    std::set<std::string> subscriptions_;
    std::vector<std::string> errors_;                     // ids
    std::map<std::string, std::string> events_;           // the parts that all subscriptions share, by id
    std::set<std::pair<std::string, std::string>> told_;  // events and subscriptions, by their ids
};

// This parameter with the type that the profile gives it; NotPlayed when the component has no such parameter.
Argument argument(Component const&, std::string const& name, std::vector<std::string> const& values);
// Returns a text for a speaker: plain text, or SSML for one that accepts only SSML.
Argument spoken(Component const& speaker, std::string const& text);
// What a move of so many millimetres straight on takes.
Argument straight_on(Component const& move, long distance);

// One parameter of a basic component that takes any of some whole numbers.
struct Dial {
    Component const* component;
    std::string parameter;
    std::string type;
    int base;

    std::string text(int value) const { return std::to_string(base + value); }
};
Dial dial_of(Stage const&);
Argument turned(Dial const&, int value);  // 40 to 60

// A speech that goes on for longer than any check.
Command long_speech(Component const& speaker, std::string const& id);
Command short_speech(Component const& speaker, std::string const& id);
Command command(Component const&, std::string const& type, std::string const& id = "", std::optional<int> delay = {});
kit::Xml only(Component const&);  // a condition
std::string unique_name();        // an id that no other application gives

}  // namespace rois::conformance
