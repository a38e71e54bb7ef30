// The commands profile, search, query, get and health.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "command/context.hpp"
#include "command/http.hpp"
#include "command/output/terminal.hpp"
#include "rois/condition.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois::command {

namespace {

// Throws Trouble if the component is unknown. A query would only report that no component answers it.
void check_there(Context& context, std::string const& ref) {
    if (context.ok(Search{conditions::component_ref == ref}).component_ref_list.empty()) context.component(ref);
}

std::vector<ComponentEntry> of(std::vector<ComponentEntry> components, std::string const& ref) {
    std::erase_if(components, [&](ComponentEntry const& component) { return component.ref != ref; });
    return components;
}

// Returns the components that have this query.
std::vector<ComponentEntry> components_with(std::vector<ComponentEntry> components, std::string const& query) {
    std::erase_if(components, [&](ComponentEntry const& component) {
        auto const known = message_names({component}, MessageKind::query);
        return std::ranges::find(known, query) == known.end();
    });
    return components;
}

std::string name_and_engine(ComponentEntry const& entry) { return entry.ref + " (engine " + entry.engine + ")"; }

}  // namespace

void profile(Context& context) {
    if (context.options().ref.empty()) {
        context.show(GetProfile{context.condition()});
    } else {
        context.printer().profile(context.component(context.options().ref));
    }
}

void search(Context& context) {
    if (!context.show(Search{context.condition()}).component_ref_list.empty()) return;
    remark("no component meets the condition; the engine has " + components_and_types(context.components()));
}

void query(Context& context) {
    auto condition = context.condition();
    auto const& ref = context.options().ref;
    bool const has_condition = !context.options().where.empty() || !context.options().condition_file.empty();
    if (!ref.empty()) check_there(context, ref);
    if (!ref.empty()) condition = narrowed(std::move(condition), conditions::component_ref == ref);
    auto const& name = context.options().name;
    auto const reply = context.show(Query{name, std::move(condition)}, [&]() -> std::string {
        auto const components = context.components();
        auto known = message_names(components, MessageKind::query);
        bool const is_known = std::ranges::find(known, name) != known.end();
        if (ref.empty()) {
            if (!is_known) return "; there are the queries " + listed(known);
            return has_condition ? "; the query is answered by " + listed(components_with(components, name), name_and_engine)
                                 : "";
        }
        known = message_names(of(components, ref), MessageKind::query);
        if (std::ranges::find(known, name) != known.end()) return {};
        return "; " + ref + " has " + (known.empty() ? "no queries" : "the queries " + listed(known));
    });
    if (reply.results.parameters.empty()) remark("the answer has no results");
}

// Uses a query, which needs no binding (decision 18).
void get(Context& context) {
    auto const& options = context.options();
    check_there(context, options.ref);
    auto reply = context.ok(Query{"get_parameter", conditions::component_ref == options.ref},
                            [&] { return "; " + options.ref + " has no parameters"; });
    auto& parameters = reply.results.parameters;
    for (auto const& name : options.words) {
        if (find(parameters, name) != nullptr) continue;
        context.refuse<GetParameter>(ReturnCode::bad_parameter, options.ref + " has no parameter " + rois::quoted(name) +
                                                                    " that is set; it has " +
                                                                    listed(parameters, &Parameter::name));
    }
    std::erase_if(parameters, [&](Parameter const& parameter) {
        auto const is_it = [&](std::string const& name) { return equal_ignoring_case(name, parameter.name); };
        return !options.words.empty() && std::ranges::none_of(options.words, is_it);
    });
    GetParameter::Reply shown;
    shown.parameters = std::move(parameters);
    context.printer().reply(shown, "get_parameter");
    if (shown.parameters.empty()) remark(options.ref + " has no parameter that is set");
}

void health(Options const& options, Printer& printer) {
    auto const answer = [&] {
        try {
            return http_get(server_of(options), "/readyz", options.deadline);
        } catch (Trouble const& trouble) {
            if (trouble.exit() == Exit::usage) throw;
            throw Trouble{Exit::error, std::string{"not healthy: "} + trouble.what()};
        }
    }();
    bool const ready = answer.status == 200;
    bool const stopped = answer.status == 503 && answer.body.starts_with("stopped");
    auto const moving = not_confirmed(answer.body);
    if (stopped && printer.form() == Form::human)
        throw Trouble{Exit::error, "not healthy: everything is stopped at " + options.url + "; nothing starts until: rois clear" +
                                       (moving.empty() ? "" : "; not confirmed that they stand still: " + listed(moving))};
    if (!ready && printer.form() == Form::human) {
        auto const body = harmless(trimmed(answer.body.substr(0, 200)));
        throw Trouble{Exit::error, "not healthy: " + options.url + " answered with HTTP status " + std::to_string(answer.status) +
                                       (body.empty() ? "" : ": " + body) + hint_for_url(options.url)};
    }
    printer.line(
        painted("healthy", Colour::good, printer.coloured()), "health",
        Json{{"url", options.url}, {"ready", ready}, {"status", answer.status}, {"stopped", stopped}, {"not_confirmed", moving}});
    if (!ready) throw Trouble{Exit::error, ""};
}

}  // namespace rois::command
