// Decision 12: every command of an accepted sequence gets exactly one `completed`, whatever happens.

#include <array>
#include <map>
#include <random>

#include "engine/world.hpp"

namespace rois {

namespace {

// Applications and components that act at random, by a seed.
class Turmoil {
public:
    explicit Turmoil(unsigned seed) : random_{seed} {
        for (int i = 0; i < 3; ++i) join();
    }

    void step() {
        auto& one = applications_[pick(applications_.size())];
        switch (pick(10)) {
            case 0:
            case 1:
            case 2:
                execute(one);
                break;
            case 3:
                one.application.release(ref());
                break;
            case 4:
                if (pick(3) == 0) leave(one);
                break;
            case 5:
                crash();
                break;
            case 6:
            case 7:
                finish();
                break;
            case 8:
                world_[ref()].begins();
                break;
            default:
                world_.advance(std::chrono::milliseconds{50 * (1 + pick(60))});
        }
        for (auto& each : applications_) listen(each);
    }

    // Checks that each command was completed exactly once.
    void calm_down() {
        for (auto& one : applications_) leave(one);
    }

    int accepted = 0;

private:
    struct Attendant {
        Application application;
        std::map<std::string, int> completed;  // by command id: how often
    };

    std::size_t pick(std::size_t of) { return random_() % of; }
    std::string ref() { return std::array{"navigation", "speech", "detection"}[pick(3)]; }

    void join() { applications_.push_back({world_.connect(), {}}); }

    // A command for one of the components that the application has bound.
    CommandUnit any_command() {
        auto const& ref = mine_[pick(mine_.size())];
        switch (pick(6)) {
            case 0:
                return stop(ref);
            case 1:
                return pick(2) == 0 ? suspend(ref) : resume(ref);
            case 2:
                return ref == "navigation" ? command("dock", ref) : stop(ref);
            default:
                return ref == "navigation" ? go("") : ref == "speech" ? say("") : start(ref);
        }
    }

    std::vector<CommandUnit> some_units(int depth) {
        std::vector<CommandUnit> units;
        for (auto n = 1 + pick(3); n > 0; --n) units.push_back(any_unit(depth));
        return units;
    }

    CommandUnit any_unit(int depth) {
        auto unit = any_command();
        switch (pick(depth > 0 ? 10 : 6)) {
            case 6:
                unit = in_sequence(some_units(depth - 1));
                break;
            case 7:
            case 8:
                unit = in_parallel(some_units(depth - 1));
                break;
            case 9:
                unit = branches({{any_command(), any_command()}, {any_command()}});
                break;
            default:
                break;
        }
        if (pick(3) == 0) unit.delay_time = static_cast<std::int64_t>(pick(20) * 50);
        return unit;
    }

    void execute(Attendant& one) {
        mine_.clear();
        for (auto const* ref : {"navigation", "speech", "detection"})
            if (one.application.bind(ref) == ReturnCode::ok) mine_.emplace_back(ref);
        if (mine_.empty()) return;
        auto const reply = one.application.execute(any_unit(3), any_unit(2), any_unit(1));
        if (reply.return_code != ReturnCode::ok) return;
        ++accepted;
        for (auto const& id : ids_of(reply.command_unit_list.command_unit_list)) one.completed.emplace(id, 0);
    }

    void crash() {
        auto& component = world_[ref()];
        component.throws_in.clear();
        if (pick(2) == 0) component.throws_in.insert(std::array{"start", "halt", "perform", "suspend", "reconcile"}[pick(5)]);
        component.on_start = std::array{OnStart::acts, OnStart::becomes_active, OnStart::is_done, OnStart::stays_silent}[pick(4)];
    }

    void finish() {
        auto const status =
            std::array{CompletedStatus::ok, CompletedStatus::ok, CompletedStatus::error, CompletedStatus::timeout};
        world_[ref()].finishes(status[pick(4)]);
    }

    void listen(Attendant& one) {
        for (auto const& words : one.application.received()) {
            auto const begin = words.find(" completed ");
            if (begin == std::string::npos) continue;
            auto const id = words.substr(begin + 11, words.rfind(' ') - begin - 11);
            auto const known = one.completed.find(id);
            ASSERT_NE(known, one.completed.end()) << words;
            ++known->second;
        }
    }

    void leave(Attendant& one) {
        one.application.leave();
        listen(one);
        for (auto const& [id, times] : one.completed) EXPECT_EQ(times, 1) << id;
        one = {world_.connect(), {}};
    }

    std::mt19937 random_;
    std::vector<std::string> mine_;  // bound by the application that acts
    World world_{navigation, speech, detection};
    std::vector<Attendant> applications_;
};

}  // namespace

TEST(Completion, ComesExactlyOnceForEachCommandInAnyTurmoil) {
    int accepted = 0;
    for (unsigned seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Turmoil turmoil{seed};
        for (int i = 0; i < 200; ++i) turmoil.step();
        turmoil.calm_down();
        accepted += turmoil.accepted;
    }
    EXPECT_GT(accepted, 500) << "there must be something to see";
}

}  // namespace rois
