// A logical component that acts by one member at a time, and goes on with another one if that fails (docs/choosing.md).
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "choosing/logical.hpp"
#include "choosing/policy.hpp"
#include "choosing/sightings.hpp"

namespace rois::choosing {

// Which member acts is decided when a command begins; only then, and until another one is chosen or the application releases the
// logical component, is the member bound.
class Acting final : public Logical {
public:
    Acting(ComponentDescription, std::shared_ptr<Roster>, std::shared_ptr<Sightings>);

    void prepare(Ticket, std::string_view command_type, ParameterList const& parameters, Instant now) override;
    void suspend(Ticket, Instant now) override;
    void resume(Ticket, Instant now) override;

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
    void choose(SharedAction const&, Chosen const&);
    void try_next(SharedAction const&, std::vector<std::string> candidates, std::optional<Outcome> const& why_not, Chosen const&);
    std::vector<Member*> best_members(ParameterList const& parameters = {});
    // What the member is to do: what is left, with its own names of persons. Nothing: it does not sense the person.
    std::optional<ParameterList> arguments_for(Action const&, Member const&) const;

    bool is_used(std::string const& ref) const;
    void note_current(std::string const& ref);

    void begin(SharedAction const&);
    void carry_out(SharedAction const&, std::string const& ref);
    void note_speech(Action const&, std::string const& engine, bool speaks, Instant now) const;
    void ended(SharedAction const&, Completed const&, Instant now);
    void leave_outside(Instant now);
    void leave(SharedAction const&, Completed const& as, Instant now);
    void go_on_with_another(SharedAction const&, Completed const&, Instant now);
    void finish(SharedAction const&, Completed const&);

    void forget_commands(Instant now) override;
    void abort_commands(Instant now) override;
    void is_free() override { current_.clear(); }
    void happened(ReceiveEvent const&, Member const&, Instant now) override;
    void changed(Member&, Instant now) override { leave_outside(now); }
    Member const* shown() override;

    std::shared_ptr<Sightings> const sightings_;
    std::string current_;  // ref of the member that was chosen last
    std::vector<SharedAction> actions_;
    bool is_suspended_ = false;
};

}  // namespace rois::choosing
