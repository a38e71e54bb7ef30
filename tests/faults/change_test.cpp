// Components are added and removed without memory: the change happens completely or not at all.

#include <new>

#include "engine/world.hpp"
#include "faults/driving_component.hpp"
#include "faults/faults.hpp"

namespace rois {

namespace {

std::vector<std::string> refs(Engine const& engine) {
    std::vector<std::string> refs;
    for (auto const& entry : engine.components()) refs.push_back(entry.ref);
    return refs;
}

}  // namespace

class ChangeWithoutMemory : public testing::TestWithParam<std::uint64_t> {};

TEST_P(ChangeWithoutMemory, HappensWholeOrNotAtAll) {
    bool failed = true;
    int refused = 0, done = 0;
    for (std::uint64_t n = 1; failed && !HasFailure(); ++n) {
        World world{{navigation, speech}};
        auto& robot = world["navigation"];
        auto desk = world.connect();
        desk.bind("navigation");
        desk.subscribe("reached_target", equal("component_ref", "navigation"));
        desk.execute(go("go"), after(100ms, go("later")));
        ComponentChange change{{"navigation"}, {}, {.profiles = {common}, .frames = {}, .places = {}}};
        auto driving = std::make_unique<DrivingComponent>("base", navigation);
        driving->drives = true;
        auto const& base = *driving;
        change.coming.push_back(std::move(driving));

        bool thrown = false;
        faults::fail_at(faults::Of::memory, n, GetParam());
        try {
            world.engine->change(std::move(change), world.now);
        } catch (std::bad_alloc const&) {
            thrown = true;
        }
        failed = faults::stop();
        ++(thrown ? refused : done);
        auto const left = refs(*world.engine);
        EXPECT_THAT(world.engine->profile()->components, testing::UnorderedElementsAreArray(left)) << n;
        if (thrown) {
            EXPECT_THAT(left, ElementsAre("navigation", "speech")) << n;
            robot.finishes();
            EXPECT_EQ(desk.result_of("go"), "OK") << n;
            continue;
        }
        world.forget("navigation");
        EXPECT_THAT(left, ElementsAre("base", "speech")) << n;
        for (int i = 0; i < 3; ++i) {
            try {
                world.advance(100ms);
            } catch (std::bad_alloc const&) {
                EXPECT_EQ(i, 0) << "reported once";
            }
        }
        EXPECT_FALSE(base.drives) << n;
        EXPECT_THAT(world.engine->not_halted(), IsEmpty()) << n;
        EXPECT_EQ(desk.result_of("go"), "ABORT") << n;
        EXPECT_EQ(desk.result_of("later"), "ABORT") << n;
        EXPECT_EQ(desk.bind("base"), ReturnCode::ok) << n;
    }
    EXPECT_GT(refused, 20);
    EXPECT_GT(done, 2);
}

INSTANTIATE_TEST_SUITE_P(ForCalls, ChangeWithoutMemory, testing::Values(1, 2, 7, 600),
                         [](auto const& calls) { return std::to_string(calls.param); });

}  // namespace rois
