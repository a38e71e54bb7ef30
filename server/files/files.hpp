// The project's files, embedded in the program, so that it needs no other files at run time.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace rois::files {

using Named = std::map<std::string, std::string_view, std::less<>>;  // file name -> bytes, with static lifetime

Named const& schemas();     // schemas/*.xsd
Named const& profiles();    // schemas/profiles/*.xml
Named const& simulation();  // components/simulation/data/*.xml: floor plans, scenarios, the hall's own profile
Named const& web();         // web/*.html: the page without JavaScript
Named const& console();     // web/console/dist, by path, with the compressed forms (".gz"); empty if it was not built

}  // namespace rois::files
