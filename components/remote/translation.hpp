// The names of a sub engine here and there (docs/engines.md): "robot1.navigation" here is "navigation" there.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "types/messages.hpp"

namespace rois::remote {

class Translation {
public:
    // An engine of the sub engine whose components belong to this engine itself (SubEngine::engine): its name there, and the name
    // of this engine. "robot1.navigation" there is "navigation" here. Empty: there is none.
    struct Merged {
        std::string there;
        std::string here;
    };

    Translation() = default;
    // `name`: the sub engine's name here. `own_name`, `crs` and `space`: its name there, its frame, and its other frames and
    // places. `keeps_frame`: its own frame has the same name here.
    Translation(std::string name, std::string own_name, std::string crs, bool keeps_frame, Space const& space, Merged = {});

    std::string const& name() const { return name_; }
    // The frame of the sub engine, here. "urn:x-rois:def:crs:map::hall" is "urn:x-rois:def:crs:map::robot1.hall".
    std::string const& frame_here() const { return crs_here_; }

    std::string component_here(std::string_view ref) const;
    // The name of an engine in the profile of the sub engine.
    std::string engine_here(std::string_view engine) const;

    // Change the frame's name, and the robot names in the result `robot_ref`, which are engine names.
    void to_here(Results&) const;
    void to_here(Located&) const;
    void to_here(ParameterList&) const;  // only frames
    // The name of a frame of the sub engine. Other names, such as those of codebooks, are not changed.
    void to_here(std::string& crs) const;
    void to_here(ParameterProfile&) const;
    void to_here(ComponentProfile&) const;
    // Frames and places have the prefix here. Appends why some are left out: an invalid name, or too many of them.
    Space to_here(Space, std::vector<std::string>& left_out) const;

    // Parameters for this component. Changes the names of frames and, in positions, those of places: "robot1.desk" here is "desk"
    // there. Only the places of the component's own engine: there, a name without prefix is one of them.
    ParameterList to_there(ParameterList, ComponentEntry const&) const;

private:
    using Names = std::map<std::string, std::string, std::less<>>;  // by names in lower case

    std::string prefixed(std::string const& crs) const;
    std::string prefix_of_places(std::string_view engine) const;

    std::string name_;
    std::string own_name_;
    Merged merged_;
    std::string crs_there_;
    std::string crs_here_;
    Names frames_here_;                          // of the other frames, by their names there
    Names frames_there_;                         // the reverse
    std::set<std::string, std::less<>> places_;  // names there
};

}  // namespace rois::remote
