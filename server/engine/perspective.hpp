// The components as a condition's asker sees them.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/component_candidate.hpp"
#include "engine/places.hpp"

namespace rois {

class Registry;
struct Session;

// How all components look to one asker at one moment (`present`), or whatever becomes of their status, binding, place and
// parameters (`ever`). Lives no longer than the engine's one step.
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

    // Whether a condition on a group was held against a component.
    bool knows_groups() const { return !verdicts_.empty(); }
    // From now on each group is met by one robot only. Of the robots of the components in `found`: one of which no other session
    // holds what the asker lacks; of these, the one of which the asker has bound most of the group; then the first in `found`.
    void keep_one_robot(std::vector<RegisteredComponent*> const& found);
    // From now on no group is met by a robot of which another session holds what the asker lacks. Returns the name of such a
    // component, or nothing if there is none.
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
    std::map<std::pair<void const*, std::string>, std::optional<GroupVerdict>> verdicts_;  // of groups on robots
};

}  // namespace rois
