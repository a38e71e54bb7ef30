// The commands that ask: profile, search, query, get, health.
#include <algorithm>

#include "command/context.hpp"
#include "command/http.hpp"
#include "command/terminal.hpp"
#include "rois/condition.hpp"
#include "types/listing.hpp"
#include "types/texts.hpp"

namespace rois::command {

namespace {

// Refuses when there is no such component: a query says no more than that nothing answers it.
void check_there(Context& context, std::string const& ref) {
    if (context.ok(Search{conditions::component_ref == ref}).component_ref_list.empty()) context.component(ref);
}

}  // namespace

void profile(Context& context) {
    if (context.options().ref.empty()) {
        context.show(GetProfile{context.condition()});
    } else {
        context.printer().profile(context.component(context.options().ref));
    }
}

void search(Context& context) { context.show(Search{context.condition()}); }

void query(Context& context) {
    auto condition = context.condition();
    auto const& ref = context.options().ref;
    if (!ref.empty()) check_there(context, ref);
    if (!ref.empty()) condition = narrowed(std::move(condition), conditions::component_ref == ref);
    context.show(Query{context.options().name, std::move(condition)});
}

// By a query, which needs no binding (decision 18).
void get(Context& context) {
    auto const& options = context.options();
    check_there(context, options.ref);
    auto reply = context.ok(Query{"get_parameter", conditions::component_ref == options.ref});
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
}

void health(Options const& options, Printer& printer) {
    auto const answer = [&] {
        try {
            return http_get({options.url, options.token, options.ca_file}, "/readyz", options.deadline);
        } catch (Trouble const& trouble) {
            if (trouble.exit() == Exit::usage) throw;
            throw Trouble{Exit::error, std::string{"not healthy: "} + trouble.what()};
        }
    }();
    bool const ready = answer.status == 200;
    if (!ready && printer.form() == Form::human) {
        auto const body = harmless(trimmed(answer.body.substr(0, 200)));
        throw Trouble{Exit::error, "not healthy: " + options.url + " answers " + std::to_string(answer.status) +
                                       (body.empty() ? "" : ": " + body)};
    }
    printer.line(painted("healthy", Colour::good, printer.coloured()), "health",
                 Json{{"url", options.url}, {"ready", ready}, {"status", answer.status}});
    if (!ready) throw Trouble{Exit::error, ""};
}

}  // namespace rois::command
