// Checks and describes simple types of the schemas, for the reasons of faults.
#pragma once

#include <string>
#include <string_view>
#include <xercesc/validators/datatype/DatatypeValidator.hpp>

namespace rois::xml {

enum class Value { good, bad };

// Returns whether the text is a value of the type. Does not check that ids are unique.
Value check(xercesc::DatatypeValidator&, std::string_view text);

// Describes the values of the type: "one of OK, ERROR", "a whole number, at least 0".
std::string description_of(xercesc::DatatypeValidator&);

}  // namespace rois::xml
