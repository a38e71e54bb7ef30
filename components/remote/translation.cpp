#include "remote/translation.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "types/identifier_length.hpp"
#include "types/text/texts.hpp"

namespace rois::remote {

namespace {

// Frames, or places, of one sub engine.
constexpr std::size_t most_names = 500;

template <class Item>
void limit(std::vector<Item>& items, std::string const& what, std::vector<std::string>& left_out) {
    if (items.size() <= most_names) return;
    left_out.push_back("it has " + std::to_string(items.size()) + " " + what + ": expected at most " +
                       std::to_string(most_names));
    items.resize(most_names);
}

template <class Names>
void change(std::string& crs, std::string const& own, std::string const& own_changed, Names const& others) {
    if (crs.empty()) return;
    if (equal_ignoring_case(crs, own)) {
        crs = own_changed;
        return;
    }
    if (others.empty()) return;
    auto const found = others.find(lower_case(crs));
    if (found != others.end()) crs = found->second;
}

}  // namespace

Translation::Translation(std::string name, std::string own_name, std::string crs, bool keeps_frame, Space const& space,
                         Merged merged)
    : name_{std::move(name)},
      own_name_{std::move(own_name)},
      merged_{std::move(merged)},
      crs_there_{std::move(crs)},
      crs_here_{crs_there_} {
    if (!keeps_frame) crs_here_ = prefixed(crs_there_);
    for (auto const& frame : space.frames) {
        auto here = prefixed(frame.crs);
        frames_there_[lower_case(here)] = frame.crs;
        frames_here_[lower_case(frame.crs)] = std::move(here);
    }
    for (auto const& place : space.places) places_.insert(place.name);
}

std::string Translation::prefixed(std::string const& crs) const {
    auto const last = crs.rfind(':');
    auto here = crs;
    return here.insert(last == std::string::npos ? 0 : last + 1, name_ + ".");
}

std::string Translation::component_here(std::string_view ref) const {
    if (!merged_.there.empty()) return std::string{ref.substr(ref.rfind('.') + 1)};  // npos + 1 is 0
    return name_ + "." + std::string{ref};
}

std::string Translation::engine_here(std::string_view engine) const {
    if (!merged_.there.empty() && engine == merged_.there) return merged_.here;
    return engine == own_name_ ? name_ : name_ + "." + std::string{engine};
}

void Translation::to_here(std::string& crs) const { change(crs, crs_there_, crs_here_, frames_here_); }

void Translation::to_here(Located& located) const { to_here(located.crs); }

void Translation::to_here(ParameterList& list) const {
    for (auto& parameter : list) to_here(parameter.data_type_ref.codebook_ref);
}

void Translation::to_here(Results& results) const {
    std::set<std::string, std::less<>> robots;
    to_here(results.parameters);
    for (auto& parameter : results.parameters) {
        if (parameter.name != "robot_ref") continue;
        robots.insert(parameter.values.begin(), parameter.values.end());
        for (auto& robot : parameter.values) robot = engine_here(robot);
    }
    for (auto& located : results.located) {
        to_here(located);
        if (robots.contains(located.ref)) located.ref = engine_here(located.ref);
    }
}

void Translation::to_here(ParameterProfile& profile) const { to_here(profile.data_type_ref.codebook_ref); }

void Translation::to_here(ComponentProfile& profile) const {
    for (auto& message : profile.messages) {
        for (auto& each : message.results) to_here(each);
        for (auto& each : message.arguments) to_here(each);
    }
    for (auto& each : profile.parameters) to_here(each);
}

Space Translation::to_here(Space space, std::vector<std::string>& left_out) const {
    auto const longest = longest_identifier - name_.size() - 1;
    auto const is_invalid = [&](std::string const& kind, std::string const& name) {
        if (!name.empty() && name.size() <= longest) return false;
        left_out.push_back("the " + kind + " " + quoted(name, 100) + " has a name of " + std::to_string(name.size()) +
                           " characters: expected 1 to " + std::to_string(longest));
        return true;
    };
    std::erase_if(space.frames, [&](Frame const& frame) { return is_invalid("frame", frame.crs); });
    std::erase_if(space.places, [&](NamedPlace const& place) { return is_invalid("place", place.name); });
    limit(space.frames, "frames", left_out);
    limit(space.places, "places", left_out);
    auto const rename = [&](std::string& crs) {
        if (crs.empty()) crs = crs_there_;
        to_here(crs);
    };
    for (auto& frame : space.frames) {
        frame.crs = prefixed(frame.crs);
        rename(frame.base);
    }
    for (auto& place : space.places) {
        place.name.insert(0, name_ + ".");
        rename(place.area.crs);
    }
    return space;
}

// The places of a component's own engine have this prefix in the sub engine. A robot has no places, but its engine does.
std::string Translation::prefix_of_places(std::string_view engine) const {
    if (engine == own_name_) return {};
    while (!engine.empty()) {
        auto prefix = std::string{engine} + ".";
        auto const first = places_.lower_bound(prefix);
        if (first != places_.end() && first->starts_with(prefix)) return prefix;
        auto const dot = engine.rfind('.');
        engine = engine.substr(0, dot == std::string_view::npos ? 0 : dot);
    }
    return {};
}

ParameterList Translation::to_there(ParameterList list, ComponentEntry const& component) const {
    auto const is_position = [&](std::string const& name) {
        return std::ranges::any_of(component.traits->positions,
                                   [&](std::string const& each) { return equal_ignoring_case(each, name); });
    };
    auto const here = name_ + ".";
    for (auto& parameter : list) {
        change(parameter.data_type_ref.codebook_ref, crs_here_, crs_there_, frames_there_);
        if (places_.empty() || !is_position(parameter.name)) continue;
        auto const prefix = prefix_of_places(component.engine);
        for (auto& value : parameter.values) {
            auto const place = trimmed(value);
            if (!place.starts_with(here + prefix) || !places_.contains(place.substr(here.size()))) continue;
            value = std::string{place.substr(here.size())};
        }
    }
    return list;
}

}  // namespace rois::remote
