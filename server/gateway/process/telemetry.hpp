// Counts events of the gateway for /metrics. Counting is thread-safe and lock-free.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "engine/engine.hpp"
#include "types/engine_state.hpp"
#include "types/instant.hpp"
#include "types/messages.hpp"
#include "xml/codec/codec.hpp"

namespace rois {

class LogQueue;

// "bind_any", for example.
std::string_view operation_name(Operation const&);

class Telemetry {
public:
    enum class Kind : std::uint8_t { http, websocket, stream };  // of a connection

    // Counts a connection of this kind as long as it lives.
    class Counted {
    public:
        Counted(Telemetry& telemetry, Kind kind) : open_{telemetry.open_[static_cast<std::size_t>(kind)]} { ++open_; }
        ~Counted() { --open_; }
        Counted(Counted const&) = delete;
        Counted& operator=(Counted const&) = delete;

    private:
        std::atomic<std::uint64_t>& open_;
    };

    // Connections that are open now.
    std::uint64_t connections() const { return open_[0] + open_[1] + open_[2]; }

    void accepted() { ++accepted_; }
    // `spent`: from the request's last byte until the answer's text was ready.
    void answered(Operation const&, ReturnCode, std::chrono::nanoseconds spent);
    void checked(xml::Validation way) { ++checked_[static_cast<std::size_t>(way)]; }  // a request document
    void faulted(FaultCode code) { ++faults_[static_cast<std::size_t>(code)]; }
    void delivered(std::size_t notifications) { delivered_ += notifications; }
    void handshake_failed() { ++handshakes_failed_; }  // of TLS
    void cut() { ++cut_; }                             // a connection that was closed because its peer read too slowly
    // Limits of the network layer: their values, and how often each was reached.
    enum class Limit : std::uint8_t {
        connections,  // reached: no connection was accepted until another one closed
        connections_per_address,
        sessions_per_address,
        sessions_per_connection,
        streams_per_session
    };
    void set(Limit limit, std::size_t most) { limits_[static_cast<std::size_t>(limit)].most = most; }
    void reached(Limit limit) { ++limits_[static_cast<std::size_t>(limit)].reached; }

    // The place from which a survived exception escaped.
    enum class Where : std::uint8_t { tick, sweep, accept, wake, loop, connection };
    void survived(Where where) { ++survived_[static_cast<std::size_t>(where)]; }

    // Reports a finished tick. Any thread may ask for its age, also while the engine is locked.
    void ticked(Steady now) { last_tick_.store(now, std::memory_order_relaxed); }
    std::chrono::nanoseconds age_of_last_tick(Steady now) const {
        return now - std::min(now, last_tick_.load(std::memory_order_relaxed));
    }

    // Shows the lines that this queue has dropped. Call it before the first `text`.
    void show(std::shared_ptr<LogQueue const> log) { log_ = std::move(log); }
    // The gateway has read its files again after SIGHUP: with success, or one of them was not valid.
    void reloaded(bool all) { ++(all ? reloads_ : refused_reloads_); }

    // Shows when the gateway's certificate expires.
    void certificate_expires(std::chrono::system_clock::time_point at) { certificate_expires_ = at; }

    // Shows what the journal has done. Call it before the first `text`.
    struct JournalNumbers {
        std::uint64_t stored = 0;      // how often changes were stored
        std::uint64_t not_stored = 0;  // how often they could not be
        bool has_room = true;
    };
    void show_journal(std::function<JournalNumbers()> numbers) { journal_ = std::move(numbers); }

    // Shows how many lines of the audit log were lost. Call it before the first `text`.
    void show_audit(std::function<std::uint64_t()> lost) { lost_of_audit_ = std::move(lost); }
    // The number of lines that this queue has dropped.
    std::uint64_t dropped_log_lines() const;

    // The Prometheus text format.
    std::string text(EngineStatistics const&, std::vector<EngineState> const& sub_engines) const;

private:
    static constexpr std::size_t operations = std::variant_size_v<Operation>;
    static constexpr std::size_t return_codes = 6;
    static constexpr std::size_t fault_codes = 17;
    static constexpr std::array<double, 8> bounds{0.00005, 0.0001, 0.00025, 0.0005, 0.001, 0.005, 0.025, 0.1};  // seconds

    friend class Exposition;
    std::array<std::array<std::atomic<std::uint64_t>, return_codes>, operations> requests_{};
    std::array<std::atomic<std::uint64_t>, fault_codes> faults_{};
    std::array<std::atomic<std::uint64_t>, 2> checked_{};
    std::array<std::atomic<std::uint64_t>, bounds.size() + 1> durations_{};
    std::atomic<std::uint64_t> nanoseconds_ = 0;
    std::array<std::atomic<std::uint64_t>, 3> open_{};
    std::atomic<std::uint64_t> accepted_ = 0;
    std::atomic<std::uint64_t> handshakes_failed_ = 0;
    std::atomic<std::uint64_t> delivered_ = 0;
    std::atomic<std::uint64_t> cut_ = 0;
    std::array<std::atomic<std::uint64_t>, 6> survived_{};
    std::atomic<Steady> last_tick_{Steady{}};
    std::shared_ptr<LogQueue const> log_;  // null: none is shown
    std::atomic<std::uint64_t> reloads_ = 0;
    std::atomic<std::uint64_t> refused_reloads_ = 0;
    std::atomic<std::chrono::system_clock::time_point> certificate_expires_{};  // the epoch: there is no certificate
    std::function<JournalNumbers()> journal_;                                   // empty: there is no journal
    std::function<std::uint64_t()> lost_of_audit_;                              // empty: there is no audit log
    struct Reached {
        std::atomic<std::size_t> most = 0;
        std::atomic<std::uint64_t> reached = 0;
    };
    std::array<Reached, 5> limits_{};
};

// "tick", for example.
std::string_view name_of(Telemetry::Where);

}  // namespace rois
