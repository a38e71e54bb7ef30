// The hall as a device of the engine: advances the world as real time passes.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "basic/body/body.hpp"
#include "engine/component.hpp"
#include "simulation/world/hall.hpp"
#include "simulation/world/simulated_time.hpp"

namespace rois::simulation {

// Receives every step of the world (20 ms of world time).
using basic::Observer;

// Shared by its components. The engine calls one of them, or the simulation, at a time: they have the same provider.
class Simulation : public Device {
public:
    static constexpr std::string_view provider = "simulation";

    // `speed`: simulated seconds per real second. With 0, world time passes only by let_pass().
    Simulation(FloorPlan, Scenario, std::uint64_t seed, double speed);

    // Makes the steps that are due. The first call starts the clock and makes the first step. With speed 0, makes at most one of
    // the steps requested by let_pass().
    void advance(Instant now) override;
    bool goes_on() const override { return !time_ && hall_.now() < pass_until_; }

    // Requests more world time, in whole steps, in addition to earlier requests. Returns the world time at its end. Only for
    // speed 0.
    WorldTime let_pass(WorldTime);
    void stand_still();  // cancels all let_pass()

    // Makes one step and notifies the observers with `when`; for tests.
    void step(Instant when);

    Hall& hall() { return hall_; }
    Hall const& hall() const { return hall_; }
    bool runs_by_itself() const { return time_.has_value(); }
    std::vector<Fault> const& faults() const { return faults_; }

    void join(Observer&);  // observers are notified in the order of these calls
    void part(Observer&);  // not from within observe()

private:
    void step_of_world(Instant when);
    void notify_time_passed(Instant now);

    std::vector<Fault> faults_;
    Hall hall_;
    std::optional<SimulatedTime> time_;  // nothing: speed 0
    WorldTime pass_until_{0};
    bool begun_ = false;
    std::vector<Observer*> observers_;
};

}  // namespace rois::simulation
