#include "main/user_components.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "main/settings.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

bool is_refused(ProfileFile const& file) { return file.verdict == ProfileFile::Verdict::refused; }

void log(ProfileFile const& file) {
    for (auto const& finding : file.findings) spdlog::warn("profiles: {}{}", is_refused(file) ? "refused: " : "", finding);
}

}  // namespace

UserComponents::UserComponents(std::shared_ptr<xml::Schemas const> schemas, basic::Adapters adapters,
                               std::vector<ComponentProfile> own, std::vector<std::string> const& refs, std::string folder)
    : schemas_{std::move(schemas)},
      adapters_{std::move(adapters)},
      own_{std::move(own)},
      refs_{refs.begin(), refs.end()},
      folder_{std::move(folder)} {}

// Puts the built-in profiles first, so that lookups find them first.
std::vector<ComponentProfile> UserComponents::with_own(std::vector<ProfileFile> const& found) const {
    auto all = own_;
    for (auto const& file : found) {
        if (file.profile) all.push_back(*file.profile);
    }
    return all;
}

// Returns the files that are unchanged. Retries a file without components: the ref that it needs may be free now.
UserComponents::Files UserComponents::stay(std::vector<ProfileFile> const& found,
                                           std::vector<ComponentProfile> const& known) const {
    Files staying;
    for (auto const& file : found) {
        auto const before = files_.find(file.name);
        if (before == files_.end()) continue;
        bool const same = file.profile && !before->second.refs.empty() && *file.profile == before->second.profile &&
                          flattened(*file.profile, known) == before->second.whole;
        if (same) staying.insert(*before);
    }
    return staying;
}

// Returns no components if the profile names no adapter, is one of the built-in ones, or needs a ref that is taken.
std::vector<std::unique_ptr<Component>> UserComponents::components(ProfileFile const& file,
                                                                   std::vector<ComponentProfile> const& known,
                                                                   std::set<std::string>& taken) const {
    auto const& profile = *file.profile;
    auto const same = [&](ComponentProfile const& p) {
        return equal_ignoring_case(p.object.identifier, profile.object.identifier);
    };
    if (std::ranges::any_of(own_, same)) return {};
    try {
        auto made = adapters_.components(profile, known);
        if (made.empty())
            spdlog::info("profiles: {}: {} has no adapter, so no component is made", file.name, profile.object.identifier);
        for (auto const& component : made) {
            auto const& ref = component->description().ref.code;
            if (taken.insert(ref).second) continue;
            spdlog::warn("profiles: {}: ref {} is used by another component; no component was made: choose another ref",
                         file.name, ref);
            return {};
        }
        return made;
    } catch (std::exception const& error) {
        spdlog::warn("profiles: {}: {}", file.name, error.what());
        return {};
    }
}

ComponentChange UserComponents::read() {
    auto const found = read_profile_folder(schemas_, folder_, own_, adapters_.streams());
    next_refusals_.clear();
    news_.clear();
    for (auto const& file : found) {
        if (!is_refused(file)) continue;
        next_refusals_.emplace(file.name, file.findings);
        auto const before = refusals_ ? refusals_->find(file.name) : Refusals::const_iterator{};
        bool const is_known = refusals_ && before != refusals_->end() && before->second == file.findings;
        if (refusals_ && !is_known) throw BadSettings{file.findings.empty() ? file.name + " is refused" : file.findings.front()};
    }
    ComponentChange change;
    change.belongings.profiles = with_own(found);
    auto next = stay(found, change.belongings.profiles);
    auto taken = refs_;
    for (auto const& [name, made] : next) taken.insert(made.refs.begin(), made.refs.end());
    for (auto const& [name, made] : files_)
        if (!next.contains(name)) change.going.insert(change.going.end(), made.refs.begin(), made.refs.end());
    for (auto const& file : found) {
        log(file);
        if (!file.profile || next.contains(file.name)) continue;
        Made made{*file.profile, flattened(*file.profile, change.belongings.profiles), {}};
        for (auto& component : components(file, change.belongings.profiles, taken)) {
            made.refs.push_back(component->description().ref.code);
            news_.push_back(file.name + ": adds the component " + made.refs.back());
            change.coming.push_back(std::move(component));
        }
        next.emplace(file.name, std::move(made));
    }
    for (auto const& ref : change.going) news_.push_back("removes the component " + ref);
    next_ = std::move(next);
    return change;
}

void UserComponents::keep() {
    files_ = std::move(next_);
    refusals_ = std::move(next_refusals_);
    for (auto const& line : news_) spdlog::info("profiles: {}", line);
}

}  // namespace rois
