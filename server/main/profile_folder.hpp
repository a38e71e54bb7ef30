// The folder of component profiles that users bring (key `profiles`).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulation/basic_components.hpp"
#include "types/profiles.hpp"
#include "xml/schemas.hpp"

namespace rois {

// One file of the folder, and what was found in it.
struct ProfileFile {
    enum class Verdict : std::uint8_t { ok, warning, refused };

    std::string name;  // without the folder
    Verdict verdict = Verdict::ok;
    std::vector<std::string> findings;        // warnings, or why it was refused: "name:line:column: reason"
    std::optional<ComponentProfile> profile;  // as the document says; absent in what was refused and in engine profiles
};

// Reads all *.xml of the folder, in the order of their names; `known` are the program's own profiles, which those of the folder
// may include. Refused is also what asks for an adapter that there is not, and what would make a component with the name of
// another. A file that is refused does not touch the others, but those that include its profile. Throws BadSettings when the
// folder cannot be read.
std::vector<ProfileFile> read_profile_folder(std::shared_ptr<xml::Schemas const> const&, std::string const& folder,
                                             std::vector<ComponentProfile> const& known, simulation::Streams);

// What --check-profiles says: a line for each finding and each file that is in order, and the sum.
std::string report_of(std::vector<ProfileFile> const&);

}  // namespace rois
