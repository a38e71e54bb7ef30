#include "command/context.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "command/input/condition_text.hpp"
#include "command/input/input.hpp"
#include "command/input/request_file.hpp"
#include "command/output/terminal.hpp"
#include "files/files.hpp"
#include "types/asking.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"
#include "xml/codec/decoding.hpp"

namespace rois::command {

namespace {

bool coloured(Options const& options) { return options.form == Form::human && shows_colours(options.colour, STDOUT_FILENO); }

}  // namespace

Context::Context(Options options, Signals& signals, Caller const& caller, Background* background)
    : options_{std::move(options)},
      signals_{signals},
      caller_{caller},
      background_{background},
      printer_{options_.form, coloured(options_)} {
    if (background_ != nullptr) take_session_file();
    if (!options_.record.empty()) recorded_ = std::make_shared<RecordingWriter>(options_.record, options_.url);
}

Context::~Context() { signals_.on_first({}); }

// Locks the session file for a new session. If another process holds a session under it, joins that one.
void Context::take_session_file() {
    while (!(session_file_ = SessionFile::lock(options_.session_file))) {
        auto const held = find_held_session(options_.session_file, options_.deadline);
        if (!held) continue;
        if (!options_.record.empty()) throw Trouble{Exit::usage, "--record: this command opens no session to record"};
        join(options_, *held);
        return;
    }
    options_.session.clear();
    options_.held.reset();
}

Session& Context::session() {
    if (session_) return *session_;
    while (!session_) {
        leave_no_file_if_interrupted();
        try {
            session_ = std::make_unique<Session>(options_, recorded_, caller_);
        } catch (std::invalid_argument const& error) {
            throw Trouble{Exit::usage, error.what()};
        } catch (NoSession const& gone) {
            replace_lost_session(gone);
        }
    }
    signals_.on_first([session = session_.get()] { session->interrupt(); });
    end_left_session();
    return *session_;
}

// Until a session is open, a signal removes the file and ends the program at once.
void Context::leave_no_file_if_interrupted() {
    if (!session_file_) return;
    signals_.on_first([file = session_file_.get()] {
        file->remove();
        _exit(static_cast<int>(Exit::interrupted));
    });
}

void Context::begin_again(NoSession const& gone) {
    signals_.on_first({});
    session_.reset();
    replace_lost_session(gone);
}

// The engine does not know the session to join. If it is from the session file, its holder has lost it without noticing, for
// example after a restart of the engine: `bind` ends that holder and replaces it.
void Context::replace_lost_session(NoSession const& gone) {
    auto const& held = options_.held;
    if (!held) {
        printer_.fault({FaultCode::no_session, gone.what()}, options_.command);
        throw Trouble{Exit::fault, ""};
    }
    if (background_ == nullptr) throw no_holder(options_.session_file);
    end_holder(options_.session_file, held->holder, options_.deadline);
    take_session_file();
}

// Ends the session of a holder that was killed. Otherwise the session would keep its components bound until its timeout.
void Context::end_left_session() {
    if (!session_file_ || !session_file_->left()) return;
    auto const& held = *session_file_->left();
    auto options = options_;
    options.url = held.url;
    options.session = held.session;
    options.span.reset();
    try {
        Session left{options, nullptr, caller_};
        left.request(Disconnect{});
    } catch (Trouble const& trouble) {
        bool const has_ended = dynamic_cast<NoSession const*>(&trouble) != nullptr;
        if (!has_ended)
            remark("the session that a killed process left at " + held.url + " could not be ended: " + trouble.what());
    }
}

void Context::keep_recording() {
    if (!recorded_) return;
    recorded_->keep();
    recorded_->check();
}

void Context::go_to_background() {
    if (!session_file_) return;
    session_file_->write(options_.url, session().id().text);
    background_->ready();
}

std::shared_ptr<xml::Schemas const> Context::schemas() {
    if (!schemas_) schemas_ = std::make_shared<xml::Schemas const>(files::schemas());
    return schemas_;
}

Reply Context::checked(Operation operation, Written written, std::function<std::string()> const& hint) {
    auto const name = xml::operation_names()[operation.index()];
    auto answer = session().request(std::move(operation));
    if (auto const* const fault = std::get_if<Fault>(&answer)) {
        printer_.fault(*fault, name);
        throw Trouble{Exit::fault, ""};
    }
    auto& reply = std::get<Reply>(answer);
    auto& outcome = std::visit([](auto& one) -> Outcome& { return one; }, reply);
    auto const code = outcome.return_code;
    if (code != ReturnCode::ok && hint) outcome.reason += hint();
    if (written == Written::yes || code != ReturnCode::ok) printer_.reply(reply, name);
    if (code != ReturnCode::ok) throw Trouble{exit_of(code), ""};
    return std::move(reply);
}

void Context::refuse(Reply const& reply) {
    auto const& outcome = outcome_of(reply);
    if (printer_.form() == Form::human) throw Trouble{exit_of(outcome.return_code), outcome.reason};
    printer_.reply(reply, xml::operation_names()[reply.index()]);
    throw Trouble{exit_of(outcome.return_code), ""};
}

QueryExpression Context::condition() {
    if (!options_.condition_file.empty())
        return read_condition_file(schemas(), options_.condition_file, text_of_file(options_.condition_file));
    try {
        return read_condition(options_.where);
    } catch (BadCondition const& bad) {
        auto const blanks = width_of(std::string_view{options_.where}.substr(0, bad.at()));
        throw Trouble{Exit::usage, "the condition cannot be read: " + std::string{bad.what()} + "\n  " +
                                       harmless(options_.where) + "\n  " + std::string(blanks, ' ') + "^"};
    }
}

std::vector<ComponentEntry> Context::components(QueryExpression condition) {
    auto answer = session().request(GetProfile{std::move(condition)});
    auto* const reply = std::get_if<Reply>(&answer);
    auto* const profile = reply != nullptr ? std::get_if<GetProfile::Reply>(reply) : nullptr;
    return profile != nullptr ? std::move(profile->components) : std::vector<ComponentEntry>{};
}

Bind::Reply Context::bound(Identifier component) {
    // In a shared session, another bind would replace the `switching` of the present binding.
    if (session().is_joined() && !options_.switching && owns(component)) return {};
    auto const ref = component.code;
    return ok(Bind{std::move(component), options_.switching.value_or(Switching::none), options_.take_over},
              [&] { return hint_for_component(ref); });
}

bool Context::owns(Identifier const& component) {
    auto const answer = session().request(GetParameter{component});  // the engine answers it only to the owner
    auto const* const reply = std::get_if<Reply>(&answer);
    auto const* const parameters = reply != nullptr ? std::get_if<GetParameter::Reply>(reply) : nullptr;
    return parameters != nullptr && parameters->return_code == ReturnCode::ok;
}

std::string Context::hint_for_component(std::string const& ref) {
    auto const there = components();
    if (std::ranges::find(there, ref, &ComponentEntry::ref) != there.end()) return {};
    return "; there are " + listed(there, &ComponentEntry::ref);
}

ComponentEntry Context::component(std::string const& ref) {
    auto reply = ok(GetProfile{});
    auto const find_in = [&](std::vector<ComponentEntry> const& there) -> std::optional<ComponentEntry> {
        auto const found = std::ranges::find(there, ref, &ComponentEntry::ref);
        return found != there.end() && found->profile ? std::optional{*found} : std::nullopt;
    };
    if (auto const found = find_in(reply.components)) return *found;
    // Members of logical components are only shown to those who ask for them.
    if (auto const member = find_in(components(is_component(ref)))) return *member;
    refuse<GetProfile>(ReturnCode::bad_parameter, "unknown component " + rois::quoted(ref) + "; there are " +
                                                      listed(reply.components, &ComponentEntry::ref));
}

std::vector<std::string> message_names(std::vector<ComponentEntry> const& components, MessageKind kind) {
    std::vector<std::string> names;
    for (auto const& component : components) {
        if (!component.profile) continue;
        for (auto const& message : component.profile->messages)
            if (message.kind == kind && std::ranges::find(names, message.name) == names.end()) names.push_back(message.name);
    }
    return names;
}

std::string components_and_types(std::vector<ComponentEntry> const& components) {
    return listed(components, [](ComponentEntry const& entry) {
        return entry.ref + " (" + entry.type.substr(entry.type.rfind(':') + 1) + ")";
    });
}

void report_error(Context& context, News const& news) {
    context.printer().notification(news.notification, news.sequence);
    explain(context, std::get<ReceiveError>(news.notification));
}

void explain(Context& context, ReceiveError const& error) {
    auto const answer = context.session().request(GetErrorDetail{error.error_id, {}});
    auto const* const reply = std::get_if<Reply>(&answer);
    auto const* const details = reply != nullptr ? std::get_if<GetErrorDetail::Reply>(reply) : nullptr;
    auto const* const text = details != nullptr ? find(details->results.parameters, "text") : nullptr;
    if (text == nullptr || text->values.empty()) return;
    auto const& words = text->values.front();
    auto const ref = error.component_ref ? error.component_ref->code : std::string{};
    bool const is_held = !ref.empty() && words.starts_with("its motion is held");
    bool const is_shared = context.session().is_joined() || context.options().command == "bind";
    std::string hint;
    if (is_held) hint = is_shared ? ": rois resume " + ref : "; interrupt this command and run it again";
    remark((ref.empty() ? "" : harmless(ref) + ": ") + harmless(words) + hint);
}

void remark(std::string const& text) { std::fprintf(stderr, "rois: %s\n", text.c_str()); }

Until end_of(Options const& options) {
    if (!options.span) return std::nullopt;
    return options.started + *options.span;
}

}  // namespace rois::command
