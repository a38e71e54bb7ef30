#include "conformance/check.hpp"

namespace rois::conformance {

std::vector<Clause> all_clauses() {
    return {wire_clause(),    websocket_clause(), notification_clause(), session_clause(),    profile_clause(),
            binding_clause(), parameter_clause(), execution_clause(),    completion_clause(), sequence_clause(),
            query_clause(),   event_clause(),     condition_clause(),    component_clause(),  stream_clause(),
            motion_clause(),  action_clause(),    people_clause(),       system_clause()};
}

void require(bool holds, std::string const& otherwise) {
    if (!holds) throw Broken{otherwise};
}

kit::Document const& ok(kit::Document const& answer) {
    require(answer.return_code() == "OK", "expected OK, but the answer is " + answer.whole());
    return answer;
}

void refused(kit::Document const& answer, std::string const& return_code, std::string const& words) {
    require(answer.return_code() == return_code, "expected " + return_code + ", but the answer is " + answer.whole());
    require(answer.reason().find(words) != std::string::npos,
            "the reason should name \"" + words + "\", but the answer is " + answer.whole());
}

void fault(kit::Document const& answer, std::string const& code) {
    require(answer.fault() == code, "expected the fault " + code + ", but the answer is " + answer.whole());
}

void same(std::string const& what, std::string const& expected, std::string const& found) {
    require(expected == found, what + " should be \"" + expected + "\", but is \"" + found + "\"");
}

std::string first(std::string const& what, std::vector<std::string> const& texts) {
    require(!texts.empty(), "there should be " + what + ", and is none");
    return texts.front();
}

std::string value_of(kit::Values const& values, std::string const& name) {
    auto const found = values.find(name);
    require(found != values.end(), "there should be a value of " + name + ", and is none");
    require(found->second.size() == 1, name + " should have one value, and has " + list(found->second));
    return found->second.front();
}

std::string list(std::vector<std::string> const& texts) {
    std::string all;
    for (auto const& text : texts) all += (all.empty() ? "" : ", ") + text;
    return "[" + all + "]";
}

}  // namespace rois::conformance
