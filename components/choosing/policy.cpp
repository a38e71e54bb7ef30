#include "choosing/policy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <tuple>

namespace rois::choosing {

namespace {

double distance(Member const& member, Occasion const& occasion) {
    if (!occasion.target) return 0;
    if (!member.location) return std::numeric_limits<double>::max();
    auto const& position = member.location->position;
    auto const& target = *occasion.target;
    double const direct = std::hypot(position[0] - target[0], position[1] - target[1]);
    return member.ref == occasion.current ? std::max(0.0, direct - hysteresis) : direct;
}

}  // namespace

std::vector<Member*> in_order(std::vector<Member*> members, Occasion const& occasion, Roster const& roster) {
    std::erase_if(members, [](Member const* each) { return !each->can_act(); });
    auto loads = roster.loads();
    auto const rank = [&](Member* member) {
        auto const sorted = std::ranges::find(occasion.order, member->ref) - occasion.order.begin();
        // Distance decides on a command with a target. Other commands follow to the engine that the application uses already.
        auto const crew =
            occasion.target ? 0 : roster.count_others_using(occasion.session, member->logical, member->engine, occasion.now);
        return std::tuple{occasion.target && !roster.may_act_at(*member, *occasion.target),
                          member->has_low_battery,
                          member->status != ComponentStatus::ready,
                          sorted,
                          -static_cast<std::ptrdiff_t>(crew),
                          distance(*member, occasion),
                          member->ref != occasion.current,
                          loads[member->engine],
                          member->preference,
                          std::string_view{member->ref},
                          member};
    };
    std::vector<decltype(rank(nullptr))> ranked;
    ranked.reserve(members.size());
    for (auto* member : members) ranked.push_back(rank(member));
    std::ranges::sort(ranked);
    std::ranges::transform(ranked, members.begin(), [](auto const& each) { return std::get<Member*>(each); });
    return members;
}

}  // namespace rois::choosing
