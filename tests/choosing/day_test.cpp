// The units of the demo over the day of the simulated hall: what an application learns of the persons, against the ground truth.
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

#include "basic/operated.hpp"
#include "choosing/record.hpp"
#include "choosing/sightings.hpp"
#include "choosing/team.hpp"
#include "simulation/adapters/robots.hpp"
#include "simulation/plan/floor_plan_file.hpp"
#include "simulation/scenario/scenario_file.hpp"

namespace rois::choosing::test {

namespace {

using stage::Rms;

std::string text_of(std::string const& file) {
    std::ifstream in{ROIS_SOURCE_DIR "/" + file};
    return {std::istreambuf_iterator<char>{in}, {}};
}

std::shared_ptr<simulation::Simulation> hall_of_the_demo() {
    auto const schemas = basic::stage::schemas();
    auto plan = simulation::read_floor_plan(schemas, "hall.xml", text_of("docker/hall/hall.xml"));
    auto const day = "components/simulation/data/reception-day.xml";
    auto scenario = simulation::read_scenario(schemas, day, text_of(day), plan);
    return std::make_shared<simulation::Simulation>(std::move(plan), std::move(scenario), 1, 1.0);
}

// A list of persons, as an event reports it. Lengths in metres.
struct Listed {
    Vector position;
    std::optional<Matrix> covariance;
};
using List = std::map<std::string, Listed>;

List list_of(ReceiveEvent const& event) {
    List list;
    for (auto const& located : event.results->located) {
        auto const* covariance = std::get_if<Located::Covariance>(&located.certainty);
        Listed listed{Vector{located.position[0], located.position[1]} / 1'000, {}};
        if (covariance != nullptr && covariance->rows.size() == 9) {
            auto const& c = covariance->rows;
            Matrix matrix;
            matrix << c[0], c[1], c[3], c[4];
            listed.covariance = matrix / 1e6;
        }
        list.emplace(located.ref, listed);
    }
    return list;
}

Vector position_of(simulation::Person const& person) { return {person.pose.position.x(), person.pose.position.y()}; }

// An application of the main engine that localizes persons, while two robots drive to and fro.
class Day {
public:
    explicit Day(std::vector<std::string> const& units)
        : units_{units},
          choosing_{{.logical = {}, .sensing = {"person_localization"}, .engines = units, .areas = {}},
                    [](std::string const&) {}} {
        world_.engine->Engine::add(choosing_.device(), Choosing::provider);
        world_.engine->Engine::add(simulation_, std::string{simulation::Simulation::provider});
        ComponentChange change{{}, {}, {.profiles = basic::stage::own_profiles(), .frames = {}, .places = {}}};
        for (auto& component : basic::robot_components(robots_, basic::stage::own_profiles()))
            if (is_wanted(component->description().ref.code)) change.coming.push_back(std::move(component));
        choosing_.change(std::move(change),
                         [&](ComponentChange all) { return world_.engine->change(std::move(all), world_.now); });
        world_.advance(1s);
        for (auto const& robot : {"robot1.navigation", "robot2.navigation"}) driver_.bind(robot);
        desk_.bind("person_localization");
        desk_.subscribe("person_localized", {}, true);
        desk_.execute(rois::start("person_localization"));
        for (auto const& unit : units)
            desk_.subscribe("person_localized", equal("component_ref", unit + ".person_localization"), true);
    }

    // Calls `look` with each list of persons, at the moment of the report. `ref`: of the component.
    template <class Look>
    void run(std::chrono::seconds duration, Look const& look) {
        for (; passed_ < duration; passed_ += tick) {
            if (passed_ % 40s == 0s) drive("robot1.navigation", {"11000, 6000, 0", "6000, 6000, 0"});
            if (passed_ % 40s == 0s) drive("robot2.navigation", {"14000, 2500, 180", "14000, 5500, 180"});
            if (passed_ % 100ms == 0s) driver_.search();
            world_.advance(tick);
            while (!desk_.received(1).empty()) {
                auto const* event = desk_.last_if<ReceiveEvent>();
                if (event != nullptr && event->results != nullptr) look(event->component_ref.code, list_of(*event));
            }
        }
    }

    static constexpr std::chrono::milliseconds tick{10};  // of the gateway's clock

    double now() const { return std::chrono::duration<double>{passed_}.count(); }
    std::span<simulation::Person const> people() const { return simulation_->hall().people(); }
    // A unit's name for a person: the hall gives the same to all units.
    std::string track(simulation::Person const& person) const { return simulation_->hall().track(person.id).value_or(""); }
    // Whether this robot senses the person now.
    bool sees(std::size_t robot, simulation::Person const& person) const {
        auto const sightings = robots_.bodies[robot]->perception().sightings(basic::Sense::people);
        return std::ranges::find(sightings, track(person), &basic::Sighting::ref) != sightings.end();
    }
    // The name for a person whom one of the units senses.
    std::optional<std::string> name_of(simulation::Person const& person) const {
        auto* fusion = std::dynamic_pointer_cast<Sightings>(choosing_.device())->fusion_of("person");
        for (auto const& unit : units_)
            if (auto name = fusion->own_name(unit, track(person))) return name;
        return {};
    }

private:
    bool is_wanted(std::string const& ref) const {
        auto const dot = ref.find('.');
        bool const is_unit = std::ranges::find(units_, ref.substr(0, dot)) != units_.end();
        return is_unit && (ref.substr(dot) == ".person_localization" || ref.substr(dot) == ".navigation");
    }
    void drive(std::string const& ref, std::vector<std::string> targets) {
        driver_.execute(rois::start(ref, {texts("target_position", std::move(targets))}));
    }

    std::vector<std::string> const units_;
    std::shared_ptr<simulation::Simulation> const simulation_ = hall_of_the_demo();
    basic::Robots const robots_ = simulation::robots(simulation_, nullptr);
    Choosing choosing_;
    World world_{std::vector<Part>{}, EngineSettings{}};
    Application desk_ = world_.connect(), driver_ = world_.connect();
    std::chrono::milliseconds passed_{0};
};

class OverTheDay : public testing::TestWithParam<std::vector<std::string>> {};

}  // namespace

// Errors at the moments of the reports, of persons whom both robots see.
TEST_P(OverTheDay, PersonsAreFusedWellAndKeepTheirNames) {
    Day day{GetParam()};
    Rms fused;
    std::array<Rms, 2> robots;
    int inside = 0, changes = 0, changes_of_view = 0;
    double presence = 0, before = 0;  // seconds; of all persons together
    struct Known {
        std::string name;
        double when = 0;
        std::optional<std::size_t> seen_by{};  // the last robot that saw the person alone
    };
    std::map<simulation::PersonId, Known> known;
    auto const note_fused = [&](simulation::Person const& person, List const& list) {
        auto const name = day.name_of(person);
        if (!name) return;
        auto& [last, when, seen_by] = known[person.id];
        bool const is_remembered = day.now() - std::exchange(when, day.now()) <= 5;  // as long as a name lasts
        if (is_remembered && std::exchange(last, *name) != *name) ++changes;
        last = *name;
        presence += day.now() - before;
        for (std::size_t i = 0; i < 2; ++i)
            if (day.sees(i, person) && !day.sees(1 - i, person) && std::exchange(seen_by, i).value_or(i) != i) ++changes_of_view;
        auto const found = list.find(*name);
        if (found == list.end() || !day.sees(0, person) || !day.sees(1, person)) return;
        Vector const error = found->second.position - position_of(person);
        fused.add(error.norm());
        if (error.dot(found->second.covariance.value().inverse() * error) <= 5.991) ++inside;
    };
    day.run(20min, [&](std::string const& ref, List const& list) {
        for (auto const& person : day.people()) {
            if (ref == "person_localization") note_fused(person, list);
            auto const own = list.find(day.track(person));
            if (own == list.end() || !day.sees(0, person) || !day.sees(1, person)) continue;
            for (std::size_t i = 0; i < 2; ++i)
                if (ref == GetParam()[i] + ".person_localization")
                    robots[i].add((own->second.position - position_of(person)).norm());
        }
        if (ref == "person_localization") before = day.now();
    });
    EXPECT_LE(fused.value(), std::min(robots[0].value(), robots[1].value()));
    EXPECT_GT(fused.count(), 1'000);
    EXPECT_GE(inside, 0.93 * fused.count());
    EXPECT_LT(changes / (presence / 600), 1);
    EXPECT_GT(changes_of_view, 10);
}

INSTANTIATE_TEST_SUITE_P(Of, OverTheDay,
                         testing::Values(std::vector<std::string>{"robot1", "robot2", "room"},
                                         std::vector<std::string>{"robot1", "robot2"}),
                         [](auto const& each) { return each.param.size() == 3 ? "RobotsAndRoom" : "RobotsAlone"; });

}  // namespace rois::choosing::test
