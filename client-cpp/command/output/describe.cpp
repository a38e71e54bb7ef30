#include "command/output/describe.hpp"

#include <cstdio>
#include <utility>
#include <variant>

#include "command/output/terminal.hpp"
#include "types/text/listing.hpp"

namespace rois::command {

namespace {

std::string listed_values(ParameterList::value_type const& parameter) { return listed(parameter.values); }

Table table_of(ParameterList const& parameters) {
    Table table;
    for (auto const& parameter : parameters) {
        auto const several = parameter.values.size() > 1;
        table.add({{parameter.name, Colour::name},
                   {parameter.data_type_ref.code, Colour::quiet},
                   {several || parameter.values.empty() ? "" : parameter.values.front(), Colour::value}});
        if (!several) continue;
        for (auto const& value : parameter.values) table.add({{}, {}, {value, Colour::value}});
    }
    return table;
}

std::string rounded(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.0f", number);
    return text == std::string_view{"-0"} ? "0" : text;
}

std::string certainty(Located const& located) {
    if (auto const* const reliability = std::get_if<Located::Reliability>(&located.certainty)) {
        char text[48];
        std::snprintf(text, sizeof text, "certain to %.0f %%", reliability->probability * 100);
        return text;
    }
    return {};
}

std::string described_results(Results const& results, bool coloured) {
    auto text = table_of(results.parameters).text(coloured);
    Table table;
    for (auto const& one : results.located) {
        auto place = rounded(one.position[0]) + ", " + rounded(one.position[1]) + ", " + rounded(one.position[2]) + " mm";
        auto const turned = one.orientation.size() == 3 ? rounded(one.orientation[2]) + " deg" : "";
        table.add({{one.ref, Colour::name},
                   {std::move(place), Colour::value},
                   {turned, Colour::value},
                   {certainty(one)},
                   {one.crs, Colour::quiet}});
    }
    return text + table.text(coloured);
}

std::string described_profile(GetProfile::Reply const& reply, bool coloured) {
    if (!reply.profile) return {};
    auto const& object = reply.profile->object;
    auto text = painted(object.name, Colour::value, coloured) + "  " + painted(object.identifier, Colour::quiet, coloured) + "\n";
    Table engine;
    for (auto const& parameter : reply.profile->parameters)
        engine.add({{parameter.name, Colour::name},
                    {parameter.default_value.value_or(""), Colour::value},
                    {parameter.description, Colour::quiet}});
    Table components;
    for (auto const& entry : reply.components)
        components.add({{entry.ref, Colour::name}, {std::string{short_type(entry.type)}}, {entry.engine, Colour::quiet}});
    return text + engine.text(coloured, "  ") + components.text(coloured);
}

struct Out {
    bool coloured;

    std::string operator()(Outcome const&) const { return {}; }
    std::string operator()(Connect::Reply const& reply) const { return reply.session.text + "\n"; }
    std::string operator()(GetProfile::Reply const& reply) const { return described_profile(reply, coloured); }
    std::string operator()(GetErrorDetail::Reply const& reply) const { return described_results(reply.results, coloured); }
    std::string operator()(Search::Reply const& reply) const {
        Table table;
        for (auto const& ref : reply.component_ref_list)
            table.add({{ref.code, Colour::name}, {std::string{short_type(ref.codebook_ref)}, Colour::quiet}});
        return table.text(coloured);
    }
    std::string operator()(BindAny::Reply const& reply) const {
        return painted(reply.component_ref.code, Colour::name, coloured) + "\n";
    }
    std::string operator()(GetParameter::Reply const& reply) const { return table_of(reply.parameters).text(coloured); }
    std::string operator()(SetParameter::Reply const&) const { return {}; }
    std::string operator()(Execute::Reply const&) const { return {}; }
    std::string operator()(GetCommandResult::Reply const& reply) const { return described_results(reply.results, coloured); }
    std::string operator()(Query::Reply const& reply) const {
        return painted(reply.component_ref.code, Colour::name, coloured) + "\n" + described_results(reply.results, coloured);
    }
    std::string operator()(Subscribe::Reply const& reply) const { return reply.subscribe_id.text + "\n"; }
    std::string operator()(GetEventDetail::Reply const& reply) const { return described_results(reply.results, coloured); }
};

std::string headline(std::string_view what, std::string_view who, Colour colour, bool coloured) {
    Table table;
    table.add({{std::string{what}, colour}, {std::string{who}, Colour::quiet}});
    auto line = table.text(coloured);
    line.pop_back();
    return line;
}

struct NotificationText {
    bool coloured;

