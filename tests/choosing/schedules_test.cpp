// Random schedules of two applications and three robots that fail, come and go. ROIS_SCHEDULES is the number of schedules, and
// ROIS_FIRST_SCHEDULE the seed of the first one: a failure names its seed.
#include <array>
#include <cstdlib>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <utility>

#include "choosing/team.hpp"

namespace rois::choosing::test {

namespace {

std::uint64_t number_in(char const* variable, std::uint64_t otherwise) {
    auto const* text = std::getenv(variable);
    return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

class Schedule {
public:
    explicit Schedule(std::uint64_t seed) : random_{seed} {
        team_.drive("robot3").throws_in = {"prepare"};  // it refuses everything
        for (auto const& robot : robots_) team_.place(robot, pick(10'000), 0);
    }

    void play() {
        for (int step = 0; step < 40 && !testing::Test::HasFailure(); ++step) {
            do_something();
            look_after();
        }
        end();
    }

private:
    struct Asked {
        SessionId session;
        std::string id;
        std::shared_ptr<TestedOperation> execute;
    };

    int pick(int below) { return std::uniform_int_distribution{0, below - 1}(random_); }
    std::string const& any_robot() { return robots_[static_cast<std::size_t>(pick(3))]; }
    bool is_there(std::string const& robot) const { return !gone_.contains(robot); }

    Application& any_application() {
        auto& place = applications_[static_cast<std::size_t>(pick(2))];
        if (!place) place = team_.world.connect();
        return *place;
    }

    void do_something() {
        switch (pick(10)) {
            case 0:
                return bind();
            case 1:
            case 2:
                return start();
            case 3:
                any_application().execute(stop("navigation"));
                break;
            case 4:
                any_application().release("navigation");
                break;
            case 5:
                return leave();
            case 6:
                return finish();
            case 7:
                return come_or_go();
            case 8:
                return stand_still();
            default:
                team_.world.advance(std::chrono::milliseconds{50 * pick(60)});
        }
    }

    // The answer may come later, when a halt is over.
    void bind() {
        auto const wanted = Bind{Application::identifier("navigation"), static_cast<Switching>(pick(3))};
        binds_.push_back(team_.world.begin_to_say(any_application().session, wanted));
    }

    void start() {
        auto& application = any_application();
        auto const id = "go" + std::to_string(++commands_);
        auto const target = std::to_string(pick(10'000)) + ", 0, 0";
        asked_.push_back({application.session, id,
                          team_.world.begin_to_say(application.session, Execute{{{drive_to(id, {target, "0, 0, 0"})}}})});
    }

    void note_answers() {
        std::erase_if(asked_, [this](Asked const& each) {
            if (!each.execute->said) return false;
            auto const* reply = std::get_if<Reply>(&*each.execute->said);
            if (reply != nullptr && std::get<Execute::Reply>(*reply).return_code == ReturnCode::ok)
                acknowledged_[each.session].insert(each.id);
            return true;
        });
    }

    void leave() {
        auto& place = applications_[static_cast<std::size_t>(pick(2))];
        if (!place) return;
        place->leave();
        expect_ends(*place);
        place.reset();
    }

    void finish() {
        auto const& robot = any_robot();
        if (!is_there(robot) || !acts_.contains(robot)) return;
        acts_.erase(robot);
        team_.drive(robot).finishes(pick(2) == 0 ? CompletedStatus::ok : CompletedStatus::error);
    }

    void come_or_go() {
        auto const& robot = any_robot();
        if (is_there(robot)) {
            team_.go(robot);
            gone_.insert(robot);
            acts_.erase(robot);
            return;
        }
        gone_.erase(robot);
        team_.come(robot);
        team_.place(robot, pick(10'000), 0);
        team_.drive(robot).halts_later = pick(3) == 0;
    }

    void stand_still() {
        auto const& robot = any_robot();
        if (!is_there(robot)) return;
        acts_.erase(robot);
        team_.drive(robot).stands_still();
    }

    // A robot acts from its start until it has finished, or has confirmed that it stands still.
    void look_after() {
        for (auto const& robot : robots_) {
            if (!is_there(robot)) continue;
            auto& component = team_.drive(robot);
            for (auto const& call : std::exchange(component.calls, {})) {
                if (call == "start") acts_.insert(robot);
                if (call == "halt" && !component.halts_later) acts_.erase(robot);
            }
        }
        ASSERT_LE(acts_.size(), 1u) << "two robots act for one logical component";
    }

    void end() {
        for (auto& application : applications_) {
            if (!application) continue;
            application->leave();
            expect_ends(*application);
        }
        look_after();
        for (auto const& robot : robots_) {
            if (!is_there(robot)) continue;
            team_.drive(robot).halts_later = false;
            team_.drive(robot).stands_still();
        }
        team_.world.advance(1s);
        note_answers();
        ASSERT_THAT(asked_, IsEmpty()) << "an execute was not answered";
        for (auto const& bind : binds_) ASSERT_TRUE(bind->said) << "a bind was not answered";
        auto const statistics = team_.world.engine->statistics();
        for (auto const& session : statistics.each_session) ASSERT_THAT(session.bound, IsEmpty()) << "a binding was left";
        ASSERT_THAT(team_.world.engine->not_halted(), IsEmpty());
    }

    // Each acknowledged command has one `completed`.
    void expect_ends(Application& application) {
        note_answers();
        std::map<std::string, int> completed;
        for (auto const& words : application.received()) {
            auto const at = words.find("completed go");
            if (at != words.npos) ++completed[words.substr(at + 10, words.rfind(' ') - at - 10)];
        }
        for (auto const& id : acknowledged_[application.session]) ASSERT_EQ(completed[id], 1) << id;
        acknowledged_.erase(application.session);
    }

    std::mt19937_64 random_;
    std::vector<std::string> const robots_{"robot1", "robot2", "robot3"};
    Team team_{robots_};
    std::array<std::optional<Application>, 2> applications_;
    std::vector<Asked> asked_;  // without an answer
    std::vector<std::shared_ptr<TestedOperation>> binds_;
    std::map<SessionId, std::set<std::string>> acknowledged_;
    std::set<std::string> gone_;
    std::set<std::string> acts_;
    int commands_ = 0;
};

}  // namespace

TEST(Schedules, KeepThePromises) {
    auto const first = number_in("ROIS_FIRST_SCHEDULE", 1);
    auto const last = first + number_in("ROIS_SCHEDULES", 2'000);
    for (auto seed = first; seed < last; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Schedule{seed}.play();
        if (HasFailure()) break;
    }
}

}  // namespace rois::choosing::test
