#include "gateway/process/telemetry.hpp"

#include <dirent.h>
#include <prometheus/text_serializer.h>
#include <sys/resource.h>

#include <algorithm>
#include <sstream>

#include "gateway/process/log_queue.hpp"
#include "gateway/process/memory.hpp"

namespace rois {

namespace {

using prometheus::ClientMetric;
using prometheus::MetricFamily;
using prometheus::MetricType;

constexpr std::array<char const*, 19> operation_names{"connect",
                                                      "resume",
                                                      "disconnect",
                                                      "get_profile",
                                                      "get_error_detail",
                                                      "search",
                                                      "bind",
                                                      "bind_any",
                                                      "release",
                                                      "get_parameter",
                                                      "set_parameter",
                                                      "execute",
                                                      "get_command_result",
                                                      "query",
                                                      "subscribe",
                                                      "unsubscribe",
                                                      "get_event_detail",
                                                      "stop_everything",
                                                      "clear_stop"};
static_assert(operation_names.size() == std::variant_size_v<Operation>);

constexpr std::array<char const*, 3> kind_names{"http", "websocket", "stream"};
constexpr std::array<char const*, 2> way_names{"fast", "full"};
constexpr std::array<char const*, 5> limit_names{"connections", "connections_per_address", "sessions_per_address",
                                                 "sessions_per_connection", "streams_per_session"};

constexpr std::array<char const*, 6> where_names{"tick", "sweep", "accept", "wake", "loop", "connection"};

double cpu_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    auto const seconds = [](timeval const& t) { return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) / 1e6; };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Does not use std::filesystem, which ends the process if there is no memory.
double open_descriptors() {
    auto* const folder = ::opendir("/proc/self/fd");
    if (folder == nullptr) return 0;
    int entries = 0;
    while (::readdir(folder) != nullptr) ++entries;
    ::closedir(folder);
    return std::max(0, entries - 3);  // without ".", ".." and the folder itself
}

}  // namespace

std::string_view operation_name(Operation const& operation) { return operation_names.at(operation.index()); }

std::string_view name_of(Telemetry::Where where) { return where_names.at(static_cast<std::size_t>(where)); }

// The families of one scrape.
class Exposition {
public:
    std::string text() const {
        std::ostringstream out;
        prometheus::TextSerializer{}.Serialize(out, families_);
        return out.str();
    }

    void gauge(std::string name, std::string help, double value) {
        begin(std::move(name), std::move(help), MetricType::Gauge);
        add({}, value);
    }
    void counter(std::string name, std::string help, double value) {
        begin(std::move(name), std::move(help), MetricType::Counter);
        add({}, value);
    }

    void process() {
        gauge("process_resident_memory_bytes", "Resident memory of the process.", static_cast<double>(resident_bytes()));
        gauge("process_open_fds", "Open file descriptors.", open_descriptors());
        counter("process_cpu_seconds_total", "User and system CPU time of the process.", cpu_seconds());
    }

    void engine(EngineStatistics const& s) {
        auto const number = [](auto n) { return static_cast<double>(n); };
        gauge("rois_sessions", "Open sessions.", number(s.sessions));
        counter("rois_sessions_replaced_total", "Idle sessions that ended because a new one needed their place.",
                number(s.sessions_replaced));
        gauge("rois_components", "Components of the engine.", number(s.components));
        gauge("rois_subscriptions", "Distinct event types with conditions that are subscribed to.", number(s.subscriptions));
        counter("rois_events_total", "Events that components fired.", number(s.events));
        counter("rois_errors_total", "Errors that were notified.", number(s.errors));
        counter("rois_notifications_total", "Notifications queued for sessions.", number(s.notifications));
        counter("rois_notifications_lost_total", "Notifications dropped because a session did not read.",
                number(s.notifications_lost));
        counter("rois_stray_component_answers_total",
                "Answers of components that came late or twice, or that no call had asked for.", number(s.stray_answers));
        gauge("rois_everything_stopped", "1 while nothing starts because everything was stopped (POST /rois/stop).",
              s.everything_is_stopped ? 1 : 0);
        gauge("rois_components_not_halted", "Components that have not confirmed the last call to halt.", number(s.not_halted));
        if (s.memory_budget != 0) {
            gauge("rois_memory_budget_bytes", "Memory that the process may use.", number(s.memory_budget));
            gauge("rois_memory_used_bytes", "Memory in use, and memory reserved for documents that are being read.",
                  number(s.memory_used));
        }
        begin("rois_commands_completed_total", "Commands by how they ended.", MetricType::Counter);
        for (std::size_t i = 0; i < std::size(s.commands_completed); ++i) {
            add({{"status", std::string{to_text(static_cast<CompletedStatus>(i))}}}, number(s.commands_completed[i]));
        }
    }

