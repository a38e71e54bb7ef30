// The base of the logical components, which use their members in their own session of the engine (docs/choosing.md).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "choosing/roster.hpp"
#include "engine/component.hpp"
#include "types/text/texts.hpp"

namespace rois::choosing {

Identifier identifier(std::string const& ref);
// Returns the return code and the reason of an answer; ERROR for null: the operation was not performed.
Outcome outcome_of(Reply const*);
Execute execution(std::string const& ref, std::string const& type, ParameterList const& arguments, bool check_only = false);

class Logical : public Component {
public:
    Logical(ComponentDescription, std::shared_ptr<Roster>);

    ComponentDescription const& description() const final { return description_; }
    void attach(ComponentPort&) override;
    void session_began(Instant now) final;
    void member_freed(std::string const& ref) final;
    void members_ordered(std::vector<std::string> const& refs) final { binding_.order = refs; }
    void notified(Notification const&, Instant now) final;

    void bind(Ticket, Binding const&, Instant now) final;
    void released(Instant now) final;
    void prepare(Ticket, std::string_view command_type, ParameterList const& parameters, Instant now) final;
    void halt(Ticket, Instant now) final;
    void suspend(Ticket, Instant now) final;
    void resume(Ticket, Instant now) final;
    void query(Ticket, std::string_view query_type, Instant now) final;

protected:
    // --- For the kinds of logical components ---

    // Returns why the component never performs this command, or nullopt.
    virtual std::optional<std::string> why_never(std::string_view /*command_type*/) const { return {}; }
    // The refs of the members that can perform a command now, the best one first.
    virtual std::vector<std::string> candidates(ParameterList const& parameters) = 0;
    // The arguments of the member's own command; nullopt if it cannot perform it now.
    virtual std::optional<ParameterList> arguments_for(ParameterList const& parameters, Member const&) const {
        return parameters;
    }
    // Returns whether a command uses the member, which then stays bound.
    virtual bool is_used(std::string const& ref) const = 0;
    virtual void begin(std::string const& command_type, ParameterList const& parameters, CommandHandle) = 0;
    // Ends all commands without a report: the engine has ended them.
    virtual void forget_commands() = 0;
    // Completes all commands with ABORT.
    virtual void abort_commands() = 0;
    // The engine of this member does not let it be bound, or is lost.
    virtual void could_not_bind(std::string const& /*ref*/) {}
    // Called when this member will probably carry out a command, which has not begun yet.
    virtual void planned(std::string const& /*ref*/) {}
    // Called when the application has released the component: no member is used any more.
    virtual void members_released() {}
    // An event of a member.
    virtual void happened(ReceiveEvent const&, Member const&, Instant now) = 0;
    // The state of a member has changed.
    virtual void changed(Member const&) = 0;
    // The member whose position, parameters and errors are shown, and that answers queries; null: none.
    virtual Member const* shown() = 0;
    // Returns whether the status is WARNING instead of READY.
    virtual bool has_warning() const { return false; }

    std::string const& name() const { return description_.ref.code; }
    std::string none_is_free() const { return "no member of " + quoted(name()) + " is free and READY"; }
    std::vector<Member*> const& members() const { return members_; }  // the preferred ones first
    Roster& roster() const { return *roster_; }
    ComponentPort& port() const { return *port_; }
    bool is_attached() const { return port_ != nullptr; }
    Binding const& binding() const { return binding_; }
    bool is_suspended() const { return is_suspended_; }
    void end_suspension() { is_suspended_ = false; }
    void show();

    // Performs an operation in the component's own session. `then` is called later, never within this call.
    using Answered = std::function<void(Outcome const&)>;
    void ask(Operation, Answered then);
    void bind_member(std::string const& ref, Answered then);
    void release_unused(std::string const& ref);
    // Also if it has not confirmed a halt.
    void give_back(std::string const& ref);

    // A member that is bound and accepts the command; or an empty ref, and the reason.
    struct Choice {
        std::string ref;
        Outcome why;
    };
    using Chosen = std::function<void(Choice const&)>;
    // Finds the first of these members that accepts the command.
    void choose(std::vector<std::string> refs, std::string const& type, ParameterList const& parameters, Chosen const&,
                std::optional<Outcome> const& why_not = {});

    // These two enclose the start of each command. `suspend` and `resume` wait while a command is between them.
    void start_began() { ++beginning_; }
    void start_ended();

    // Performs a command. `ended` follows `begun` with OK, once.
    using Ended = std::function<void(Completed const&)>;
    void command(std::string const& ref, std::string const& type, ParameterList const& arguments, Answered begun, Ended ended);
    // Calls `then(true)` if the member confirms that it stands still, otherwise `then(false)`.
    void stop(std::string const& ref, std::function<void(bool stands)> const& then);

private:
    void release_member(std::string const& ref);
    void forget(Member&);
    void pause(Ticket, std::string const& command_type);
    void notified_of(Completed const&);
    void notified_of(ComponentChanged const&);
    void learn_space();
    void subscribe_to(std::string const& ref);

    ComponentDescription const description_;
    std::shared_ptr<Roster> const roster_;
    std::vector<Member*> const members_;
    ComponentPort* port_ = nullptr;
    Binding binding_{};
    bool is_suspended_ = false;
    int beginning_ = 0;                           // commands that a member has not accepted or refused yet
    std::vector<std::function<void()>> waiting_;  // until all have begun
    std::set<std::string> halting_;               // refs of the members that have not confirmed a halt
    std::multiset<std::string> on_trial_;         // refs of the members that are asked whether they accept a command
    std::map<std::string, Ended> running_;        // commands of the own session, by id
    std::set<std::string> subscribed_;            // refs of the members whose events are subscribed to
    std::string shown_member_;                    // ref; empty: none
    std::optional<ComponentState> shown_;
};

}  // namespace rois::choosing
