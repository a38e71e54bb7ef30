// The reference: a small implementation of the rules for sessions, bindings, parameters, commands and subscriptions. It shares no
// code with the engine.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/step.hpp"

namespace rois::model {

// A wrong behaviour that the test can switch on, to show that differences to the engine are found.
enum class Flaw : std::uint8_t {
    none,
    binding_is_shared,                 // against decision 4
    release_lets_run_on,               // 6
    a_name_may_come_again,             // 11
    a_failure_ends_nothing,            // 13
    branches_run_in_sequence,          // 14
    a_delay_is_a_tick_longer,          // 15
    stop_completes_start_with_ok,      // 9
    results_are_kept_for_ever,         // 17
    subscribing_twice_notifies_twice,  // 20
    bad_values_are_stored,             // 26
    values_outlive_the_binding,        // 30
    anybody_reads_stored_values        // 30
};

// The number of results that a session keeps here (decision 17).
inline constexpr std::size_t kept_results = 4;

class Reference {
public:
    explicit Reference(Flaw flaw = Flaw::none) : flaw_{flaw} {}

    // Returns the answer to the step.
    std::string take(Step const&);
    // Returns the notifications of the application since the last call, or nullopt if it has no session.
    std::optional<std::vector<std::string>> received(int session);

private:
    struct Execution;
    struct Command {
        char name;
        std::string type;
        int component;
        int delay;
        int session;
        Execution* execution;  // null once the command has ended
        std::size_t unit, branch, place;
        std::string state = "WAITING";  // WAITING, RUNNING, or its final status
        bool binding_lost = false;

        bool is_over() const { return state != "WAITING" && state != "RUNNING"; }
    };
    using SharedCommand = std::shared_ptr<Command>;
    struct Execution {
        std::vector<std::vector<std::vector<SharedCommand>>> units;
        std::size_t open_branches = 0;  // of the present unit
        bool failed = false;            // one of its branches has failed
    };
    struct Component {
        int bound_to = -1;
        SharedCommand start{};  // the running `start`
        bool is_active = false;
        bool is_suspended = false;
        int halts = 0;
        int unconfirmed_halt = 0;              // the first halt that is not confirmed; 0: none
        std::vector<SharedCommand> waiting{};  // for its confirmation
        std::string default_value{};           // of the parameter
        std::string value = default_value;
    };
    struct Session {
        std::map<char, SharedCommand> known;
        std::deque<char> ended;  // '-' for commands without an id of the application
        int subscriptions = 0;
        std::uint64_t sequence = 0;
        std::vector<std::string> notifications;
    };
    // A component's answer to a call, which it makes when all turns are over.
    struct Report {
        enum class Of { halt, start, suspend, resume } of;
        int component;
        int halt;               // Component::halts at the call
        SharedCommand command;  // null for a halt
    };
    struct Due {
        int time;
        SharedCommand command;
    };

    std::string connect(int session);
    std::string disconnect(int session);
    std::string bind(int session, int component);
    std::string release(int session, int component);
    std::string parameters(Step const&);
    std::string parameters_by_query(Step const&) const;
    void end_binding(Component&) const;
    std::string execute(int session, Plan const&);
    std::string objection(int session, Plan const&) const;
    std::string state_of(Session const&, char name) const;

    void begin(Execution&, std::size_t unit);
    void give_turn(SharedCommand const&);
    void run(SharedCommand const&);
    void start(SharedCommand const&);
    void take(Report const&);
    void end(SharedCommand const&, std::string const& status);
    void abort(SharedCommand const&);
    void halt(Component&, std::string const& status_of_start);
    void settle();
    void pass(int ticks);
    void notify(int session, std::string const& what);
    void forget_old(Session&) const;
    bool is(Flaw flaw) const { return flaw_ == flaw; }

    Flaw flaw_;
    std::array<std::optional<Session>, session_count> sessions_;
    std::array<Component, 3> components_{Component{.default_value = "0"}, Component{.default_value = "50"}, Component{}};
    std::vector<std::unique_ptr<Execution>> executions_;  // also those that have ended
    std::deque<SharedCommand> turns_;                     // commands whose turn has come
    std::deque<Report> reports_;
    std::vector<Due> due_;  // delays, in the order of their beginnings
    int time_ = 0;
};

}  // namespace rois::model
