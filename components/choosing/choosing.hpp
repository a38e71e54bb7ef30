// Shows components of several sub engines as one logical component (docs/choosing.md).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "choosing/roster.hpp"
#include "choosing/settings.hpp"
#include "choosing/sightings.hpp"
#include "engine/component.hpp"
#include "engine/engine.hpp"

namespace rois::choosing {

// Stands between the providers of components and Engine::change. Thread-safe.
class Choosing {
public:
    // `report` receives lines for the log, within calls of `change`.
    Choosing(Settings const&, std::function<void(std::string const& line)> report);

    // Adds logical components to the change, and calls `perform` with it. A logical component comes with its first member, leaves
    // with its last, and is replaced if the common profile of its members changes. Exceptions of `perform` are passed on; then
    // nothing has changed.
    using Perform = std::function<std::vector<std::string>(ComponentChange)>;
    std::vector<std::string> change(ComponentChange, Perform const& perform);

    // Passes the engine's time to the logical components. Add it to the engine, with this provider.
    static constexpr char const* provider = "choosing";
    std::shared_ptr<Device> device() const { return sightings_; }

private:
    using Members = std::map<std::string, ComponentDescription>;                      // by ref; those that are there
    using Profiles = std::map<std::string, std::shared_ptr<ComponentProfile const>>;  // by name of the logical component

    // Reports names of the settings that no engine has, once all engines have come.
    void look_for_unknown_names();
    void change_logical(std::string const& name, bool senses, Members const&, Profiles& shown, ComponentChange&);

    Settings const settings_;
    std::function<void(std::string const&)> const report_;
    std::shared_ptr<Roster> const roster_;
    std::shared_ptr<Sightings> const sightings_ = std::make_shared<Sightings>();
    std::mutex mutex_;
    std::set<std::string> awaited_;  // engines of the settings that have not come yet
    Members members_;
    Profiles shown_;
};

}  // namespace rois::choosing
