#include "engine/parameters.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "types/data_type.hpp"
#include "types/listing.hpp"
#include "types/texts.hpp"

namespace rois {

namespace {

// How published profiles spell what the seed names otherwise.
struct Spelling {
    std::string_view published;
    std::string_view seed;
};
constexpr std::array<Spelling, 3> spellings{
    {{"target_positions", "target_position"}, {"grammer", "grammar"}, {"languages", "language"}}};

std::string names_of(std::vector<ParameterProfile> const& profiles) {
    auto const names = listed(profiles, &ParameterProfile::name);
    return names.empty() ? "none" : names;
}

std::optional<std::string> why_not(ParameterProfile const& profile, Parameter const& parameter) {
    auto const due = DataType::of(profile.data_type_ref);
    bool const as_due = parameter.data_type_ref.code == profile.data_type_ref.code;
    if (!as_due && !(DataType::of(parameter.data_type_ref) == due))
        return "parameter " + quoted(parameter.name) + " is declared as " + quoted(parameter.data_type_ref.code) +
               ", its type is " + to_text(due);
    if (auto const problem = why_not(due, parameter.values)) return "parameter " + quoted(parameter.name) + ": " + *problem;
    return {};
}

}  // namespace

ParameterProfile const* profile_for(std::vector<ParameterProfile> const& profiles, std::string_view name) {
    if (auto const* found = find_parameter(profiles, name)) return found;
    return find_parameter(profiles, seed_spelling(name));
}

std::string_view seed_spelling(std::string_view name) {
    for (auto const& spelling : spellings)
        if (equal_ignoring_case(spelling.published, name)) return spelling.seed;
    return name;
}

std::optional<std::string> why_not(std::vector<ParameterProfile> const& profiles, ParameterList const& list) {
    std::vector<ParameterProfile const*> seen;
    for (auto const& parameter : list) {
        auto const* profile = profile_for(profiles, parameter.name);
        if (profile == nullptr) return "unknown parameter " + quoted(parameter.name) + "; known are " + names_of(profiles);
        if (std::ranges::find(seen, profile) != seen.end()) return "parameter " + quoted(parameter.name) + " is there twice";
        seen.push_back(profile);
        if (auto problem = why_not(*profile, parameter)) return problem;
    }
    return {};
}

ParameterList normalized(std::vector<ParameterProfile> const& profiles, ParameterList const& list) {
    ParameterList known = list;
    for (auto& parameter : known) {
        auto const* profile = profile_for(profiles, parameter.name);
        parameter.name = profile->name;
        parameter.data_type_ref.code = profile->data_type_ref.code;
    }
    return known;
}

std::optional<std::string> why_incomplete(std::vector<ParameterProfile> const& profiles, ParameterList const& normalized) {
    for (auto const& profile : profiles)
        if (!profile.default_value && find(normalized, profile.name) == nullptr)
            return "the argument " + quoted(profile.name) + " is missing, and has no default value";
    return {};
}

ParameterList with_defaults(std::vector<ParameterProfile> const& profiles, ParameterList const& normalized) {
    ParameterList defaults;
    for (auto const& profile : profiles)
        if (profile.default_value)
            defaults.push_back(
                {profile.name, profile.data_type_ref, default_values(profile.data_type_ref, *profile.default_value)});
    merge(defaults, normalized, profiles);
    return defaults;
}

void merge(ParameterList& stored, ParameterList const& arrived, std::vector<ParameterProfile> const& profiles) {
    for (auto const& parameter : arrived) {
        auto const known = std::ranges::find(stored, parameter.name, &Parameter::name);
        if (known == stored.end()) {
            stored.push_back(parameter);
        } else {
            *known = parameter;
        }
    }
    auto const place = [&](Parameter const& p) {
        return std::ranges::find(profiles, p.name, &ParameterProfile::name) - profiles.begin();
    };
    std::ranges::sort(stored, {}, place);
}

}  // namespace rois
