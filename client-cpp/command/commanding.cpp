// The commands bind, release, set, start, stop, resume and execute.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "command/context.hpp"
#include "command/input/arguments.hpp"
#include "command/input/input.hpp"
#include "command/input/request_file.hpp"
#include "command/output/terminal.hpp"
#include "command/sequences.hpp"
#include "rois/condition.hpp"
#include "types/text/texts.hpp"

namespace rois::command {

namespace {

Identifier ref_of(std::string const& code) { return {code, {}, {}, {}}; }

constexpr auto between_looks = std::chrono::seconds{1};  // interval of the checks of the session file

// Returns the next update, or nothing after `until`, after a signal, when the connection has closed, or when the session file no
// longer leads to this process.
std::optional<Update> next(Context& context, Until until) {
    auto& session = context.session();
    if (!context.holds_session_file()) return session.next_update(until);
    while (context.is_found_by_session_file()) {
        auto const look = std::chrono::steady_clock::now() + between_looks;
        auto update = session.next_update(until ? std::min(*until, look) : look);
        if (update || std::chrono::steady_clock::now() < look) return update;
    }
    return std::nullopt;
}

// Waits until the time is over, a signal arrives or the connection closes. Reports changes of the link, and errors.
void hold(Context& context, Until until) {
    auto& session = context.session();
    auto& printer = context.printer();
    context.keep_recording();
    while (auto const update = next(context, until)) {
        if (session.interrupted()) return;
        if (auto const* const gap = std::get_if<Gap>(&*update)) {
            printer.gap(*gap);
            bool const is_bound_to_it = context.options().command == "start" || context.holds_session_file();
            if (gap->why == Gap::Why::new_session && is_bound_to_it) throw ended_with_session();
        }
        auto const* const change = std::get_if<StateChange>(&*update);
        bool const usual = change == nullptr || change->state == State::open || change->state == State::connecting;
        if (!usual) printer.state(*change);
        if (auto const* const news = std::get_if<News>(&*update);
            news != nullptr && std::holds_alternative<ReceiveError>(news->notification))
            report_error(context, *news);
    }
    bool const over = session.interrupted() || (until && std::chrono::steady_clock::now() >= *until);
    bool const is_lost = context.holds_session_file() && !context.is_found_by_session_file();
    if (!over && !is_lost) throw Trouble{Exit::no_answer, "the connection has closed"};
}

void print_bound(Context& context, std::string const& ref) {
    auto& printer = context.printer();
    if (printer.form() == Form::human) printer.text("bound " + painted(ref, Colour::name, printer.coloured()) + "\n");
}

CommandUnitSequence one_command(std::string const& ref, std::string const& type, ParameterList arguments) {
    CommandUnitSequence sequence;
    auto& unit = sequence.command_unit_list.emplace_back();
    unit.unit = CommandMessage{ref_of(ref), type, {}, std::move(arguments)};
    return sequence;
}

// Returns the engine's components for the refusal of a `bind_any`; empty if one of them meets the condition.
std::string hint_for_bind_any(Context& context, QueryExpression const& condition) {
    auto const answer = context.session().request(Search{condition});
    auto const* const reply = std::get_if<Reply>(&answer);
    auto const* const found = reply != nullptr ? std::get_if<Search::Reply>(reply) : nullptr;
    if (found == nullptr || !found->component_ref_list.empty()) return {};
    return "; the engine has " + components_and_types(context.components());
}

// Throws Trouble if the file is missing. The reason mentions components, because users may forget the command before the name of
// a component.
void check_file(std::string const& name) {
    std::error_code unknown;
    bool const is_meant = name == "-" || name.find_first_of("./") != std::string::npos || std::filesystem::exists(name, unknown);
    if (!is_meant)
        throw Trouble{Exit::usage, "there is no file " + rois::quoted(name) +
                                       "; if it is a component, add a command: rois execute " + name + " start"};
}

// In a shared session: returns the components that are not bound.
std::vector<Identifier> free_components(Context& context) {
    if (!context.session().is_joined()) return {};
    return context.ok(Search{conditions::bound == false}).component_ref_list;
}

struct Bound {
    std::string operation;
    Identifier component;
    Reply reply;
};

// Binds one component after the other. Appends each to `done` at once.
void bind_each(Context& context, QueryExpression const& condition, std::vector<Bound>& done) {
    auto const& options = context.options();
    for (auto const& ref : options.words) done.push_back({"bind", ref_of(ref), context.bound(ref_of(ref))});
    if (options.where.empty() && options.condition_file.empty()) return;
    auto reply = context.ok(BindAny{condition, options.switching.value_or(Switching::none)},
                            [&] { return hint_for_bind_any(context, condition); });
    done.push_back({"bind_any", reply.component_ref, reply});
}

// Binds all components. If one is refused, releases the others again, because a shared session would keep them bound.
std::vector<Bound> bind_all(Context& context, QueryExpression const& condition) {
    auto const free = free_components(context);
    std::vector<Bound> all;
    try {
        bind_each(context, condition, all);
    } catch (NoSession const&) {
        throw;
    } catch (Trouble const&) {
        for (auto const& bound : all)
            if (std::ranges::find(free, bound.component.code, &Identifier::code) != free.end())
                context.session().request(Release{bound.component});
        throw;
    }
    return all;
}

ParameterList arguments_of(Context& context, std::string const& ref, std::string const& type,
                           std::vector<std::string> const& given) {
    if (given.empty()) return {};
    return read_arguments(*context.component(ref).profile, type, given);
}

}  // namespace

void bind(Context& context) {
    auto const& options = context.options();
    auto const condition = context.condition();
    std::optional<std::vector<Bound>> all;
    while (!all) {
        try {
            all = bind_all(context, condition);
        } catch (NoSession const& gone) {
            context.begin_again(gone);
        }
    }
    for (auto const& bound : *all) {
        if (options.form != Form::human) context.printer().reply(bound.reply, bound.operation);
        print_bound(context, bound.component.code);
    }
    auto& session = context.session();
    if (session.is_joined()) return;
    auto const id = session.id().text;
    context.printer().line("session " + id, "session", Json{{"session", id}});
    context.go_to_background();
    hold(context, end_of(options));
}

void release(Context& context) {
    auto const& options = context.options();
    if (options.words.empty()) return end_holder(options.session_file, options.held->holder, options.deadline);
    for (auto const& ref : options.words) context.show(Release{ref_of(ref)}, [&] { return context.hint_for_component(ref); });
}

void set(Context& context) {
    auto const& options = context.options();
    auto parameters = arguments_of(context, options.ref, "set_parameter", options.words);
    context.bound(ref_of(options.ref));
    auto const reply = context.ok(SetParameter{ref_of(options.ref), std::move(parameters)});
    wait_for(context, {{reply.command_id, "set_parameter " + options.ref}});
}

void start(Context& context) {
    auto const& options = context.options();
    run(context, one_command(options.ref, "start", arguments_of(context, options.ref, "start", options.words)));
    if (options.span) hold(context, std::chrono::steady_clock::now() + *options.span);
}

void stop(Context& context) { run(context, one_command(context.options().ref, "stop", {})); }

void resume(Context& context) { run(context, one_command(context.options().ref, "resume", {})); }

void execute(Context& context) {
    auto const& words = context.options().words;
    bool const is_file = words.size() == 1;
    if (is_file) check_file(words[0]);
    if (is_file) return run(context, read_sequence_file(context.schemas(), words[0], text_of_file(words[0])));
    std::vector<std::string> const given{words.begin() + 2, words.end()};
    run(context, one_command(words[0], words[1], arguments_of(context, words[0], words[1], given)));
}

}  // namespace rois::command
