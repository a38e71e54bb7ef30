#include "choosing/choosing.hpp"

#include <utility>

#include "choosing/acting.hpp"
#include "choosing/common_profile.hpp"
#include "choosing/sensing.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois::choosing {

Choosing::Choosing(Settings const& settings, std::function<void(std::string const&)> report)
    : settings_{settings},
      report_{std::move(report)},
      roster_{std::make_shared<Roster>(settings)},
      awaited_{settings.engines.begin(), settings.engines.end()} {}

std::vector<std::string> Choosing::change(ComponentChange change, Perform const& perform) {
    std::lock_guard const lock{mutex_};
    auto members = members_;
    auto shown = shown_;
    auto awaited = awaited_;
    for (auto const& ref : change.going) members.erase(ref);
    for (auto const& component : change.coming) {
        auto const& description = component->description();
        awaited.erase(description.ref.code.substr(0, description.ref.code.rfind('.')));
        if (roster_->find(description.ref.code) != nullptr) members.insert_or_assign(description.ref.code, description);
    }
    for (auto const& name : settings_.logical) change_logical(name, false, members, shown, change);
    for (auto const& name : settings_.sensing) change_logical(name, true, members, shown, change);
    auto left_out = perform(std::move(change));
    members_ = std::move(members);
    shown_ = std::move(shown);
    awaited.swap(awaited_);
    if (awaited_.empty() && !awaited.empty()) look_for_unknown_names();
    return left_out;
}

void Choosing::look_for_unknown_names() {
    for (auto const& [key, names] : {std::pair{"logical", &settings_.logical}, std::pair{"sensing", &settings_.sensing}})
        for (auto const& name : *names)
            if (!shown_.contains(name))
                report_("\"" + std::string{key} + "\" has " + quoted(name) +
                        R"(, but no engine of "engines" has such a component)");
}

// A component that is bound stays while all members have its messages and parameters: its commands would end with it. When a
// member that lacked something has left, the component is replaced with the next change while no application has bound it.
void Choosing::change_logical(std::string const& name, bool senses, Members const& members, Profiles& shown,
                              ComponentChange& change) {
    std::vector<std::string> refs;
    std::vector<ComponentDescription const*> present;
    for (auto const& engine : settings_.engines) {
        auto const& ref = refs.emplace_back(std::string{engine}.append(".").append(name));
        if (auto const member = members.find(ref); member != members.end()) present.push_back(&member->second);
    }
    auto const before = shown.find(name);
    if (present.empty()) {
        if (before == shown.end()) return;
        change.going.push_back(name);
        shown.erase(before);
        return;
    }
    auto [description, left_out] = common(name, present);
    if (before != shown.end()) {
        bool const may_stay =
            roster_->is_bound(name) ? is_within(*before->second, *description.profile) : *before->second == *description.profile;
        if (may_stay) return;
        change.going.push_back(name);
    }
    shown[name] = description.profile;
    for (auto const& what : left_out) report_(std::string{name}.append(" is offered without ").append(what));
    description.provider = provider;
    description.returns_at_once = true;
    description.confirms_binding = true;
    description.members = std::move(refs);
    if (senses) {
        change.coming.push_back(std::make_unique<Sensing>(std::move(description), roster_, sightings_));
        return;
    }
    if (!settings_.sensing.empty())
        for (auto& parameter : description.codebooks)
            parameter.known.insert(parameter.known.begin(), std::string{fused_codebook});
    change.coming.push_back(std::make_unique<Acting>(std::move(description), roster_, sightings_));
}

}  // namespace rois::choosing