    // A series for each session, by its number.
    void sessions(std::vector<SessionStatistics> const& all) {
        auto const now = std::chrono::steady_clock::now();
        auto const age = [&](auto const& s) { return std::chrono::duration<double>(now - s.connected).count(); };
        each("rois_session_age_seconds", "Age of a session; sessions are numbered in the order of connecting.", all, age);
        each("rois_session_commands", "Commands of a session that wait or run.", all, &SessionStatistics::commands);
        each("rois_session_subscriptions", "Distinct event types with conditions that a session has subscribed to.", all,
             &SessionStatistics::subscriptions);
        each("rois_session_notifications_waiting", "Notifications that a session has not read.", all,
             &SessionStatistics::waiting_notifications);
        begin("rois_component_bound", "1 for a component that a session has bound.", MetricType::Gauge);
        for (auto const& session : all)
            for (auto const& ref : session.bound) add({{"component_ref", ref}, {"session", std::to_string(session.number)}}, 1);
    }

    void limits(std::vector<LimitStatistics> all, Telemetry const& t) {
        for (std::size_t i = 0; i < limit_names.size(); ++i)
            all.push_back({limit_names[i], t.limits_[i].most, t.limits_[i].reached});
        begin("rois_limit", "The limit.", MetricType::Gauge);
        for (auto const& limit : all) add({{"limit", std::string{limit.of}}}, static_cast<double>(limit.most));
        begin("rois_limit_reached_total", "How often something was refused, dropped, ended or had to wait because of a limit.",
              MetricType::Counter);
        for (auto const& limit : all) add({{"limit", std::string{limit.of}}}, static_cast<double>(limit.reached));
    }

    void sub_engines(std::vector<EngineState> const& all) {
        auto const add_each = [&](std::string name, std::string help, MetricType type, auto value) {
            begin(std::move(name), std::move(help), type);
            for (auto const& each : all) add({{"engine", each.name}}, static_cast<double>(value(each)));
        };
        add_each("rois_engine_present", "1 for a sub engine whose components can be used.", MetricType::Gauge,
                 [](auto const& engine) { return engine.is == EngineState::Is::present; });
        add_each("rois_engine_components", "Components of a sub engine.", MetricType::Gauge,
                 [](auto const& engine) { return engine.components; });
        add_each("rois_engine_losses_total", "How often the link to a sub engine was lost.", MetricType::Counter,
                 [](auto const& engine) { return engine.losses; });
        begin("rois_engine_round_trip_seconds", "Time of a short request to a sub engine.", MetricType::Gauge);
        for (auto const& each : all)
            if (each.round_trip) add({{"engine", each.name}}, std::chrono::duration<double>(*each.round_trip).count());
    }

    void network(Telemetry const& t) {
        begin("rois_connections", "Open connections by what they are used for.", MetricType::Gauge);
        for (std::size_t i = 0; i < kind_names.size(); ++i) add({{"kind", kind_names[i]}}, static_cast<double>(t.open_[i]));
        counter("rois_connections_accepted_total", "Connections accepted.", static_cast<double>(t.accepted_));
        counter("rois_connections_cut_total", "Connections closed because their reader was too slow.",
                static_cast<double>(t.cut_));
        counter("rois_handshakes_failed_total", "TLS handshakes that failed or took too long.",
                static_cast<double>(t.handshakes_failed_));
        begin("rois_certificate_expiry_timestamp_seconds", "When the gateway's certificate expires, in seconds since 1970.",
              MetricType::Gauge);
        if (auto const expires = t.certificate_expires_.load().time_since_epoch(); expires.count() != 0)
            add({}, std::chrono::duration<double>(expires).count());
        counter("rois_notifications_delivered_total", "Notifications written to connections.", static_cast<double>(t.delivered_));
        begin("rois_faults_total", "Messages that could not be read or were not allowed.", MetricType::Counter);
        for (std::size_t i = 0; i < Telemetry::fault_codes; ++i) {
            add({{"code", std::string{to_text(static_cast<FaultCode>(i))}}}, static_cast<double>(t.faults_[i]));
        }
        begin("rois_documents_checked_total", "Request documents by how they were checked: by the tables alone, or in full.",
              MetricType::Counter);
        for (std::size_t i = 0; i < way_names.size(); ++i)
            add({{"validation", way_names[i]}}, static_cast<double>(t.checked_[i]));
        requests(t);
        durations(t);
        survived(t);
    }

