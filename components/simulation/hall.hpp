// The one world: the hall, its robots and its people, moved on in fixed steps.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "simulation/chronicle.hpp"
#include "simulation/floor_plan.hpp"
#include "simulation/person.hpp"
#include "simulation/robot.hpp"
#include "simulation/scenario.hpp"
#include "simulation/steering.hpp"

namespace rois::simulation {

// The same plan, scenario, seed and calls at the same world times give the same history, bit for bit, however advance() is cut.
// One thread at a time.
class Hall {
public:
    static constexpr WorldTime step_length{20};

    // Throws std::invalid_argument when the plan has a flaw().
    Hall(FloorPlan, Scenario, std::uint64_t seed);
    ~Hall();
    Hall(Hall const&) = delete;
    Hall& operator=(Hall const&) = delete;

    WorldTime now() const;  // the end of the last step
    void step();
    void advance(WorldTime until);  // whole steps that end by then
    std::uint64_t seed() const;

    FloorPlan const& plan() const;

    // Who is there now, in the order of their coming. Valid until the next step.
    std::span<Person const> people() const;
    Person const* person(PersonId) const;  // null when they are not in the hall

    // All robots, in the plan's order.
    std::span<Robot const> robots() const;
    Robot const& robot(RobotId) const;
    std::optional<RobotId> find_robot(std::string_view name) const;
    Drive& drive(RobotId);
    Drive const& drive(RobotId) const;

    Chronicle const& chronicle() const;

    // The temporary name of a person, "person-3": given when a robot's sensors (people, faces, sound) first find them, kept while
    // any does, and for track_memory after the last one did. Looked at every 100 ms. Nothing while they are not tracked.
    static constexpr WorldTime track_memory{5'000};
    std::optional<std::string> track(PersonId) const;

    // Whom a reference names that a service application holds: a robot's name, a temporary name, or the permanent id of a known
    // person whom a robot has identified, for as long as they keep their temporary name.
    std::optional<Entity> find(std::string_view ref) const;

    // The same, but only among the names of this codebook (codebooks.hpp); an empty one means all names.
    std::optional<Entity> find(std::string_view ref, std::string_view codebook) const;
    std::optional<Pose> pose_of(Entity) const;

    // Whether a reference has ever named anybody, or will: a robot's name, a temporary name that was given, or the permanent id
    // of a known person of the scenario or of a known visitor who has been in the hall.
    bool knows(std::string_view ref) const;

    // Reads a target: "x, y, th" or "x, y" in mm and degrees, or the name of a place. Nothing when it is none of them.
    std::optional<Target> target(std::string_view) const;

    // A robot speaks. One utterance at a time: a new one breaks the old one. It ends by itself, in the world's time.
    UtteranceId speak(RobotId, Utterance);
    SpeechState speech_state(RobotId, UtteranceId) const;
    void break_off(RobotId, UtteranceId);
    void hold_speech(RobotId, UtteranceId);  // silence; what is left is said after go_on_speaking
    void go_on_speaking(RobotId, UtteranceId);

    // A robot shows a reaction for some time. A new one takes the place of the old one; it ends by itself.
    void show(RobotId, std::string reaction, Seconds duration);
    void stop_showing(RobotId);

    // Visitors who do what they are told, beside those of the scenario, whose history they change only by being there. They come
    // in when nobody stands in the entrance, and stay until they are told to leave. What cannot be done is a deed that has
    // failed.
    SharedDeed let_in(Role);  // whoever they are; nothing of it but who they are counts
    SharedDeed steer(std::string_view visitor, Order);
    void stop_steering();  // they stand where they are, and nobody who waits is let in

private:
    class World;
    std::unique_ptr<World> world_;
};

}  // namespace rois::simulation
