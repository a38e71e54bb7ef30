// The names of a sub engine here and there (docs/engines.md): "robot1.navigation" here is "navigation" there.
#pragma once

#include <string>
#include <string_view>

#include "types/messages.hpp"

namespace rois::remote {

class Translation {
public:
    Translation() = default;
    // `name`: the sub engine's name here. `own_name` and `crs`: its name there, and its frame. `keeps_frame`: the frame has the
    // same name here.
    Translation(std::string name, std::string own_name, std::string crs, bool keeps_frame);

    std::string const& name() const { return name_; }
    // The frame of the sub engine, here. "urn:x-rois:def:crs:map::hall" is "urn:x-rois:def:crs:map::robot1.hall".
    std::string const& frame_here() const { return crs_here_; }

    std::string component_here(std::string_view ref) const { return name_ + "." + std::string{ref}; }
    // The name of an engine in the profile of the sub engine.
    std::string engine_here(std::string_view engine) const;

    // Change the frame's name, and the robot names in the result `robot_ref`, which are engine names.
    void to_here(Results&) const;
    void to_here(Located&) const;
    void to_here(std::string& crs) const { change_frame(crs, crs_there_, crs_here_); }
    void to_here(ParameterProfile&) const;
    void to_here(ComponentProfile&) const;
    ParameterList to_there(ParameterList) const;

private:
    void change_frame(std::string& crs, std::string const& from, std::string const& to) const;

    std::string name_;
    std::string own_name_;
    std::string crs_there_;
    std::string crs_here_;
};

}  // namespace rois::remote
