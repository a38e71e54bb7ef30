// For code that asks an engine: a condition on one component, and parts of the answers.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "types/condition.hpp"
#include "types/messages.hpp"

namespace rois {

inline Condition is_component(std::string ref) {
    return {PropertyComparison{.left = {ValueReference{"component_ref"}}, .right = {Literal{std::move(ref)}}}};
}

// The part that all answers have.
inline Outcome const& outcome_of(Reply const& reply) {
    return *std::visit([](Outcome const& outcome) { return &outcome; }, reply);
}

// The reason why an `execute` with one command is refused, without the command's place in the sequence: the asker has received
// the command in another sequence.
inline std::string reason_of_only_command(Outcome const& outcome) {
    constexpr std::string_view place = "command_unit_list[1]: ";
    std::string_view reason = outcome.reason;
    if (reason.starts_with(place)) reason.remove_prefix(place.size());
    return std::string{reason};
}

// The rows of an answer to a query; none if it is null or not OK.
inline std::vector<Results> rows_of(Reply const* reply) {
    std::vector<Results> rows;
    auto const* answer = reply == nullptr ? nullptr : std::get_if<Query::Reply>(reply);
    if (answer == nullptr || answer->return_code != ReturnCode::ok) return rows;
    rows.push_back(answer->results);
    rows.insert(rows.end(), answer->other_rows.begin(), answer->other_rows.end());
    return rows;
}

}  // namespace rois
