#include "conformance/check.hpp"

namespace rois::conformance {

std::vector<Clause> all_clauses() {
    return {http_clause(),    websocket_clause(), notification_clause(), session_clause(),    profile_clause(),
            binding_clause(), parameter_clause(), execution_clause(),    completion_clause(), sequence_clause(),
            query_clause(),   event_clause(),     condition_clause(),    component_clause(),  stream_clause(),
            motion_clause(),  action_clause(),    people_clause(),       system_clause(),     choosing_clause()};
}

void require(bool holds, std::string const& message) {
    if (!holds) throw Broken{message};
}

kit::Document const& require_ok(kit::Document const& answer) {
    require(answer.return_code() == "OK", "expected return_code OK, got " + answer.whole());
    return answer;
}

void require_refusal(kit::Document const& answer, std::string const& return_code, std::string const& words) {
    require(answer.return_code() == return_code, "expected return_code " + return_code + ", got " + answer.whole());
    require(answer.reason().find(words) != std::string::npos,
            "expected a reason that contains \"" + words + "\", got " + answer.whole());
}

void require_fault(kit::Document const& answer, std::string const& code) {
    require(answer.fault() == code, "expected the fault " + code + ", got " + answer.whole());
}

void require_equal(std::string const& what, std::string const& expected, std::string const& found) {
    require(expected == found, what + ": expected \"" + expected + "\", got \"" + found + "\"");
}

std::string first_of(std::string const& what, std::vector<std::string> const& texts) {
    require(!texts.empty(), "expected " + what + ", got none");
    return texts.front();
}

std::string value_of(kit::Values const& values, std::string const& name) {
    auto const found = values.find(name);
    require(found != values.end(), "expected a value of " + name + ", got none");
    require(found->second.size() == 1, name + ": expected one value, got " + list(found->second));
    return found->second.front();
}

std::string list(std::vector<std::string> const& texts) {
    std::string all;
    for (auto const& text : texts) all += (all.empty() ? "" : ", ") + text;
    return "[" + all + "]";
}

}  // namespace rois::conformance
