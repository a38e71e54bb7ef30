// Messages as people read them.
#pragma once

#include <string>
#include <string_view>

#include "types/messages.hpp"

namespace rois::command {

// Lines with what a reply that is OK has beside its code; empty when that is nothing.
std::string described(Reply const&, bool coloured);

// One line, without the time.
std::string described(Notification const&, bool coloured);

// All that a component's profile says.
std::string described(ComponentEntry const&, bool coloured);

// "person_ref=tanaka position_data="9500, 7500, 90""
std::string values_line(ParameterList const&, bool coloured);

// The last part of a URN.
std::string_view short_type(std::string_view urn);

}  // namespace rois::command
