#include "command/input/arguments.hpp"

#include <algorithm>

#include "command/exit.hpp"
#include "types/data_type.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois::command {

namespace {

std::vector<ParameterProfile> known_arguments(ComponentProfile const& profile, std::string_view command_type) {
    std::vector<ParameterProfile> known;
    auto const add = [&](std::vector<ParameterProfile> const& more) {
        for (auto const& one : more)
            if (find_parameter(known, one.name) == nullptr) known.push_back(one);
    };
    if (auto const* const message = find_message(profile, MessageKind::command, command_type)) add(message->arguments);
    if (auto const* const setting = find_message(profile, MessageKind::command, "set_parameter")) add(setting->arguments);
    add(profile.parameters);
    return known;
}

void add_value(Parameter& parameter, DataType const& type, std::string const& value) {
    bool const one_text_each = type.base == BaseType::integer || type.base == BaseType::real || type.base == BaseType::boolean;
    if (!type.list || !one_text_each || parameter.values.empty()) {
        if (!type.list || one_text_each || !value.empty()) parameter.values.push_back(value);
    } else {
        parameter.values.front() += " " + value;
    }
}

}  // namespace

ParameterList read_arguments(ComponentProfile const& profile, std::string_view command_type,
                             std::vector<std::string> const& given) {
    auto const known = known_arguments(profile, command_type);
    ParameterList arguments;
    for (auto const& text : given) {
        auto const sign = text.find('=');
        if (sign == std::string::npos || sign == 0) throw Trouble{Exit::usage, quoted(text) + " is not NAME=VALUE"};
        auto const name = text.substr(0, sign);
        auto const* const declared = find_parameter(known, name);
        if (declared == nullptr) {
            auto const names = listed(known, &ParameterProfile::name);
            throw Trouble{Exit::usage, profile.object.name + " has no argument " + quoted(name) +
                                           (names.empty() ? "; it has no arguments" : "; it has " + names)};
        }
        auto const there = std::ranges::find(arguments, declared->name, &Parameter::name);
        auto& argument = there != arguments.end() ? *there : arguments.emplace_back(declared->name, declared->data_type_ref);
        argument.data_type_ref.codebook_ref.clear();  // positions are in the engine's frame, as in the answers to queries
        add_value(argument, DataType::of(declared->data_type_ref), text.substr(sign + 1));
    }
    for (auto const& argument : arguments) {
        auto const type = DataType::of(argument.data_type_ref);
        if (auto const wrong = why_not(type, argument.values)) throw Trouble{Exit::usage, argument.name + ": " + *wrong};
    }
    return arguments;
}

}  // namespace rois::command