    void survived(Telemetry const& t) {
        begin("rois_internal_exceptions_total", "Exceptions that the gateway survived, by where they escaped.",
              MetricType::Counter);
        for (std::size_t i = 0; i < where_names.size(); ++i)
            add({{"where", where_names[i]}}, static_cast<double>(t.survived_[i]));
        auto const age = t.age_of_last_tick(std::chrono::steady_clock::now());
        gauge("rois_last_tick_age_seconds", "Time since the last tick of the engine.",
              std::chrono::duration<double>(age).count());
        counter("rois_audit_lines_lost_total", "Lines of the audit log that could not be written.",
                t.lost_of_audit_ ? static_cast<double>(t.lost_of_audit_()) : 0);
        begin("rois_reloads_total", "How often the files were read again after SIGHUP, by what happened.", MetricType::Counter);
        add({{"outcome", "done"}}, static_cast<double>(t.reloads_));
        add({{"outcome", "refused"}}, static_cast<double>(t.refused_reloads_));
        journal(t);
        if (!t.log_) return;
        counter("rois_log_lines_dropped_total", "Lines of the log that could not be written.",
                static_cast<double>(t.log_->dropped()));
        counter("rois_log_lines_left_out_total", "Lines of the log above the limit of lines that are alike.",
                static_cast<double>(t.log_->left_out()));
    }

private:
    void journal(Telemetry const& t) {
        auto const numbers = t.journal_ ? t.journal_() : Telemetry::JournalNumbers{};
        counter("rois_journal_stored_total", "How often changes were stored in the journal.",
                static_cast<double>(numbers.stored));
        counter("rois_journal_failures_total", "How often changes could not be stored in the journal.",
                static_cast<double>(numbers.not_stored));
        gauge("rois_journal_has_room", "1 if the journal has room, so that commands may begin.", numbers.has_room);
    }

    void begin(std::string name, std::string help, MetricType type) {
        families_.push_back({std::move(name), std::move(help), type, {}});
    }

    template <class Value>
    void each(std::string name, std::string help, std::vector<SessionStatistics> const& all, Value value) {
        begin(std::move(name), std::move(help), MetricType::Gauge);
        for (auto const& session : all)
            add({{"session", std::to_string(session.number)}}, static_cast<double>(std::invoke(value, session)));
    }

    void add(std::vector<ClientMetric::Label> labels, double value) {
        ClientMetric metric;
        metric.label = std::move(labels);
        (families_.back().type == MetricType::Gauge ? metric.gauge.value : metric.counter.value) = value;
        families_.back().metric.push_back(std::move(metric));
    }

    // Shows OK always, and the other return codes after they have occurred.
    void requests(Telemetry const& t) {
        begin("rois_requests_total", "Operations performed, by return code.", MetricType::Counter);
        for (std::size_t operation = 0; operation < Telemetry::operations; ++operation) {
            for (std::size_t code = 0; code < Telemetry::return_codes; ++code) {
                auto const count = t.requests_[operation][code].load();
                if (count == 0 && code != 0) continue;
                add({{"operation", operation_names[operation]},
                     {"return_code", std::string{to_text(static_cast<ReturnCode>(code))}}},
                    static_cast<double>(count));
            }
        }
    }

    void durations(Telemetry const& t) {
        begin("rois_request_duration_seconds", "From a request's last byte until its answer is ready.", MetricType::Histogram);
        ClientMetric metric;
        std::uint64_t cumulative = 0;
        for (std::size_t i = 0; i < Telemetry::bounds.size(); ++i) {
            cumulative += t.durations_[i];
            metric.histogram.bucket.push_back({cumulative, Telemetry::bounds[i]});
        }
        metric.histogram.sample_count = cumulative + t.durations_.back();
        metric.histogram.sample_sum = static_cast<double>(t.nanoseconds_) / 1e9;
        families_.back().metric.push_back(std::move(metric));
    }

    std::vector<MetricFamily> families_;
};

std::uint64_t Telemetry::dropped_log_lines() const { return log_ ? log_->dropped() : 0; }

void Telemetry::answered(Operation const& operation, ReturnCode code, std::chrono::nanoseconds spent) {
    ++requests_[operation.index()][static_cast<std::size_t>(code)];
    auto const seconds = std::chrono::duration<double>(spent).count();
    ++durations_[static_cast<std::size_t>(std::ranges::lower_bound(bounds, seconds) - bounds.begin())];
    nanoseconds_ += static_cast<std::uint64_t>(spent.count());
}

std::string Telemetry::text(EngineStatistics const& statistics, std::vector<EngineState> const& sub_engines) const {
    Exposition exposition;
    exposition.network(*this);
    exposition.engine(statistics);
    exposition.sessions(statistics.each_session);
    exposition.sub_engines(sub_engines);
    exposition.limits(statistics.limits, *this);
    exposition.process();
    return exposition.text();
}

}  // namespace rois
