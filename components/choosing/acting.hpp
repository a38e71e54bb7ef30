// A logical component that acts by one member at a time, and goes on with another one if that fails (docs/choosing.md).
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "choosing/policy.hpp"
#include "choosing/roster.hpp"
#include "engine/component.hpp"

namespace rois::choosing {

// Commands its members in its own session of the engine. Which member acts is decided when a command begins; only then, and until
// another one is chosen or the application releases the logical component, is the member bound.
class Acting final : public Component {
public:
    Acting(ComponentDescription, std::shared_ptr<Roster>);

    ComponentDescription const& description() const override { return description_; }
    void attach(ComponentPort&) override;
    void session_began(Instant now) override;
    void notified(Notification const&, Instant now) override;

    void bind(Ticket, Binding const&, Instant now) override;
    void released(Instant now) override;
    void prepare(Ticket, std::string_view command_type, ParameterList const& parameters, Instant now) override;
    void halt(Ticket, Instant now) override;
    void suspend(Ticket, Instant now) override;
    void resume(Ticket, Instant now) override;
    void query(Ticket, std::string_view query_type, Instant now) override;

private:
    // A command of the application.
    struct Action {
        std::string type;
        ParameterList parameters;
        CommandHandle handle{};
        std::string member{};              // ref of the member that carries it out; empty: it is being chosen
        std::size_t reached = 0;           // targets
        std::optional<Steady> switched{};  // for the last time
        std::set<std::string> failed{};    // refs of members that have failed
        bool is_leaving = false;           // its member is told to stop, so that another one goes on
        bool is_over = false;              // completed, or halted
    };
    using SharedAction = std::shared_ptr<Action>;

    // `ref`: the member that is bound and accepts the command. Empty: there is none; `why` says why.
    struct Choice {
        std::string ref;
        Outcome why;
    };
    using Chosen = std::function<void(Choice const&)>;
    void choose(SharedAction const&, Chosen);
    void try_next(SharedAction const&, std::vector<std::string> candidates, std::optional<Outcome> why_not, Chosen);
    std::vector<Member*> best_members(ParameterList const& parameters = {});

    using Answered = std::function<void(Outcome const&)>;
    void ask(Operation, Answered);
    void use(std::string const& ref, Answered);
    void give_back(std::string const& ref);
    void forget(Member&);
    bool is_used(std::string const& ref) const;
    void note_current(std::string const& ref);

    using Ended = std::function<void(Completed const&, Instant now)>;
    void command(std::string const& ref, std::string const& type, ParameterList const& arguments, Answered begun, Ended ended);
    // `then` is called with whether the member has confirmed that it stands still.
    void stop(std::string const& ref, std::function<void(bool stands)> then);

    void begin(SharedAction const&);
    void carry_out(SharedAction const&, std::string const& ref);
    void ended(SharedAction const&, Completed const&, Instant now);
    void leave_outside(Instant now);
    void leave(SharedAction const&, Completed const& as, Instant now);
    void go_on_with_another(SharedAction const&, Completed const&, Instant now);
    void finish(SharedAction const&, Completed const&);
    void pause(Ticket, std::string const& command_type);

    void notified_of(ReceiveEvent const&);
    void notified_of(Completed const&, Instant now);
    void notified_of(ComponentChanged const&, Instant now);
    void learn_space();
    void subscribe_to(std::string const& ref);
    void show();

    ComponentDescription const description_;
    std::string const& name_;  // in description_
    std::shared_ptr<Roster> const roster_;
    ComponentPort* port_ = nullptr;
    Binding binding_{};
    std::string current_;  // ref of the member that was chosen last
    std::vector<SharedAction> actions_;
    bool is_suspended_ = false;
    std::set<std::string> halting_;         // refs of the members that have not confirmed a halt
    std::map<std::string, Ended> running_;  // commands of the own session, by id
    std::set<std::string> subscribed_;      // refs of the members whose events are subscribed to
    std::optional<ComponentState> shown_;
};

}  // namespace rois::choosing
