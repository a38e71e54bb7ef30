// The robot that the basic components act on. A simulated robot, a robot with ROS or a test implements `Body`; the components of
// components/basic work on each of them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "basic/body/motion.hpp"
#include "basic/body/perception.hpp"
#include "basic/body/pose.hpp"
#include "basic/body/speech_output.hpp"
#include "media/media.hpp"
#include "types/instant.hpp"

namespace rois::basic {

// A component that follows its body. From observe() it reports measurements and the progress of actions.
class Observer {
public:
    virtual ~Observer() = default;

    // The state of the body has advanced. `when` is the real time of that state, not later than the engine's current time.
    virtual void observe(Instant when) = 0;

    // Called at least once in each tick of the engine, after the due calls of observe(): for work that depends on real time.
    virtual void time_passed(Instant) {}
};

// A place that positions can refer to by its name.
struct NamedPlace {
    std::string name;
    Pose pose;
};

struct PoseEstimate {
    Pose pose;
    Covariance covariance = Covariance::Zero();
};

// The body's camera, for streams.
class Camera {
public:
    virtual ~Camera() = default;

    // Keeps the present view for picture(). Called by the engine's thread.
    virtual void capture() = 0;

    // Returns the view of the last capture(), with at most `longest` pixels on its longer side; nothing before the first one.
    // Called by the media thread.
    virtual std::optional<media::Picture> picture(std::uint16_t longest) const = 0;
};

// One robot. Its components share it: each holds a shared_ptr. Except for Camera::picture(), all functions of the body and its
// parts are called one at a time, but not always on the same thread. Lengths are in metres, angles in radians, and
// poses in the frame crs(). A failure of the hardware is an exception: the engine ends the command with ERROR and reports
// COMPONENT_INTERNAL_ERROR.
class Body {
public:
    virtual ~Body() = default;

    virtual std::string const& name() const = 0;  // the robot's name; also the name of its sub engine

    // The components of all bodies with the same provider are called one at a time (ComponentDescription): such bodies may share
    // data, as the robots of a simulated world do. If a function may block, the provider has a thread of its own.
    virtual std::string provider() const { return name(); }
    virtual bool returns_at_once() const { return false; }

    // Whether the body only senses, such as sensors on a ceiling. It has no components that move, speak or react.
    virtual bool is_fixed() const { return false; }

    virtual EntityId self() const = 0;

    // The frame of all poses of the body and its parts.
    virtual std::string const& crs() const = 0;
    virtual bool uses_engines_frame() const = 0;  // whether crs() is the frame of the main engine
    virtual std::vector<NamedPlace> const& places() const = 0;

    virtual std::optional<double> battery() const { return {}; }  // its charge in percent; nothing: always unknown

    virtual Pose pose() const = 0;                   // the best knowledge
    virtual PoseEstimate measured_pose() const = 0;  // with its uncertainty

    // Observers are notified in the order of join(). part() must not be called from within a notification.
    virtual void join(Observer&) = 0;
    virtual void part(Observer&) = 0;

    // The time of the robot's world. It advances between calls of observe().
    virtual WorldTime now() const = 0;

    virtual MobileBase& base() = 0;
    virtual SpeechOutput& speech() = 0;
    virtual Perception const& perception() const = 0;
    virtual std::shared_ptr<Camera> camera() = 0;

    // Shows a reaction of Annex D, given by its code ("9"), for `duration`. It replaces the previous one.
    virtual void show(std::string const& reaction, Seconds duration) = 0;
    virtual void stop_showing() = 0;
};

}  // namespace rois::basic
