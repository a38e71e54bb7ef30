// Runs commands: single ones for set_parameter, whole sequences for execute. Each command completes exactly once (decisions 8, 9,
// 12 to 17).
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/commands/deadlines.hpp"
#include "engine/commands/execution.hpp"
#include "engine/commands/sequence_check.hpp"
#include "engine/journal/recorder.hpp"
#include "engine/notifications/notifier.hpp"
#include "engine/questions.hpp"
#include "engine/registry.hpp"
#include "engine/settings.hpp"
#include "engine/trace.hpp"

namespace rois {

class Executor {
public:
    Executor(EngineSettings const& settings, Registry const& registry, Agenda& agenda, Deadlines& deadlines, Notifier& notifier,
             Questions& questions, Trace* const& trace, Recorder& recorder)
        : settings_{settings},
          registry_{registry},
          agenda_{agenda},
          deadlines_{deadlines},
          notifier_{notifier},
          questions_{questions},
          trace_{trace},
          recorder_{recorder} {}
    ~Executor();
    Executor(Executor const&) = delete;
    Executor& operator=(Executor const&) = delete;

    // Makes the commands of a sequence, which then wait. It must have passed SequenceCheck, and all its commands must have ids,
    // and be prepared. `begin` lets them run; `drop` forgets those that have not ended.
    std::shared_ptr<Execution> make(Session&, CommandUnitSequence const&, std::vector<Preparation>);
    void begin(std::shared_ptr<Execution> const&, Instant now);
    void drop(Session&, Execution const&);
    // The same for commands that have just been made, or whose session has ended (null).
    void take_back(Session*, Execution const&) noexcept;

    // Returns an id that is new to this session and not in `taken`.
    CommandId fresh_id(Session const&, std::set<CommandId> const& taken);

    // Called when a component reports through its port.
    void started(CommandHandle);
    void completed(CommandEnded&, Instant now);
    void halted(RegisteredComponent&, Ticket, Instant now);

    // Called when a call to the component has thrown: the call that began a command, or that halted the component.
    void failed(CommandHandle, Instant now);
    void halt_failed(RegisteredComponent&, Ticket, Instant now);
    void count_stray_answer() { ++stray_answers_; }

    // Halts the component, even if the engine believes that it is idle, and repeats this until the halt is confirmed (decision
    // 35). Ends the commands that run there: `start` with this status, commands of the component's own profile with ABORT. Halts
    // the component also when memory is short; `repair` then ends the remaining commands. Commands that are being prepared or
    // stored do not begin any more.
    void halt(RegisteredComponent&, CompletedStatus status_of_start, std::string_view reason, Instant now);

    // Halts the component, and ends the session's commands that wait for it (decision 6).
    void release(Session&, RegisteredComponent&, Instant now, std::string_view reason = "its component was released");

    // Halts a component that leaves the engine, and ends the commands of all sessions that wait for it.
    void part(RegisteredComponent&, Instant now);

    // Suspends the component, or halts it if that fails. Reports the reason as an error (decision 33).
    void hold(RegisteredComponent&, std::string_view reason, Instant now);

    // Ends all commands of the session with ABORT. Does not halt components.
    void abort_all(Session&, Instant now);

    // Lets the commands of an ending session continue. Their notifications are dropped.
    void detach_commands(Session&);

    // Halts every component, and ends all waiting and running commands of all sessions.
    void stop_all(std::string_view reason, Instant now);

    // Removes expired results: of the session, or of all sessions.
    void forget_old_results(Session&, Instant now);
    void forget_old_results(Instant now);

    // Continues work that an exception interrupted: ends the commands that were given up, and halts their components. Call at
    // each tick.
    // `reports_lost`: some component could not store a report.
    void repair(Instant now, bool reports_lost);
    // Keeps only the results of the session's last `most` commands.
    void keep_results(Session&, std::size_t most);

    // Call when the session ends: forget_old_results() no longer looks at its results.
    void forget(Session&);

    // Adds a command from before a restart, which has ended.
    void restore(Session&, std::shared_ptr<Command> const&, Instant now);
    // The ids of commands that the engine chooses continue after the last one.
    std::uint64_t last_id() const { return last_id_; }
    std::uint64_t last_handle() const { return last_handle_; }
    void continue_ids(std::uint64_t last_id, std::uint64_t last_handle) {
        last_id_ = last_id;
        last_handle_ = last_handle;
    }
    // Ends a command from before a restart whose end its sub engine has told.
    void ended_there(std::shared_ptr<Command> const&, CommandEnded&&, Instant now);

