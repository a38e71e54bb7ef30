// The components as one session sees them.
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

// The status, binding, position and parameters of all components, as one session sees them: the current ones (`present`), or all
// that are possible (`ever`). Valid only within one call to the engine.
class Perspective {
public:
    enum class Of : std::uint8_t { present, ever };

    // `named`: the places that the asker may name.
    Perspective(Registry const&, Places const&, Places const& named, Session const* asker, Of);
    Perspective(Perspective const&) = delete;
    Perspective& operator=(Perspective const&) = delete;

    Candidate const& candidate(RegisteredComponent const&);

    Places const& places() const { return places_; }
    Places const& named_places() const { return named_; }
    Session const* asker() const { return asker_; }
    Of of() const { return of_; }

    // Returns whether a group condition was matched against a component.
    bool knows_groups() const { return !verdicts_.empty(); }
    // Restricts each group to the components of one robot, among those in `found`: a robot from which the asker can get all
    // components of the group. Among several, the one of which the asker has bound the most; then the first in `found`.
    void keep_one_robot(std::vector<RegisteredComponent*> const& found);
    // Removes from each group the robots from which the asker cannot get all components, because another session has bound one.
    // Returns the name of such a component, or nullopt.
    std::optional<std::string_view> drop_held_robots();
    // Whether this component is free and the asker must bind it to complete a group.
    bool is_lacked(RegisteredComponent const&);

private:
    friend class ComponentCandidate;
    std::vector<Candidate const*> const& robot(std::string_view engine);

    Registry const& registry_;
    Places const& places_;
    Places const& named_;
    Session const* asker_;
    Of of_;
    std::map<RegisteredComponent const*, ComponentCandidate> components_;
    std::map<std::string, std::vector<Candidate const*>, std::less<>> robots_;
    std::map<std::pair<void const*, std::string>, std::optional<GroupVerdict>> verdicts_;  // by group and robot
};

}  // namespace rois
