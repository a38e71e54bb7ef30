// What a condition says of components, events and results (decisions 4, 18, 19).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "types/condition.hpp"
#include "types/messages.hpp"
#include "types/values.hpp"

namespace rois {

class RegisteredComponent;
struct Session;

// How far something is from fulfilling a condition. `maybe`: what it depends on is not known yet or may change.
enum class Match : std::uint8_t { no, maybe, yes };

// What a value reference stands for: its values (any of which may fulfil a comparison), or nothing while that is open.
struct Referred {
    std::optional<std::vector<std::string>> values;
    bool ignore_case = false;
};
using Resolve = std::function<Referred(std::string_view reference)>;

Match match(Condition const&, Resolve const&);

// Why the condition cannot be used: an operator that is not understood, or a reference that is none of `known`. Nothing when it
// can.
std::optional<std::string> why_unusable(MaybeCondition const&, std::vector<std::string> const& known);

// The value references that speak of a component.
std::vector<std::string> component_references();

// As `asker` sees the component now; and whether it could ever match, whatever its status and binding become.
bool matches(MaybeCondition const&, RegisteredComponent const&, Session const* asker);
bool could_match(MaybeCondition const&, RegisteredComponent const&);

// A subscription's condition: the component as `asker` sees it, and the event's results.
bool matches(MaybeCondition const&, RegisteredComponent const&, Results const& event, Session const* asker);

// Whether the answer may differ from asker to asker (`status` does, decision 7).
bool depends_on_asker(MaybeCondition const&);

// Conditions on results choose all of them or none.
bool matches(MaybeCondition const&, Results const&);

// Two conditions mean the same when their canonical texts are equal.
std::string canonical(MaybeCondition const&);

}  // namespace rois
