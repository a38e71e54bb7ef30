// The components as seen by the session that asks.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/conditions/component_candidate.hpp"
#include "engine/frames/places.hpp"

namespace rois {

class Registry;
struct Session;

// How all components look to one session now (`present`), or in any state that they may ever have: status, binding, position and
// parameters (`ever`). Valid only within one call to the engine.
class Perspective {
public:
    enum class Of : std::uint8_t { present, ever };

    Perspective(Registry const&, Places const&, Session const* asker, Of);
    Perspective(Perspective const&) = delete;
    Perspective& operator=(Perspective const&) = delete;

    Candidate const& candidate(RegisteredComponent const&);

    Places const& places() const { return places_; }
    Session const* asker() const { return asker_; }
    Of of() const { return of_; }

    // Returns whether a group condition was matched against a component.
    bool knows_groups() const { return !verdicts_.empty(); }
    // Restricts each group to one robot of the components in `found`. Prefers robots of which no other session holds a component
    // that the asker lacks, then those of which the asker has bound the most of the group, then the first in `found`.
    void keep_one_robot(std::vector<RegisteredComponent*> const& found);
    // Removes from each group the robots of which another session holds a component that the asker lacks. Returns the name of
    // such a component, or nullopt.
    std::optional<std::string_view> drop_held_robots();
    // Whether the asker lacks this free component of a group.
    bool is_lacked(RegisteredComponent const&);

private:
    friend class ComponentCandidate;
    std::vector<Candidate const*> const& robot(std::string_view engine);

    Registry const& registry_;
    Places const& places_;
    Session const* asker_;
    Of of_;
    std::map<RegisteredComponent const*, ComponentCandidate> components_;
    std::map<std::string, std::vector<Candidate const*>, std::less<>> robots_;
    std::map<std::pair<void const*, std::string>, std::optional<GroupVerdict>> verdicts_;  // by group and robot
};

}  // namespace rois
