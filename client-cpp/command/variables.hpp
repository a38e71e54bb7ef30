// The variables of a robot scenario, each a list of texts, and what its steps do with them.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "command/scenario_file.hpp"
#include "types/values.hpp"

namespace rois::command {

// The names in braces, in order.
std::vector<std::string> names_in(std::string_view text);

class Variables {
public:
    explicit Variables(std::map<std::string, std::string> const& at_first);

    bool has(std::string const& name) const { return values_.contains(name); }
    void set(std::string const& name, std::string value);

    // The text with what variables hold in place of their names; the values of a list with commas between.
    std::string filled(std::string_view text) const;

    // Does the steps in order. False, and nothing is changed or printed, when one of them does not hold. `results` may be null.
    // What is printed is added to `printed`. Throws Trouble for a place that is none.
    bool take(std::vector<Step> const&, Results const* results, std::vector<std::string>& printed);

private:
    using Values = std::vector<std::string>;

    bool apply(SetVariable const&, Results const*, std::vector<std::string>&);
    bool apply(AddValue const&, Results const*, std::vector<std::string>&);
    bool apply(CountUp const&, Results const*, std::vector<std::string>&);
    bool apply(PlaceBefore const&, Results const*, std::vector<std::string>&);
    bool apply(Print const&, Results const*, std::vector<std::string>&);
    bool apply(TakeResult const&, Results const*, std::vector<std::string>&);
    bool apply(When const&, Results const*, std::vector<std::string>&);

    std::map<std::string, Values> values_;
};

}  // namespace rois::command
