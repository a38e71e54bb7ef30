// Runs components in a program of its own, which joins an engine (docs/component-programs.md). lamp.cpp is an example.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/local_component.hpp"

namespace rois::basic {
class Body;
}

namespace rois::sdk {

using Components = std::vector<std::unique_ptr<Component>>;

// Makes the description of a component from its profile document. Call this within `make`. Throws std::runtime_error with the
// place of a mistake.
ComponentDescription describe(std::string ref, std::string const& profile);

// Makes the components, joins the engine, and serves until SIGTERM or SIGINT. Joins again whenever the link is lost. Returns the
// exit code for the program: 0, or 71 if a component has not confirmed that it stands still. `name`: by which the program joins;
// its arguments --name and --url replace it and the URL of the engine.
int serve(int argc, char const* const* argv, std::string name, std::function<Components()> const& make);

// The same for components that are constructed without arguments.
template <class... Each>
int serve(int argc, char const* const* argv, std::string name) {
    return serve(argc, argv, std::move(name), [] {
        Components components;
        (components.push_back(std::make_unique<Each>()), ...);
        return components;
    });
}

// A robot (basic/body/body.hpp). In each tick, at least every 50 ms, `device` lets the time of the body pass: it reads the
// hardware, and notifies the body's observers. Both may be one object.
struct Robot {
    std::shared_ptr<basic::Body> body;
    std::shared_ptr<Device> device;
};

// The same for a robot: the program has the 15 basic components (7.6), which act on its body.
int serve_robot(int argc, char const* const* argv, std::string name, std::function<Robot()> const& make);

// The same for a class that is a basic::Body and a Device, and is constructed without arguments.
template <class Each>
int serve_robot(int argc, char const* const* argv, std::string name) {
    return serve_robot(argc, argv, std::move(name), [] {
        auto const robot = std::make_shared<Each>();
        return Robot{robot, robot};
    });
}

}  // namespace rois::sdk
