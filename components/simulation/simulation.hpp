// The hall as a device of the engine: moves the world on as real time passes.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/component.hpp"
#include "simulation/hall.hpp"
#include "simulation/simulated_time.hpp"

namespace rois::simulation {

// Told after every step of the world (20 ms of its time), in the order of joining. The components of the simulation are
// observers: from here they report what their sensors see and how their actions go.
class Observer {
public:
    virtual ~Observer() = default;
    // `when` is the real time to which the step belongs: not later than the engine's present.
    virtual void observe(Instant when) = 0;
    // Once each time that real time has passed, after the steps that were due, if any: for what does not belong to the world.
    virtual void time_passed(Instant now);
};

// Components hold it by shared_ptr. Used by the engine's thread only.
class Simulation : public Device {
public:
    // `speed`: simulated seconds per real second. With 0 the world stands still, but for what let_pass() lets pass.
    Simulation(FloorPlan, Scenario, std::uint64_t seed, double speed);

    // The first call starts the clock and makes the first step. A gap longer than SimulatedTime::longest_gap counts as that much.
    // A world that stands still makes one step of what is to pass.
    void advance(Instant now) override;
    bool goes_on() const override { return !time_ && hall_.now() < pass_until_; }

    // So much time of the world is to pass, after what is to pass already; whole steps. Says when it will have. For a speed of 0.
    WorldTime let_pass(WorldTime);
    void stand_still();  // what has not passed yet does not

    // One step by hand, seen by the observers at `when`; for tests that hold the clock.
    void step(Instant when);

    Hall& hall() { return hall_; }
    Hall const& hall() const { return hall_; }
    bool runs_by_itself() const { return time_.has_value(); }
    std::vector<Fault> const& faults() const { return faults_; }

    void join(Observer&);
    void part(Observer&);  // in the observer's destructor, never from within observe

private:
    void step_of_world(Instant when);
    void tell_the_time(Instant now);

    std::vector<Fault> faults_;
    Hall hall_;
    std::optional<SimulatedTime> time_;  // none: the world stands still
    WorldTime pass_until_{0};
    bool begun_ = false;
    std::vector<Observer*> observers_;
};

}  // namespace rois::simulation
