#include "command/context.hpp"

#include <unistd.h>

#include <algorithm>
#include <stdexcept>

#include "command/condition_text.hpp"
#include "command/input.hpp"
#include "command/request_file.hpp"
#include "command/terminal.hpp"
#include "files/files.hpp"
#include "types/listing.hpp"
#include "types/texts.hpp"
#include "xml/decoding.hpp"

namespace rois::command {

namespace {

bool coloured(Options const& options) {
    if (options.form != Form::human) return false;
    return options.colour == "always" || (options.colour == "auto" && shows_colours(STDOUT_FILENO));
}

}  // namespace

Context::Context(Options options, Signals& signals)
    : options_{std::move(options)}, signals_{signals}, printer_{options_.form, coloured(options_)} {
    if (!options_.record.empty()) recorded_ = std::make_shared<RecordingWriter>(options_.record, options_.url);
}

Context::~Context() { signals_.on_first({}); }

Session& Context::session() {
    if (!session_) {
        try {
            session_ = std::make_unique<Session>(options_, recorded_);
        } catch (std::invalid_argument const& error) {
            throw Trouble{Exit::usage, error.what()};
        } catch (NoSession const& gone) {
            printer_.fault({FaultCode::no_session, gone.what(), {}, {}}, options_.command);
            throw Trouble{Exit::fault, ""};
        }
        signals_.on_first([session = session_.get()] { session->interrupt(); });
    }
    return *session_;
}

void Context::keep_recording() {
    if (!recorded_) return;
    recorded_->keep();
    recorded_->check();
}

std::shared_ptr<xml::Schemas const> Context::schemas() {
    if (!schemas_) schemas_ = std::make_shared<xml::Schemas const>(files::schemas());
    return schemas_;
}

Reply Context::checked(Operation operation, Written written) {
    auto const name = xml::operation_names()[operation.index()];
    auto answer = session().request(std::move(operation));
    if (auto const* const fault = std::get_if<Fault>(&answer)) {
        printer_.fault(*fault, name);
        throw Trouble{Exit::fault, ""};
    }
    auto& reply = std::get<Reply>(answer);
    auto const code = std::visit([](auto const& one) { return one.return_code; }, reply);
    if (written == Written::yes || code != ReturnCode::ok) printer_.reply(reply, name);
    if (code != ReturnCode::ok) throw Trouble{exit_of(code), ""};
    return std::move(reply);
}

void Context::refuse(Reply const& reply) {
    auto const& outcome = std::visit([](auto const& one) -> Outcome const& { return one; }, reply);
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

ComponentEntry Context::component(std::string const& ref) {
    auto reply = ok(GetProfile{});
    auto const found = std::ranges::find(reply.components, ref, &ComponentEntry::ref);
    if (found != reply.components.end() && found->profile) return *found;
    refuse<GetProfile>(ReturnCode::bad_parameter, "unknown component " + rois::quoted(ref) + "; there are " +
                                                      listed(reply.components, &ComponentEntry::ref));
}

Until end_of(Options const& options) {
    if (!options.span) return std::nullopt;
    return std::chrono::steady_clock::now() + *options.span;
}

}  // namespace rois::command
