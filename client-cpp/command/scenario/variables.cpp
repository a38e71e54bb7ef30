#include "command/scenario/variables.hpp"

#include <algorithm>
#include <utility>

#include "command/exit.hpp"
#include "rois/units.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois::command {

namespace {

Pose pose_of(std::string const& text) {
    auto const pose = to_pose(text);
    if (!pose) throw Trouble{Exit::usage, rois::quoted(text) + " is not a place: expected \"x, y, th\""};
    return *pose;
}

}  // namespace

std::vector<std::string> names_in(std::string_view text) {
    std::vector<std::string> names;
    for (auto begin = text.find('{'); begin != text.npos; begin = text.find('{', begin + 1)) {
        auto const end = text.find('}', begin);
        if (end == text.npos) break;
        names.emplace_back(text.substr(begin + 1, end - begin - 1));
    }
    return names;
}

Variables::Variables(std::map<std::string, std::string> const& at_first) {
    for (auto const& [name, value] : at_first) set(name, value);
}

void Variables::set(std::string const& name, std::string value) {
    auto& values = values_[name];
    values.clear();
    if (!value.empty()) values.push_back(std::move(value));
}

std::string Variables::filled(std::string_view text) const {
    std::string filled;
    while (true) {
        auto const begin = text.find('{');
        auto const end = text.find('}', begin == text.npos ? 0 : begin);
        if (begin == text.npos || end == text.npos) return filled.append(text);
        filled.append(text.substr(0, begin));
        auto const found = values_.find(std::string{text.substr(begin + 1, end - begin - 1)});
        if (found != values_.end()) filled.append(listed(found->second));
        text.remove_prefix(end + 1);
    }
}

bool Variables::take(std::vector<Step> const& steps, Results const* results, std::vector<std::string>& printed) {
    auto const before = values_;
    std::vector<std::string> lines;
    for (auto const& step : steps) {
        bool const holds = std::visit([&](auto const& one) { return apply(one, results, lines); }, step);
        if (holds) continue;
        values_ = before;
        return false;
    }
    printed.insert(printed.end(), lines.begin(), lines.end());
    return true;
}

bool Variables::apply(SetVariable const& step, Results const*, std::vector<std::string>&) {
    set(step.variable, filled(step.text));
    return true;
}

bool Variables::apply(AddValue const& step, Results const*, std::vector<std::string>&) {
    values_[step.variable].push_back(filled(step.text));
    return true;
}

bool Variables::apply(CountUp const& step, Results const*, std::vector<std::string>&) {
    auto const& values = values_[step.variable];
    auto const now = values.empty() ? 0 : to_int(values.front()).value_or(0);
    set(step.variable, std::to_string(now + 1));
    return true;
}

bool Variables::apply(PlaceBefore const& step, Results const*, std::vector<std::string>&) {
    set(step.variable, to_text(rois::before(pose_of(filled(step.before)), millimetres{step.distance}, degrees{step.turn})));
    return true;
}

bool Variables::apply(Print const& step, Results const*, std::vector<std::string>& printed) {
    printed.push_back(filled(step.text));
    return true;
}

bool Variables::apply(TakeResult const& step, Results const* results, std::vector<std::string>&) {
    auto const* const result = results == nullptr ? nullptr : find(results->parameters, step.result);
    auto const* const other = results == nullptr || step.beside.empty() ? nullptr : find(results->parameters, step.beside);
    if (result == nullptr || (other == nullptr && !step.beside.empty())) return false;
    auto const is = filled(step.is);
    for (std::size_t i = 0; i < result->values.size(); ++i) {
        auto const& value = result->values[i];
        if (other != nullptr && (i >= other->values.size() || other->values[i] != is)) continue;
        auto const is_it = [&](std::string const& listed) {
            return step.apart > 0 ? distance(pose_of(listed), pose_of(value)).value < step.apart : listed == value;
        };
        if (!step.not_in.empty() && std::ranges::any_of(values_[step.not_in], is_it)) continue;
        set(step.variable, value);
        return true;
    }
    return false;
}

bool Variables::apply(When const& step, Results const*, std::vector<std::string>&) {
    using enum When::Relation;
    auto const& values = values_[step.variable];
    auto const is_in = [&](Values const& list) {
        return std::ranges::any_of(values, [&](auto const& value) { return std::ranges::find(list, value) != list.end(); });
    };
    switch (step.relation) {
        case is:
            return listed(values) == filled(step.operand);
        case is_not:
            return listed(values) != filled(step.operand);
        case in:
            return is_in(values_[step.operand]);
        case not_in:
            return !is_in(values_[step.operand]);
        case empty:
            return values.empty();
        case not_empty:
            return !values.empty();
        case near:
            return !values.empty() && distance(pose_of(values.front()), pose_of(filled(step.operand))).value <= step.within;
    }
    return false;
}

}  // namespace rois::command
