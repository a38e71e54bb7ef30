// A robot of the hall as the body of basic components.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "basic/body/body.hpp"
#include "simulation/world/simulation.hpp"

namespace rois::simulation {

// Converts between the hall's frame and the robot's own frame, if it has one. Keeps no state of the world.
class RobotBody final : public basic::Body, private basic::MobileBase, private basic::SpeechOutput, private basic::Perception {
public:
    RobotBody(std::shared_ptr<Simulation>, RobotId);

    std::string const& name() const override { return state().name; }
    std::string provider() const override { return std::string{Simulation::provider}; }
    bool returns_at_once() const override { return true; }
    bool is_fixed() const override { return plan_.fixed; }
    basic::EntityId self() const override { return entity_id(robot_); }
    std::string const& crs() const override { return plan_.frame ? plan_.frame->crs : hall().plan().crs; }
    bool uses_engines_frame() const override { return !plan_.frame; }
    std::vector<basic::NamedPlace> const& places() const override { return places_; }
    std::optional<double> battery() const override { return state().battery; }
    Pose pose() const override { return reported(state().pose); }
    basic::PoseEstimate measured_pose() const override;
    void join(Observer& observer) override { simulation_->join(observer); }
    void part(Observer& observer) override { simulation_->part(observer); }
    WorldTime now() const override { return hall().now(); }

    basic::MobileBase& base() override { return *this; }
    basic::SpeechOutput& speech() override { return *this; }
    basic::Perception const& perception() const override { return *this; }
    std::shared_ptr<basic::Camera> camera() override { return camera_; }

    void show(std::string const& reaction, Seconds duration) override { hall().show(robot_, reaction, duration); }
    void stop_showing() override { hall().stop_showing(robot_); }

private:
    std::variant<basic::MotionId, basic::Rejection> begin(std::string_view owner, basic::Motion) override;
    basic::Progress progress(basic::MotionId id) const override { return drive().progress(id); }
    void stop(basic::MotionId id) override { drive().stop(id); }
    void hold(basic::MotionId id) override { drive().hold(id); }
    void go_on(basic::MotionId id) override { drive().go_on(id); }
    void brake(bool on) override { drive().brake(on); }
    void limit_speed(std::optional<MetresPerSecond> speed) override { drive().limit_speed(speed); }
    basic::BaseStatus status() const override;

    basic::UtteranceId speak(basic::Utterance utterance) override { return hall().speak(robot_, std::move(utterance)); }
    basic::SpeechState state(basic::UtteranceId id) const override { return hall().speech_state(robot_, id); }
    void break_off(basic::UtteranceId id) override { hall().break_off(robot_, id); }
    void hold(basic::UtteranceId id) override { hall().hold_speech(robot_, id); }
    void go_on(basic::UtteranceId id) override { hall().go_on_speaking(robot_, id); }
    std::optional<std::string> speaking() const override;

    std::vector<basic::Sighting> sightings(basic::Sense) const override;
    Metres sigma(basic::Sense) const override;
    std::vector<basic::RecognizedPerson> recognized() const override;
    std::optional<basic::EntityId> find(std::string_view ref, std::string_view codebook) const override;
    bool knows(std::string_view ref) const override { return hall().knows(ref); }
    std::uint64_t last_sequence() const override { return hall().chronicle().last(); }
    std::vector<basic::SpeechEvent> speech_since(std::uint64_t sequence) const override;
    std::vector<std::string> gestures_since(std::uint64_t sequence) const override;

    Hall& hall() { return simulation_->hall(); }
    Hall const& hall() const { return simulation_->hall(); }
    Drive& drive() { return hall().drive(robot_); }
    Drive const& drive() const { return hall().drive(robot_); }
    Robot const& state() const { return hall().robot(robot_); }

    // Convert from the hall's frame to the frame crs(), and back.
    Pose reported(Pose const&) const;
    Covariance reported(Covariance const&) const;
    basic::Sighting reported(basic::Sighting) const;
    Target in_hall(Target) const;

    std::shared_ptr<Simulation> simulation_;
    RobotId robot_;
    RobotPlan const& plan_;  // of the simulation's floor plan
    std::vector<basic::NamedPlace> places_;
    std::shared_ptr<basic::Camera> camera_;
};

}  // namespace rois::simulation