    std::string operator()(ReceiveEvent const& event) const {
        auto line = headline(event.event_type, event.component_ref.code, Colour::name, coloured);
        if (event.results) line += "  " + values_line(event.results->parameters, coloured);
        return line;
    }
    std::string operator()(ReceiveError const& error) const {
        return headline(to_text(error.error_type), error.component_ref ? error.component_ref->code : "", Colour::bad, coloured) +
               "  " + painted(error.error_id.text, Colour::quiet, coloured);
    }
    std::string operator()(Completed const& completed) const {
        auto const colour = completed.status == CompletedStatus::ok ? Colour::good : Colour::bad;
        return headline("completed", completed.command_id.text, Colour::name, coloured) + "  " +
               painted(to_text(completed.status), colour, coloured);
    }
    std::string operator()(Lost const& lost) const {
        return painted("lost", Colour::bad, coloured) + "  " + std::to_string(lost.count) + " notifications";
    }
    std::string operator()(ProfileChanged const&) const { return painted("profile_changed", Colour::name, coloured); }
    std::string operator()(ComponentChanged const& changed) const {
        return headline("component_changed", changed.component_ref.code, Colour::name, coloured) + "  " +
               std::string{to_text(changed.status)};
    }
    std::string operator()(Switched const& switched) const {
        return headline("switched", switched.component_ref.code, Colour::name, coloured) + "  " +
               harmless("from " + switched.from + " to " + switched.to + ": " + switched.reason);
    }
};

void add_declared(std::string& text, std::vector<ParameterProfile> const& parameters, std::string_view indent, bool coloured) {
    Table table;
    for (auto const& parameter : parameters) {
        auto const usual = parameter.default_value ? "= " + *parameter.default_value : "";
        table.add(
            {{parameter.name, Colour::value}, {parameter.data_type_ref.code}, {usual}, {parameter.description, Colour::quiet}});
    }
    text += table.text(coloured, indent);
}

void add_messages(std::string& text, ComponentProfile const& profile, MessageKind kind, std::string_view title, bool coloured) {
    bool first = true;
    for (auto const& message : profile.messages) {
        if (message.kind != kind) continue;
        if (std::exchange(first, false)) text.append(title).append("\n");
        text += "  " + painted(message.name, Colour::name, coloured) + "\n";
        add_declared(text, message.arguments, "    ", coloured);
        add_declared(text, message.results, "    ", coloured);
    }
}

}  // namespace

std::string_view short_type(std::string_view urn) {
    auto const colon = urn.rfind(':');
    return colon == urn.npos ? urn : urn.substr(colon + 1);
}

std::string values_line(ParameterList const& parameters, bool coloured) {
    std::string line;
    for (auto const& parameter : parameters) {
        auto value = listed_values(parameter);
        if (value.find_first_of(" \t\"") != value.npos) value.insert(0, 1, '"').push_back('"');
        if (!line.empty()) line += " ";
        line += painted(parameter.name, Colour::quiet, coloured) + "=" + painted(value, Colour::value, coloured);
    }
    return line;
}

std::string described(Reply const& reply, bool coloured) { return std::visit(Out{coloured}, reply); }

std::string described(Notification const& notification, bool coloured) {
    return std::visit(NotificationText{coloured}, notification);
}

std::string described(ComponentEntry const& entry, bool coloured) {
    auto text = painted(entry.ref, Colour::value, coloured) + "  " + painted(entry.type, Colour::quiet, coloured) + "\n";
    if (!entry.profile) return text;
    auto const& profile = *entry.profile;
    if (!profile.object.description.empty()) text += "  " + harmless(profile.object.description) + "\n";
    if (!profile.sub_components.empty()) text += "includes " + harmless(listed(profile.sub_components, short_type)) + "\n";
    add_messages(text, profile, MessageKind::command, "commands", coloured);
    add_messages(text, profile, MessageKind::query, "queries", coloured);
    add_messages(text, profile, MessageKind::event, "events", coloured);
    if (!profile.parameters.empty()) text += "parameters\n";
    add_declared(text, profile.parameters, "  ", coloured);
    return text;
}

}  // namespace rois::command
