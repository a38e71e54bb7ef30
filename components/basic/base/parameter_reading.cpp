#include "basic/base/parameter_reading.hpp"

#include <string>

#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois::basic {

std::optional<std::int32_t> integer_of(ParameterList const& parameters, std::string_view name) {
    auto const* parameter = find(parameters, name);
    if (parameter == nullptr || parameter->values.empty()) return {};
    return to_int(parameter->values.front());
}

std::string_view text_of(ParameterList const& parameters, std::string_view name) {
    auto const* parameter = find(parameters, name);
    if (parameter == nullptr || parameter->values.empty()) return {};
    return trimmed(parameter->values.front());
}

bool is_true(ParameterList const& parameters, std::string_view name) {
    auto const text = text_of(parameters, name);
    return text == "true" || text == "1";
}

std::string_view codebook_of(ParameterList const& parameters, std::string_view name) {
    auto const* parameter = find(parameters, name);
    return parameter == nullptr ? std::string_view{} : std::string_view{parameter->data_type_ref.codebook_ref};
}

std::vector<std::int32_t> integers_of(ParameterList const& parameters, std::string_view name) {
    std::vector<std::int32_t> numbers;
    for (std::string_view rest = text_of(parameters, name); !rest.empty();) {
        auto const item = rest.substr(0, rest.find_first_of(" \t\r\n"));
        if (auto const number = to_int(item)) numbers.push_back(*number);
        rest = trimmed(rest.substr(item.size()));
    }
    return numbers;
}

std::optional<std::string> not_between(ParameterList const& parameters, std::string_view name, std::int32_t least,
                                       std::int32_t most) {
    auto const number = integer_of(parameters, name);
    if (!number || (*number >= least && *number <= most)) return {};
    return "parameter '" + std::string{name} + "' must be " + std::to_string(least) + " to " + std::to_string(most) + ", not " +
           std::to_string(*number);
}

std::optional<std::string> negative(ParameterList const& parameters, std::string_view name) {
    auto const number = integer_of(parameters, name);
    if (!number || *number >= 0) return {};
    return "parameter '" + std::string{name} + "' must be 0 or more, not " + std::to_string(*number);
}

std::optional<std::string> not_targets(Parameter const& targets, std::vector<NamedPlace> const& places,
                                       std::function<bool(std::string const&)> const& is_target) {
    constexpr std::size_t most = 100;
    if (targets.values.size() > most)
        return "parameter '" + targets.name + "' has more than " + std::to_string(most) + " positions";
    for (auto const& text : targets.values)
        if (!is_target(text))
            return "parameter '" + targets.name + "': " + quoted(text) +
                   R"( is not a valid target: expected "x, y", "x, y, th" (mm, mm, degree) or one of the places )" +
                   listed(places, &NamedPlace::name);
    return {};
}

}  // namespace rois::basic
