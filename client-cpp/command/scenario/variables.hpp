// The variables of a robot scenario, each a list of texts, and the steps that use them.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "command/scenario/scenario_file.hpp"
#include "types/values.hpp"

namespace rois::command {

// Returns the names in braces, in order.
std::vector<std::string> names_in(std::string_view text);

class Variables {
public:
    explicit Variables(std::map<std::string, std::string> const& at_first);

    bool has(std::string const& name) const { return values_.contains(name); }
    void set(std::string const& name, std::string value);

    // Replaces each {name} by the values of the variable, separated by commas.
    std::string filled(std::string_view text) const;

    // Runs the steps in order and adds their output to `printed`. Returns false, and changes nothing, if the condition of a step
    // does not hold. `results` may be null. Throws Trouble if a text is not a place.
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
