// The components made from the profiles that a user provides, and their changes when the folder is read again.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "basic/adapters/adapters.hpp"
#include "engine/engine.hpp"
#include "main/profile_folder.hpp"
#include "xml/validation/schemas.hpp"

namespace rois {

class UserComponents {
public:
    // `own`: the built-in profiles. `refs`: the refs of the components that do not come from the user's profiles.
    UserComponents(std::shared_ptr<xml::Schemas const>, basic::Adapters, std::vector<ComponentProfile> own,
                   std::vector<std::string> const& refs, std::string folder);

    // Reads the folder, and returns the changes since the last call. Logs the findings. Refused files make no components at the
    // first call. Later, throws BadSettings if a file is refused that was not refused before, or for another reason; also if the
    // folder cannot be read.
    ComponentChange read();
    // Call when the changes of the last `read` have been made; logs them. Without this call, the next `read` returns them again.
    void keep();

private:
    // The components made from one file.
    struct Made {
        ComponentProfile profile;
        ComponentProfile whole;         // including its sub components, to detect changes
        std::vector<std::string> refs;  // of the components
    };
    using Files = std::map<std::string, Made>;  // by file name

    Files stay(std::vector<ProfileFile> const& found, std::vector<ComponentProfile> const& known) const;
    std::vector<ComponentProfile> with_own(std::vector<ProfileFile> const& found) const;
    std::vector<std::unique_ptr<Component>> components(ProfileFile const&, std::vector<ComponentProfile> const& known,
                                                       std::set<std::string>& taken) const;

    std::shared_ptr<xml::Schemas const> schemas_;
    basic::Adapters adapters_;
    std::vector<ComponentProfile> own_;
    std::set<std::string> refs_;
    std::string folder_;
    Files files_;
    Files next_;                                                       // after the change
    using Refusals = std::map<std::string, std::vector<std::string>>;  // findings, by file name
    std::optional<Refusals> refusals_;                                 // of the last change; nullopt: there was none
    Refusals next_refusals_;
    std::vector<std::string> news_;  // lines about the change, for the log
};

}  // namespace rois
