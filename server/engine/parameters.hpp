// Parameters held against their profiles (decision 26).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "types/data_type.hpp"
#include "types/profiles.hpp"
#include "types/values.hpp"

namespace rois {

// The profile that an application's name means: without regard to case, other versions' spellings included. Null when none.
ParameterProfile const* profile_for(std::vector<ParameterProfile> const&, std::string_view name);

// The seed's name for what published profiles spell otherwise; any other name as it is.
std::string_view seed_spelling(std::string_view name);

// Why these parameters are not what the profiles say: unknown, twice, of another type. Nothing when they are.
std::optional<std::string> why_not(std::vector<ParameterProfile> const&, ParameterList const&);

// Profiles whose types are read once, for lists that are held against them again and again.
class TypedProfiles {
public:
    explicit TypedProfiles(std::vector<ParameterProfile> const&);  // which must live as long

    // As above.
    std::optional<std::string> why_not(ParameterList const&) const;

private:
    std::vector<ParameterProfile> const* profiles_;
    std::vector<DataType> types_;
};

// The same parameters under the profiles' names and type codes, times in UTC, identifiers without a codebook with that of the
// profile (decision 31); `list` was checked.
ParameterList normalized(std::vector<ParameterProfile> const&, ParameterList const& list);

// Why a command cannot do with these arguments: one that has no default value is not there. Nothing when it can.
std::optional<std::string> why_incomplete(std::vector<ParameterProfile> const&, ParameterList const& normalized);

// The arguments with the default values of those that are not there, in the order of the profiles.
ParameterList with_defaults(std::vector<ParameterProfile> const&, ParameterList const& normalized);

// Puts what arrived over what is stored, in the order of the profiles.
void merge(ParameterList& stored, ParameterList const& arrived, std::vector<ParameterProfile> const&);

}  // namespace rois
