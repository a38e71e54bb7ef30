// The members of the logical components, their states, and their users.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "choosing/settings.hpp"
#include "engine/frames/frames.hpp"
#include "types/codes.hpp"
#include "types/values.hpp"

namespace rois::choosing {

// A component that a logical component stands for.
struct Member {
    std::string ref;
    std::string engine;
    std::string logical;         // name of the logical component
    std::size_t preference = 0;  // 0: of the preferred engine
    // As the session of the logical component sees it. BUSY: an application has bound it. UNINITIALIZED: it is not there.
    ComponentStatus status = ComponentStatus::uninitialized;
    std::optional<Located> location{};  // in the main engine's frame
    ParameterList parameters{};         // the read-only ones
    bool is_bound = false;              // by the logical component
    bool is_outside = false;            // of its area
    bool has_low_battery = false;       // according to its parameter `battery`

    bool is_there() const { return status != ComponentStatus::uninitialized; }
    bool can_act() const { return (status == ComponentStatus::ready || status == ComponentStatus::warning) && !is_outside; }
};

// Shared by all logical components, which the engine calls one at a time.
class Roster {
public:
    explicit Roster(Settings const&);

    // Returns null for a component that is not a member.
    Member* find(std::string_view ref);
    // The preferred ones first. The pointers stay valid.
    std::vector<Member*> members_of(std::string_view logical);
    // Sets the status, location and parameters of a member.
    void note(Member&, ComponentStatus, Results const&) const;

    // The number of members in use, by engine. Engines without one are missing.
    std::map<std::string_view, std::size_t> loads() const;
    // Returns whether the position is inside of the area of the member's engine.
    bool may_act_at(Member const&, std::array<double, 2> const& position) const;

    // Whether an application has bound the logical component. Thread-safe.
    bool is_bound(std::string const& logical) const { return bound_.at(logical); }
    void note_bound(std::string const& logical, bool yes) { bound_.at(logical) = yes; }

    // Notes the engine whose member a logical component uses for the session of an application, until it is forgotten.
    void note_engine_in_use(std::string const& logical, std::uint64_t session, std::string const& engine);
    void forget_engine_in_use(std::string const& logical);
    // Notes that the component will probably use this engine. A plan counts for a second.
    void note_plan(std::string const& logical, std::uint64_t session, std::string const& engine, Steady now);
    // Returns how many other logical components use this engine for the session, or will.
    std::size_t count_others_using(std::uint64_t session, std::string_view logical, std::string_view engine, Steady now) const;

    // A member of this engine begins or ends a speech. Members of other engines hear it until 1.5 s after the end.
    void note_speech(std::string const& engine, bool speaks, Steady now);
    bool is_heard_by_others(std::string_view listener, Steady now) const;

    // Sets the frames and named places of the main engine.
    void set_space(Space const&, std::string const& own_frame);
    std::string const& frame() const { return frames_.own(); }
    // Returns where a target is, in the main engine's frame: a position or a named place. Nothing if that is unknown.
    std::optional<std::array<double, 2>> position_of(std::string const& target) const;

private:
    struct InUse {
        std::uint64_t session = 0;
        std::string engine;
    };
    struct Plan {
        InUse use;
        Steady made;
    };
    static constexpr std::chrono::seconds longest_plan{1};

    std::map<std::string, Area> areas_;
    int const low_battery_;                                  // in percent
    std::map<std::string, Member, std::less<>> members_;     // by ref
    std::map<std::string, std::atomic<bool>> bound_;         // by logical component; all of them, from the beginning
    std::map<std::string, InUse> in_use_;                    // by logical component
    std::map<std::string, Plan> plans_;                      // likewise
    std::map<std::string, std::optional<Steady>> speakers_;  // by engine: the end of their last speech
    Frames frames_;
    std::vector<NamedPlace> places_;
};

}  // namespace rois::choosing
