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

// Chooses a member when a command begins, and binds it. The member stays bound until another one is chosen or the application
// releases the logical component.
class Acting final : public Logical {
public:
    Acting(ComponentDescription, std::shared_ptr<Roster>, std::shared_ptr<Sightings>);

private:
    // A command of the application.
    struct Action {
        std::string type;
        ParameterList parameters;
        CommandHandle handle{};
        std::string member{};              // ref of the member that carries it out; empty: it is being chosen
        std::size_t reached = 0;           // number of targets reached
        std::optional<Steady> switched{};  // time of the last switch
        std::set<std::string> failed{};    // refs of members that have failed
        bool is_leaving = false;           // its member is asked to stop, so that another one goes on
        bool began_low = false;            // its member had a low battery already when it began
        bool is_over = false;              // completed, or halted
    };
    using SharedAction = std::shared_ptr<Action>;

    std::vector<std::string> candidates(ParameterList const& parameters) override;
    std::optional<ParameterList> arguments_for(ParameterList const& parameters, Member const&) const override;
    bool is_used(std::string const& ref) const override;
    bool acts(std::string const& ref) const;  // a command runs on this member
    void begin(std::string const& command_type, ParameterList const& parameters, CommandHandle) override;

    // Finds a member that has not failed at the action. If there is none, or the action has ended meanwhile, passes an empty ref
    // and the reason.
    void choose_for(SharedAction const&, Chosen const&);
    void note_current(std::string const& ref);
    // When another member is chosen, one that has failed is not needed any more: a `stop` does not wait for it, because a lost
    // one cannot confirm anything.
    void let_go_of(std::string const& failed);
    void carry_out(SharedAction const&, std::string const& ref);
    void note_speech(Action const&, std::string const& engine, bool speaks) const;
    void ended(SharedAction const&, Completed const&);
    std::optional<std::string> why_leave(Action const&, Member const&) const;
    void leave_unsuitable();
    void leave(SharedAction const&, Completed const& as);
    bool was_switched_just_now(Action const&) const;
    void go_on_with_another(SharedAction const&, Completed const&);
    void finish(SharedAction const&, Completed const&);

    void forget_commands() override;
    void abort_commands() override;
    void members_released() override { use_none(); }
    void use_none();
    void could_not_bind(std::string const& ref) override { let_go_of(ref); }
    void planned(std::string const& ref) override;
    void happened(ReceiveEvent const&, Member const&, Instant now) override;
    void changed(Member const&) override;
    Member const* shown() override;

    std::shared_ptr<Sightings> const sightings_;
    std::string current_;     // ref of the member that was chosen last
    bool is_active_ = false;  // a function of it goes on, such as a stream: all commands belong to it
    std::vector<SharedAction> actions_;
};

}  // namespace rois::choosing
