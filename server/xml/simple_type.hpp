// The simple types of the schemas, as far as faults speak of them.
#pragma once

#include <string>
#include <string_view>
#include <xercesc/validators/datatype/DatatypeValidator.hpp>

namespace rois::xml {

enum class Value { good, bad };

// Whether the text is a value of the type. Uniqueness of ids is not looked at.
Value check(xercesc::DatatypeValidator&, std::string_view text);

// What a value of the type looks like, in words: "one of OK, ERROR", "a whole number, at least 0".
std::string description_of(xercesc::DatatypeValidator&);

}  // namespace rois::xml
