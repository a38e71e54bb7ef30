// Robots behind one engine that shows their components as one.
//     Team team{{"robot1", "robot2"}};
//     auto desk = team.world.connect();
//     desk.bind("navigation");
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "choosing/choosing.hpp"
#include "engine/world.hpp"

namespace rois::choosing::test {

using namespace rois;

class Team {
public:
    // Each robot has a navigation and a speech. `journal`: of the process that has died; its robots come later.
    explicit Team(std::vector<std::string> const& robots, std::map<std::string, Area> areas = {}, EngineSettings engine = {},
                  std::unique_ptr<MemoryJournal> journal = nullptr)
        : choosing{{.logical = {"navigation", "speech"},
                    .sensing = {"localization", "detection"},
                    .engines = robots,
                    .areas = std::move(areas)},
                   [this](std::string const& line) { log.push_back(line); }},
          world{std::vector<Part>{}, engine} {
        world.engine->Engine::add(choosing.device(), Choosing::provider);
        world.between = [this](ComponentChange change, World::Change const& perform) {
            choosing.change(std::move(change), perform);
        };
        if (journal) {
            world.journal = std::move(journal);
            world.engine->keep_in(*world.journal);
            world.engine->restore(world.journal->take_state(), world.rights_of, world.now);
            world.engine->begin(world.now);
            return;
        }
        for (auto const& robot : robots) come(robot);
    }

    static Part driving(std::string const& robot) {
        auto part = in_engine(robot, navigation);
        part.moves = true;
        return part;
    }
    void come(std::string const& robot) {
        world.change({}, {driving(robot), in_engine(robot, speech)});
        world.advance(50ms);
    }
    // The link to the robot is lost for good.
    void go(std::string const& robot) { world.change({robot + ".navigation", robot + ".speech"}, {}); }

    void place(std::string const& robot, double x, double y) {
        for (auto const* part : {".navigation", ".speech"})
            world[robot + part].where =
                Located{.of = {}, .ref = robot, .crs = "crs1", .position = {x, y, 0}, .orientation = {}, .certainty = {}};
        look();
    }
    // The logical components notice the changes of their members.
    void look() {
        world.happen([] {});
        world.advance(200ms);
    }
    ScriptedComponent& drive(std::string const& robot) { return world[robot + ".navigation"]; }
    std::size_t starts_of(std::string const& robot) {
        return static_cast<std::size_t>(std::ranges::count(drive(robot).calls, "start"));
    }

    std::vector<std::string> log;
    Choosing choosing;
    World world;
};

inline CommandUnit drive_to(std::string const& id, std::vector<std::string> targets, std::string const& ref = "navigation") {
    return named(id, start(ref, {texts("target_position", std::move(targets))}));
}

inline ReturnCode bind(Application& application, std::string const& ref, Switching switching) {
    return application.ask(Bind{Application::identifier(ref), switching}).return_code;
}

// Two robots, ten metres apart.
class TwoRobots : public testing::Test {
protected:
    TwoRobots() {
        team.place("robot1", 0, 0);
        team.place("robot2", 10'000, 0);
    }

    Team team{{"robot1", "robot2"}};
    World& world = team.world;
    Application desk = world.connect();
};

}  // namespace rois::choosing::test
