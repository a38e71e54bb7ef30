// Log lines about sessions and refused requests. Text of a client is quoted, so it cannot forge a line.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "engine/trace.hpp"
#include "gateway/process/audit.hpp"
#include "types/messages.hpp"

namespace rois {

// Sessions are logged at the level info, the rest at debug. Actions of clients also go to the audit log. Called with the engine
// locked.
class EngineLog : public Trace {
public:
    // Called with the engine locked, with the number of each session that ends, or that has returned after a restart.
    struct Sessions {
        std::function<void(std::uint64_t)> ended;
        std::function<void(std::uint64_t, Rights const*)> restored;
    };
    explicit EngineLog(Sessions sessions) : sessions_{std::move(sessions)} {}

    // Call it before the first request.
    void audit_to(Audit audit) { audit_ = std::move(audit); }
    // The session belongs to the holder of this token; empty: the client has none.
    void session_is_of(std::uint64_t session, std::string_view token) {
        if (!token.empty()) tokens_[session] = token;
    }
    std::string_view token_of(std::uint64_t session) const;

    // The number of the session that the last operation opened or resumed; 0 if it did neither.
    std::uint64_t take_joined();

private:
    void session_opened(std::uint64_t session) override { joined_ = session; }
    void session_resumed(std::uint64_t session) override { joined_ = session; }
    void session_restored(std::uint64_t session, Rights const* rights) override { sessions_.restored(session, rights); }
    void session_ended(std::uint64_t session, std::string_view why) override;
    void bound(std::uint64_t session, std::string const& ref) override;
    void released(std::uint64_t session, std::string const& ref) override;
    void taken_over(std::uint64_t session, std::uint64_t from, std::string const& ref) override;
    void stopped_everything(std::uint64_t session) override;
    void cleared_stop(std::uint64_t session, bool is_over) override;
    void halt_failed(std::string const& ref, std::string_view why) override;
    void halted_at_last(std::string const& ref) override;
    void refused(std::uint64_t session, Operation const&, Outcome const&, std::string_view ref) override;
    void command_begun(Command const&) override;
    void command_ended(Command const&) override;
    void audit(std::string_view what, std::uint64_t session, std::string_view component = {}, std::string_view operation = {},
               std::string_view outcome = {}) const;
    void audit(std::string_view what, Command const&, std::string_view outcome) const;

    Audit audit_ = [](AuditEntry const&) {};
    std::unordered_map<std::uint64_t, std::string> tokens_;  // by the session's number
    Sessions sessions_;
    std::uint64_t joined_ = 0;
};

// A client opened or resumed a session: `how` is "opened over HTTP", for example; `peer` is its address.
void log_joined(std::uint64_t session, std::string_view how, std::string const& peer);

// A request was refused with a fault: at the level info if the gateway does not let the client in, otherwise at debug. `request`
// is the request line or the operation.
void log_fault(Fault const&, std::string_view request, std::string const& peer);
// Whether log_fault would write a line about it.
bool is_logged(FaultCode);

}  // namespace rois
