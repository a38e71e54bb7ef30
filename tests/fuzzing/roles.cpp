#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/world.hpp"
#include "fuzzing/targets.hpp"
#include "gateway/access/principal.hpp"

namespace rois::fuzzing {

namespace {

Part robot(std::string const& name) {
    auto part = navigation;
    part.ref = name + ".navigation";
    part.engine = name;
    return part;
}

std::shared_ptr<Rights const> rights(std::string const& holder, std::vector<std::string> sees) {
    return std::make_shared<Rights const>(holder, std::move(sees), std::vector<std::string>{"*"});
}

Operation operation_of(unsigned char what, std::string const& ref) {
    auto const component = Application::identifier(ref);
    auto const condition = equal("component_ref", ref);
    switch (what % 14) {
        case 0:
            return Bind{component};
        case 1:
            return BindAny{condition};
        case 2:
            return Release{component};
        case 3:
            return Execute{{std::vector<CommandUnit>{go("", ref)}}};
        case 4:
            return Execute{{std::vector<CommandUnit>{stop(ref)}}};
        case 5:
            return Subscribe{"reached_target", condition, true};
        case 6:
            return Subscribe{"reached_target", {}, false};
        case 7:
            return Search{};
        case 8:
            return Query{"route", condition};
        case 9:
            return GetProfile{};
        case 10:
            return StopEverything{};
        case 11:
            return Bind{component, Switching::restart, true};
        case 12:
            return GetParameter{component};
        default:
            return SetParameter{component, {}};
    }
}

void expect(bool holds, std::string const& promise) {
    if (!holds) throw std::logic_error{"a promise was broken: " + promise};
}

}  // namespace

// Each byte is a step: its low bits say who does what, its high bits with which robot.
void roles(std::string_view input) {
    World world{robot("one"), robot("two")};
    auto const of_operator = rights("operator", {"one.*"}), of_observer = rights("observer", {"*"});
    auto operator_ = world.connect_as(of_operator), observer = world.connect_as(of_observer), stranger = world.connect();
    for (auto const byte : input.substr(0, 200)) {
        auto const step = static_cast<unsigned char>(byte);
        std::string const ref = step >= 128 ? "two.navigation" : "one.navigation";
        auto const what = operation_of(step & 15U, ref);
        bool const is_observer = (step & 16U) != 0;
        auto const role = is_observer ? Role::observer : Role::operator_;
        if ((step & 96U) == 96U) {
            world[ref].fires("reached_target");
        } else if ((step & 96U) == 64U) {
            world.advance(std::chrono::milliseconds{(step & 15U) * 300});
        } else if (role >= least_role_for(what)) {  // as the gateway decides
            auto const& session = is_observer ? observer.session : operator_.session;
            static_cast<void>(world.begin_to_say(session, what));
        }
        auto const& of_two = world["two.navigation"].calls;
        expect(std::ranges::none_of(of_two, [](auto const& call) { return call.starts_with("start"); }),
               "the operator moves only robot one");
    }
    world.advance(std::chrono::seconds{1});
    for (auto const& line : operator_.received())
        expect(line.find("two.") == line.npos, "the operator hears nothing of robot two: " + line);
    for (auto const& line : observer.received())
        expect(line.find("completed") == line.npos, "the observer has no commands: " + line);
    of_operator->withdraw();
    world.engine->end_withdrawn(world.now);
    world.advance(std::chrono::seconds{1});
    expect(operator_.notifications_closed() && !observer.notifications_closed(), "only the session of the revoked token ends");
    expect(stranger.ask(Search{}).component_ref_list.size() == 2, "other sessions go on");
}

}  // namespace rois::fuzzing
