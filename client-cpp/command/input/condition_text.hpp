// Reads conditions from the command line (docs/rois-command.md):
//
//     type = Navigation and status = READY
//     number > 0 and not (position_data within 0,0 4000,3000)
//     type = Navigation nearest desk
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

#include "types/condition.hpp"

namespace rois::command {

// An invalid condition: the reason, and the byte offset in the text.
class BadCondition : public std::runtime_error {
public:
    BadCondition(std::string const& what, std::size_t at) : std::runtime_error{what}, at_{at} {}
    std::size_t at() const { return at_; }

private:
    std::size_t at_;
};

// Reads a condition; an empty text restricts nothing. Throws BadCondition.
QueryExpression read_condition(std::string_view text);

}  // namespace rois::command
