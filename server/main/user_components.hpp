// The components that come of the profiles which users bring, and what becomes of them when the folder is read again.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "engine/engine.hpp"
#include "main/profile_folder.hpp"
#include "simulation/adapters.hpp"
#include "xml/schemas.hpp"

namespace rois {

class UserComponents {
public:
    // `own`: the profiles inside the program. `refs`: of the components that are there without any profile of a user.
    UserComponents(std::shared_ptr<xml::Schemas const>, simulation::Adapters, std::vector<ComponentProfile> own,
                   std::vector<std::string> const& refs, std::string folder);

    // What has changed in the folder since the last time; what was found is in the log. A file that is refused now leaves what
    // was made of it before. Throws BadSettings when the folder cannot be read: then nothing has changed.
    ComponentChange read();
    // The change of the last `read` has happened. Without this call, the next `read` returns it again.
    void keep();

private:
    // What a file of the folder is good for.
    struct Made {
        ComponentProfile profile;
        ComponentProfile whole;         // with what its sub components have, to see whether it has changed
        std::vector<std::string> refs;  // of its components
    };
    using Files = std::map<std::string, Made>;  // by name

    Files stay(std::vector<ProfileFile> const& found, std::vector<ComponentProfile> const& known) const;
    std::vector<ComponentProfile> with_own(std::vector<ProfileFile> const& found) const;
    std::vector<std::unique_ptr<Component>> components(ProfileFile const&, std::vector<ComponentProfile> const& known,
                                                       std::set<std::string>& taken) const;

    std::shared_ptr<xml::Schemas const> schemas_;
    simulation::Adapters adapters_;
    std::vector<ComponentProfile> own_;
    std::set<std::string> refs_;
    std::string folder_;
    Files files_;
    Files next_;  // after the change
};

}  // namespace rois
