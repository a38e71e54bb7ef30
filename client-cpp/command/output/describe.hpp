// Messages as text for people.
#pragma once

#include <string>
#include <string_view>

#include "types/messages.hpp"

namespace rois::command {

// Returns the content of an OK reply as lines; empty if it has none.
std::string described(Reply const&, bool coloured);

// Returns one line, without the time.
std::string described(Notification const&, bool coloured);

// Returns the whole profile of a component.
std::string described(ComponentEntry const&, bool coloured);

// Returns, for example, person_ref=tanaka position_data="9500, 7500, 90".
std::string values_line(ParameterList const&, bool coloured);

// Returns the last part of a URN.
std::string_view short_type(std::string_view urn);

}  // namespace rois::command
