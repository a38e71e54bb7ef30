// The simulated world: the hall, its robots and its people. It advances in fixed steps.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "simulation/plan/floor_plan.hpp"
#include "simulation/robot/robot.hpp"
#include "simulation/scenario/scenario.hpp"
#include "simulation/scenario/steering.hpp"
#include "simulation/world/chronicle.hpp"
#include "simulation/world/person.hpp"
#include "simulation/world/voice.hpp"

namespace rois::simulation {

// Deterministic: the same plan, scenario, seed and calls at the same world times give the same history, bit for bit,
// however many calls of advance() there are. Not thread-safe.
class Hall {
public:
    static constexpr WorldTime step_length{20};

    // Throws std::invalid_argument if the plan has a flaw().
    Hall(FloorPlan, Scenario, std::uint64_t seed);
    ~Hall();
    Hall(Hall const&) = delete;
    Hall& operator=(Hall const&) = delete;

    WorldTime now() const;  // the world time at the end of the last step
    void step();
    void advance(WorldTime until);  // makes all whole steps that end by then
    std::uint64_t seed() const;

    FloorPlan const& plan() const;

    // The people in the hall, in order of arrival. Valid until the next step.
    std::span<Person const> people() const;
    Person const* person(PersonId) const;  // null if not in the hall

    // All robots, in the plan's order.
    std::span<Robot const> robots() const;
    Robot const& robot(RobotId) const;
    std::optional<RobotId> find_robot(std::string_view name) const;
    Drive& drive(RobotId);
    Drive const& drive(RobotId) const;

    Chronicle const& chronicle() const;

    // Returns the temporary name of a person, "person-3"; nothing if they are not tracked. A person is tracked while a sensor
    // (people, faces, sound) of any robot finds them, and for track_memory afterwards. Updated every 100 ms.
    static constexpr WorldTime track_memory{5'000};
    std::optional<std::string> track(PersonId) const;

    // Resolves a reference of a service application: a robot's name, a temporary name, or the permanent id of a person whom a
    // robot has identified. A permanent id is valid as long as the person's temporary name.
    std::optional<Entity> find(std::string_view ref) const;

    // The same for the names of one codebook (codebooks.hpp); empty: for all names.
    std::optional<Entity> find(std::string_view ref, std::string_view codebook) const;
    std::optional<Pose> pose_of(Entity) const;

    // Whether a reference is valid now, was valid, or may become valid: a robot's name, a temporary name that was assigned, or
    // the permanent id of a known person of the scenario or of a known visitor who has been in the hall.
    bool knows(std::string_view ref) const;

    // Reads a target: "x, y, th" or "x, y" in mm and degrees, or the name of a place. Nothing if it is invalid.
    std::optional<Target> target(std::string_view) const;

    // Starts an utterance and breaks off the robot's previous one. An utterance ends by itself, in world time.
    UtteranceId speak(RobotId, Utterance);
    SpeechState speech_state(RobotId, UtteranceId) const;
    void break_off(RobotId, UtteranceId);
    void hold_speech(RobotId, UtteranceId);  // pauses until go_on_speaking()
    void go_on_speaking(RobotId, UtteranceId);

    // Shows a reaction for `duration`. It replaces the robot's previous one.
    void show(RobotId, std::string reaction, Seconds duration);
    void stop_showing(RobotId);

    // Steered visitors follow orders instead of a scenario. They enter when the entrance is free, and stay until they are ordered
    // to leave. They do not affect the random numbers of the scenario. An impossible order gets the state `failed`.
    SharedOrderStatus let_in(Role);  // ignores the role's answers, actions and time of entry
    SharedOrderStatus steer(std::string_view visitor, Order);
    void stop_steering();  // steered visitors stand still, and waiting ones do not enter

private:
    class World;
    std::unique_ptr<World> world_;
};

}  // namespace rois::simulation