    std::array<std::uint64_t, 5> const& completed_by_status() const { return completed_by_status_; }
    std::uint64_t stray_answers() const { return stray_answers_; }

private:
    // For halt, suspend and resume (decision 35).
    static constexpr std::chrono::milliseconds time_to_confirm{500};

    using SharedCommand = std::shared_ptr<Command>;

    using Suspended = RegisteredComponent::Suspended;

    SharedCommand make(Session&, CommandMessage const&, Preparation&&);
    void withdraw(Session*, Command const&) noexcept;
    void give_turns(std::shared_ptr<Execution> const&, std::vector<Execution::Turn> const&, Instant now);
    void run_ready(Instant now);
    void run(SharedCommand const&, Instant now);
    void run_set_parameter(SharedCommand const&, Instant now);
    void run_start(SharedCommand const&, Instant now);
    void store_arguments(Command const&);
    void run_stop(SharedCommand const&, Instant now);
    void run_suspend(SharedCommand const&, Instant now);
    void run_resume(SharedCommand const&, Instant now);
    void run_function(SharedCommand const&, Instant now);
    void go_on_with_start(SharedCommand const&, Instant now);
    void begin(SharedCommand const&, Instant now);
    void begin(SharedCommand const&, ParameterList parameters, Instant now);
    Ticket ask_to_confirm(SharedCommand const&, Suspended afterwards, Instant now);
    void begin_failed(SharedCommand const&, std::string_view reason, Instant now);
    void stop_instead_of_hold(RegisteredComponent&, std::string_view reason, Instant now);
    void end_action(RegisteredComponent&, CompletedStatus status_of_start, std::string_view reason, Instant now);
    void halt_if_it_moves(RegisteredComponent&, Instant now);
    void ask_to_halt(RegisteredComponent&, Instant now);
    void await_confirmation(RegisteredComponent&, Instant now);
    void halt_failed(RegisteredComponent&, CompletedStatus, std::string_view reason, Instant now);
    void halt_again_later(RegisteredComponent&, Instant now);
    void go_on(RegisteredComponent&, Instant now);
    void forget_halt(RegisteredComponent&, Instant now);
    void wait_for_halt(SharedCommand const&, Instant now);
    std::chrono::milliseconds time_to_start(Command const&) const;
    void await_start(SharedCommand const&, Instant now);
    void start_timed_out(CommandHandle, Instant now);
    static void follow_up(RegisteredComponent&, SharedCommand const&, Afterwards);
    // `reason`: why the status is not OK, for people.
    void end(SharedCommand const&, CompletedStatus, std::string_view reason, Instant now, Results = {});
    void end_each(std::vector<SharedCommand> const&, CompletedStatus, std::string_view reason, Instant now);
    void finish(SharedCommand const&, Instant now);
    void go_on_in_sequence(std::shared_ptr<Execution> const&, Command const& ended, Instant now);
    template <class What>
    void attempt(SharedCommand const&, What const&);
    void repair(RegisteredComponent&, Instant now);
    void give_up(Command&) noexcept;
    void give_up_waiting(Execution const&) noexcept;
    void end_given_up(SharedCommand const&, Instant now);
    void forget_made(Session&, std::uint64_t after) noexcept;
    void forget_while(Session&, std::function<bool(Command const&)> const& is_old);
    void remember(SharedCommand const&, Instant now);

    EngineSettings const& settings_;
    Registry const& registry_;
    Agenda& agenda_;
    Deadlines& deadlines_;
    Notifier& notifier_;
    Questions& questions_;
    Trace* const& trace_;  // the engine's; may be replaced before the first session
    Recorder& recorder_;
    std::unordered_map<std::uint64_t, SharedCommand> live_;                 // waiting or running, by handle
    std::deque<std::pair<std::shared_ptr<Execution>, std::size_t>> ready_;  // units whose turn has come
    bool running_ready_ = false;
    bool needs_repair_ = false;                     // a command was given up, or a halt has no deadline
    std::set<std::pair<Steady, Session*>> by_age_;  // the sessions with results, ordered by the age of their oldest one
    std::uint64_t last_handle_ = 0;
    std::uint64_t last_id_ = 0;
    std::array<std::uint64_t, 5> completed_by_status_{};
    std::uint64_t stray_answers_ = 0;
};

// Runs `what`. If it throws, gives up the command: the next tick ends it.
template <class What>
void Executor::attempt(SharedCommand const& command, What const& what) {
    try {
        what();
    } catch (...) {
        give_up(*command);
        throw;
    }
}

}  // namespace rois
