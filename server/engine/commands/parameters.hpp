// Checks and normalizes parameters by their profiles (decision 26).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "types/data_type.hpp"
#include "types/profiles.hpp"
#include "types/values.hpp"

namespace rois {

// Finds the profile of a name: without regard to case, and with the spellings of other versions. Returns null if there is none.
ParameterProfile const* profile_for(std::vector<ParameterProfile> const&, std::string_view name);

// Converts a spelling used in published profiles ("grammer") to the name that the engine uses ("grammar"). Returns other names
// unchanged.
std::string_view engine_spelling(std::string_view name);

// Returns why the parameters do not fit the profiles (unknown, duplicated, wrong type), or nullopt.
std::optional<std::string> why_not(std::vector<ParameterProfile> const&, ParameterList const&);

// Profiles with their types parsed once, for repeated checks.
class TypedProfiles {
public:
    explicit TypedProfiles(std::vector<ParameterProfile> const&);  // which must outlive this

    // The same as the function above.
    std::optional<std::string> why_not(ParameterList const&) const;

private:
    std::vector<ParameterProfile> const* profiles_;
    std::vector<DataType> types_;
};

// Returns the parameters with the profiles' names and type codes, times in UTC, and the profile's codebook for identifiers
// without one (decision 31). `list` must have passed why_not().
ParameterList normalized(std::vector<ParameterProfile> const&, ParameterList const& list);

// Returns which argument without a default value is missing, or nullopt.
std::optional<std::string> why_incomplete(std::vector<ParameterProfile> const&, ParameterList const& normalized);

// Returns the arguments, completed by the default values, in the order of the profiles.
ParameterList with_defaults(std::vector<ParameterProfile> const&, ParameterList const& normalized);

// Overwrites the stored parameters with those that arrived, in the order of the profiles.
void merge(ParameterList& stored, ParameterList const& arrived, std::vector<ParameterProfile> const&);

}  // namespace rois
