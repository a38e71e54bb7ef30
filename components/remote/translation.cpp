#include "remote/translation.hpp"

#include <functional>
#include <set>
#include <utility>

#include "types/text/texts.hpp"

namespace rois::remote {

Translation::Translation(std::string name, std::string own_name, std::string crs, bool keeps_frame)
    : name_{std::move(name)}, own_name_{std::move(own_name)}, crs_there_{std::move(crs)}, crs_here_{crs_there_} {
    if (keeps_frame) return;
    auto const last = crs_here_.rfind(':');
    crs_here_.insert(last == std::string::npos ? 0 : last + 1, name_ + ".");
}

std::string Translation::engine_here(std::string_view engine) const {
    return engine == own_name_ ? name_ : name_ + "." + std::string{engine};
}

void Translation::change_frame(std::string& crs, std::string const& from, std::string const& to) const {
    if (!from.empty() && equal_ignoring_case(crs, from)) crs = to;
}

void Translation::to_here(Located& located) const { change_frame(located.crs, crs_there_, crs_here_); }

void Translation::to_here(Results& results) const {
    std::set<std::string, std::less<>> robots;
    for (auto& parameter : results.parameters) {
        change_frame(parameter.data_type_ref.codebook_ref, crs_there_, crs_here_);
        if (parameter.name != "robot_ref") continue;
        robots.insert(parameter.values.begin(), parameter.values.end());
        for (auto& robot : parameter.values) robot = engine_here(robot);
    }
    for (auto& located : results.located) {
        to_here(located);
        if (robots.contains(located.ref)) located.ref = engine_here(located.ref);
    }
}

void Translation::to_here(ParameterProfile& profile) const {
    change_frame(profile.data_type_ref.codebook_ref, crs_there_, crs_here_);
}

void Translation::to_here(ComponentProfile& profile) const {
    for (auto& message : profile.messages) {
        for (auto& each : message.results) to_here(each);
        for (auto& each : message.arguments) to_here(each);
    }
    for (auto& each : profile.parameters) to_here(each);
}

ParameterList Translation::to_there(ParameterList list) const {
    for (auto& parameter : list) change_frame(parameter.data_type_ref.codebook_ref, crs_here_, crs_there_);
    return list;
}

}  // namespace rois::remote
