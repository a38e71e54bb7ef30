// The folder of component profiles that a user provides (key `profiles`).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "basic/components/basic_components.hpp"
#include "types/profiles.hpp"
#include "xml/validation/schemas.hpp"

namespace rois {

// One file of the folder, and the result of its check.
struct ProfileFile {
    enum class Verdict : std::uint8_t { ok, warning, refused };

    std::string name;  // without the folder
    Verdict verdict = Verdict::ok;
    std::vector<std::string> findings;        // warnings, or why the file was refused: "name:line:column: reason"
    std::optional<ComponentProfile> profile;  // as in the document; unset for refused files and engine profiles
};

// Reads all *.xml of the folder, in the order of their names. Profiles may include the built-in profiles (`known`). Refuses a
// file if its profile is invalid, needs an adapter that does not exist, or would make a component with a name that is taken.
// Refusing a file affects only the files that include its profile. Throws BadSettings if the folder cannot be read.
std::vector<ProfileFile> read_profile_folder(std::shared_ptr<xml::Schemas const> const&, std::string const& folder,
                                             std::vector<ComponentProfile> const& known, basic::Streams);

// The output of --check-profiles: a line for each finding and each valid file, and the totals.
std::string report_of(std::vector<ProfileFile> const&);

}  // namespace rois
