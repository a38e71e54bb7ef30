#include "gateway/process/log.hpp"

#include <spdlog/spdlog.h>

#include <utility>

#include "engine/commands/command.hpp"
#include "gateway/process/telemetry.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

bool is_debugging() { return spdlog::should_log(spdlog::level::debug); }

spdlog::level::level_enum level_of(FaultCode code) {
    switch (code) {
        case FaultCode::not_allowed:
        case FaultCode::unauthorized:
        case FaultCode::too_many:
            return spdlog::level::info;
        default:
            return spdlog::level::debug;
    }
}

// "session 3: the command 'c-1', start of navigation"
std::string name_of(Command const& command) {
    return "session " + std::to_string(command.session_number) + ": the command " + quoted(command.id.text) + ", " +
           command.type + " of " + command.ref;
}

// Prepares a reason for a line of the log. Cutting a long reason may remove the end of a quotation: the mark that then ends it
// keeps the log from taking a client's text for a new cause.
std::string clean(std::string_view reason) {
    constexpr std::size_t longest = 200;
    auto const with_quotes = quoted(reason, longest);
    return with_quotes.substr(1, with_quotes.size() - (reason.size() > longest ? 1 : 2));
}

}  // namespace

std::uint64_t EngineLog::take_joined() { return std::exchange(joined_, 0); }

std::string_view EngineLog::token_of(std::uint64_t session) const {
    auto const found = tokens_.find(session);
    return found == tokens_.end() ? std::string_view{} : found->second;
}

void EngineLog::audit(std::string_view what, std::uint64_t session, std::string_view component, std::string_view operation,
                      std::string_view outcome) const {
    audit_({.what = what,
            .token = token_of(session),
            .session = session,
            .component = component,
            .operation = operation,
            .outcome = outcome});
}

void EngineLog::audit(std::string_view what, Command const& command, std::string_view outcome) const {
    audit(what, command.session_number, command.ref, command.type, outcome);
}

void EngineLog::session_ended(std::uint64_t session, std::string_view why) {
    sessions_.ended(session);
    audit("disconnected", session, {}, {}, why);
    tokens_.erase(session);
    spdlog::info("session {} ended: {}", session, why);
}

void EngineLog::bound(std::uint64_t session, std::string const& ref) {
    audit("bound", session, ref);
    spdlog::debug("session {} binds {}", session, ref);
}

void EngineLog::released(std::uint64_t session, std::string const& ref) {
    audit("released", session, ref);
    spdlog::debug("session {} releases {}", session, ref);
}

void EngineLog::taken_over(std::uint64_t session, std::uint64_t from, std::string const& ref) {
    audit("took over", session, ref);
    spdlog::info("session {} takes {} over from session {}", session, ref, from);
}

void EngineLog::stopped_everything(std::uint64_t session) {
    audit("stopped everything", session);
    spdlog::warn("everything is stopped, as asked by session {}", session);
}

void EngineLog::cleared_stop(std::uint64_t session, bool is_over) {
    audit(is_over ? "cleared the stop" : "cleared its own stop", session);
    spdlog::warn("session {} has cleared its stop: {}", session,
                 is_over ? "commands may start again" : "everything stays stopped, as others have asked for it");
}

void EngineLog::halt_failed(std::string const& ref, std::string_view why) {
    spdlog::error("{} may still move: {}; it is halted again until it confirms", ref, why);
}

void EngineLog::halted_at_last(std::string const& ref) {
    spdlog::warn("{} no longer counts as moving: it has confirmed its halt, or its engine is gone", ref);
}

void EngineLog::refused(std::uint64_t session, Operation const& operation, Outcome const& outcome, std::string_view ref) {
    audit("refused", session, ref, operation_name(operation), to_text(outcome.return_code));
    if (!is_debugging()) return;
    spdlog::debug("session {}: {} refused with {}: {}", session, operation_name(operation), to_text(outcome.return_code),
                  clean(outcome.reason));
}

void EngineLog::command_begun(Command const& command) {
    audit("command begun", command, {});
    if (is_debugging()) spdlog::debug("{}, begins", name_of(command));
}

void EngineLog::command_ended(Command const& command) {
    audit("command ended", command, to_text(command.status));
    if (!is_debugging()) return;
    spdlog::debug("{}, ended with {}{}{}", name_of(command), to_text(command.status), command.reason.empty() ? "" : ": ",
                  command.reason.empty() ? "" : clean(command.reason));
}

void log_joined(std::uint64_t session, std::string_view how, std::string const& peer) {
    spdlog::info("session {} {} by {}", session, how, peer);
}

void log_fault(Fault const& fault, std::string_view request, std::string const& peer) {
    spdlog::log(level_of(fault.code), "refused {} of {}: {}: {}", quoted(request), peer, to_text(fault.code),
                clean(fault.reason));
}

bool is_logged(FaultCode code) { return spdlog::should_log(level_of(code)); }

}  // namespace rois
