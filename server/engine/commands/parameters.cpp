#include "engine/commands/parameters.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "types/data_type.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

// Spellings in published profiles, and the names that the engine uses.
struct Spelling {
    std::string_view published;
    std::string_view engine_name;
};
constexpr std::array<Spelling, 4> spellings{{{"target_positions", "target_position"},
                                             {"grammer", "grammar"},
                                             {"languages", "language"},
                                             {"behavior_tag", "behaviour_tag"}}};

std::string names_of(std::vector<ParameterProfile> const& profiles) {
    auto const names = listed(profiles, &ParameterProfile::name);
    return names.empty() ? "none" : names;
}

std::optional<std::string> why_not(ParameterProfile const& profile, DataType const& due, Parameter const& parameter) {
    bool const as_due = parameter.data_type_ref.code == profile.data_type_ref.code;
    if (!as_due && !(DataType::of(parameter.data_type_ref) == due))
        return "parameter " + quoted(parameter.name) + " is declared as " + quoted(parameter.data_type_ref.code) +
               ", its type is " + to_text(due);
    if (auto const problem = why_not(due, parameter.values)) return "parameter " + quoted(parameter.name) + ": " + *problem;
    return {};
}

// The index of the profile for a parameter's name; profiles.size() if there is none. Tries the likely index first.
std::size_t place_of(std::vector<ParameterProfile> const& profiles, std::string_view name, std::size_t likely) {
    if (likely < profiles.size() && profiles[likely].name == name) return likely;
    auto const* found = profile_for(profiles, name);
    return found == nullptr ? profiles.size() : static_cast<std::size_t>(found - profiles.data());
}

// `type_at` returns the type of the profile at an index.
template <class TypeAt>
std::optional<std::string> problem_of(ParameterList const& list, std::vector<ParameterProfile> const& profiles,
                                      TypeAt const& type_at) {
    std::vector<bool> seen(profiles.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        auto const& parameter = list[i];
        auto const place = place_of(profiles, parameter.name, i);
        if (place == profiles.size())
            return "unknown parameter " + quoted(parameter.name) + "; expected one of " + names_of(profiles);
        if (seen[place]) return "parameter " + quoted(parameter.name) + " is given twice";
        seen[place] = true;
        if (auto problem = why_not(profiles[place], type_at(place), parameter)) return problem;
    }
    return {};
}

}  // namespace

ParameterProfile const* profile_for(std::vector<ParameterProfile> const& profiles, std::string_view name) {
    if (auto const* found = find_parameter(profiles, name)) return found;
    return find_parameter(profiles, engine_spelling(name));
}

std::string_view engine_spelling(std::string_view name) {
    for (auto const& spelling : spellings)
        if (equal_ignoring_case(spelling.published, name)) return spelling.engine_name;
    return name;
}

std::optional<std::string> why_not(std::vector<ParameterProfile> const& profiles, ParameterList const& list) {
    return problem_of(list, profiles, [&](std::size_t place) { return DataType::of(profiles[place].data_type_ref); });
}

TypedProfiles::TypedProfiles(std::vector<ParameterProfile> const& profiles) : profiles_{&profiles} {
    types_.reserve(profiles.size());
    for (auto const& profile : profiles) types_.push_back(DataType::of(profile.data_type_ref));
}

std::optional<std::string> TypedProfiles::why_not(ParameterList const& list) const {
    return problem_of(
        list, *profiles_, [&](std::size_t place) -> auto const& { return types_[place]; });
}

ParameterList normalized(std::vector<ParameterProfile> const& profiles, ParameterList const& list) {
    ParameterList known = list;
    for (auto& parameter : known) {
        auto const* profile = profile_for(profiles, parameter.name);
        parameter.name = profile->name;
        parameter.data_type_ref.code = profile->data_type_ref.code;
        auto const type = DataType::of(profile->data_type_ref);
        auto& codebook = parameter.data_type_ref.codebook_ref;
        if (type.base == BaseType::identifier && codebook.empty()) codebook = profile->data_type_ref.codebook_ref;
        if (type.base != BaseType::date_time) continue;
        for (auto& value : parameter.values) value = reported_form(type, value);
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
