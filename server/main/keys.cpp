#include "main/keys.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <thread>

#include "gateway/access/host_names.hpp"
#include "main/engines_file.hpp"
#include "main/key_kinds.hpp"
#include "types/text/address.hpp"
#include "types/text/texts.hpp"
#include "types/text/to_number.hpp"

namespace rois {

namespace {

bool set_listen(GatewaySettings& settings, std::string const& text) {
    auto const read = read_host_and_port(text);
    if (!read) return false;
    settings.net.host = read->host;
    settings.net.port = read->port;
    return true;
}

std::string show_listen(GatewaySettings const& settings) { return host_and_port(settings.net.host, settings.net.port); }

bool set_media(GatewaySettings& settings, std::string const& text) {
    auto const read = text.empty() ? std::optional{HostAndPort{}} : read_host_and_port(text);
    if (!read) return false;
    settings.media.host = read->host;
    settings.media.port = read->port;
    return true;
}

std::string show_media(GatewaySettings const& settings) {
    return settings.media.host.empty() ? "" : host_and_port(settings.media.host, settings.media.port);
}

// URL at which a reverse proxy serves the media. The paths of streams are appended to it.
bool set_media_url(GatewaySettings& settings, std::string const& text) {
    bool const is_url = (text.starts_with("http://") && text.size() > 7) || (text.starts_with("https://") && text.size() > 8);
    if (!text.empty() && (!is_url || text.find_first_of(" \t\r\n?#\"<>") != std::string::npos)) return false;
    settings.media.url = text;
    return true;
}

bool set_join(GatewaySettings& settings, std::string const& text) {
    if (!text.empty() && !is_gateway_url(text)) return false;
    settings.join = text;
    return true;
}

// The engine's name becomes a part of XML ids.
bool set_engine_name(GatewaySettings& settings, std::string const& text) {
    auto const is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    auto const fits = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '-' || c == '.'; };
    if (text.empty() || text.size() > 64 || !is_letter(text.front()) || !std::ranges::all_of(text, fits)) return false;
    settings.engine_name = text;
    return true;
}

// Origins as browsers send them, "http://console.example:8081": lower case, no path, no default port.
bool is_origin(std::string const& text) {
    auto const after = text.find("://");
    if (after == std::string::npos || after == 0) return false;
    auto const host = text.substr(after + 3);
    auto const colon = host.ends_with(']') ? std::string::npos : host.rfind(':');
    if (colon != std::string::npos && to_number<std::uint16_t>(host.substr(colon + 1)).value_or(0) == 0) return false;
    auto const fits = [](char c) { return c > ' ' && c < 0x7F && (c < 'A' || c > 'Z'); };
    if (host.empty() || host.find_first_of("/?#@,\"<>") != std::string::npos || !std::ranges::all_of(text, fits)) return false;
    bool const default_port =
        (text.starts_with("http://") && host.ends_with(":80")) || (text.starts_with("https://") && host.ends_with(":443"));
    return !default_port;
}

// Splits a text at spaces.
std::vector<std::string> words_of(std::string const& text) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin < text.size();) {
        auto const end = std::min(text.find(' ', begin), text.size());
        if (end > begin) words.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

std::string joined(std::vector<std::string> const& words) {
    std::string text;
    for (auto const& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

bool set_origins(GatewaySettings& settings, std::string const& text) {
    auto origins = words_of(text);
    if (!std::ranges::all_of(origins, is_origin)) return false;
    settings.net.allowed_origins = std::move(origins);
    return true;
}

bool set_proxies(GatewaySettings& settings, std::string const& text) {
    std::vector<Network> proxies;
    for (auto const& word : words_of(text)) {
        auto const network = read_network(word);
        if (!network) return false;
        proxies.push_back(*network);
    }
    settings.net.proxies = std::move(proxies);
    return true;
}

std::string show_proxies(GatewaySettings const& settings) {
    std::vector<std::string> words;
    words.reserve(settings.net.proxies.size());
    for (auto const& network : settings.net.proxies) words.push_back(text_of(network));
    return joined(words);
}

bool set_hosts(GatewaySettings& settings, std::string const& text) {
    std::vector<std::string> hosts;
    for (auto const& word : words_of(text)) {
        auto host = host_name(word);
        if (!host) return false;
        hosts.push_back(std::move(*host));
    }
    settings.net.hosts = std::move(hosts);
    return true;
}

struct SizeUnit {
    std::string_view name;
    std::size_t bytes;
};
constexpr std::array<SizeUnit, 4> size_units{
    {{"GiB", std::size_t{1} << 30}, {"MiB", std::size_t{1} << 20}, {"KiB", std::size_t{1} << 10}, {"", 1}}};

bool set_memory_budget(GatewaySettings& settings, std::string const& text) {
    constexpr std::size_t least = std::size_t{64} << 20, most = std::size_t{1024} << 30;
    std::size_t number = 0;
    auto const* const whole = text.data() + text.size();
    auto const [end, error] = std::from_chars(text.data(), whole, number);
    auto const unit =
        std::ranges::find(size_units, std::string_view{end, static_cast<std::size_t>(whole - end)}, &SizeUnit::name);
    if (error != std::errc{} || unit == size_units.end() || number > most / unit->bytes) return false;
    if (number * unit->bytes < least) return false;
    settings.net.memory_budget = number * unit->bytes;
    return true;
}

std::string show_memory_budget(GatewaySettings const& settings) {
    auto const bytes = settings.net.memory_budget;
    auto const unit = std::ranges::find_if(size_units, [&](SizeUnit const& each) { return bytes % each.bytes == 0; });
    return std::to_string(bytes / unit->bytes) + std::string{unit->name};
}

bool set_sim_speed(GatewaySettings& settings, std::string const& text) {
    auto const speed = number_within(text, 0, 1'000);
    if (speed && *speed > 0 && *speed < 0.01) return false;
    if (speed) settings.sim_speed = *speed;
    return speed.has_value();
}

std::vector<Key> general_keys() {
    return {
        {"listen", "address and port to listen on; port 0: any free port", "HOST:PORT",
         "HOST:PORT, such as 127.0.0.1:8080, [::1]:8080, or 0.0.0.0:8080 for every address of this machine", Key::Kind::text,
         set_listen, show_listen},
        whole_number<std::size_t>(
            "threads", "number of I/O threads", [](GatewaySettings & s) -> auto& { return s.net.threads; }, 1, 256),
        choice<LogFormat>("log_format", "format of the log", [](GatewaySettings & s) -> auto& { return s.log_format; },
                          {{"text", LogFormat::text}, {"json", LogFormat::json}}),
        choice<LogLevel>(
            "log_level", "lowest level that is logged", [](GatewaySettings & s) -> auto& { return s.log_level; },
            {{"debug", LogLevel::debug}, {"info", LogLevel::info}, {"warning", LogLevel::warning}, {"error", LogLevel::error}}),
        {"engine_name", "name of the engine in its profile", "NAME",
         "a letter, then letters, digits, '-', '_' and '.', 64 at most", Key::Kind::text, set_engine_name,
         [](GatewaySettings const& s) { return s.engine_name; }},
        {"sim_speed", "simulated seconds per second; 0: simulated time stands still until simulated_hall lets it pass", "X",
         range("0, or a number", 0.01, 1'000), Key::Kind::number, set_sim_speed,
         [](GatewaySettings const& s) { return text_of(s.sim_speed); }},
        choice<Robots>("robots", "simulated: the components of the simulated robots; none: only those of sub engines",
                       [](GatewaySettings & s) -> auto& { return s.robots; },
                       {{"simulated", Robots::simulated}, {"none", Robots::none}}),
        choice<Steering>("steering",
                         "offer the component simulated_hall, with which applications steer visitors; always on with sim_speed 0",
                         [](GatewaySettings & s) -> auto& { return s.steering; }, {{"off", Steering::off}, {"on", Steering::on}}),
        whole_number<std::uint64_t>(
            "seed", "seed of the simulation's random numbers; the same seed gives the same history",
            [](GatewaySettings & s) -> auto& { return s.seed; }, 0, 9'007'199'254'740'991),
        file(
            "floor_plan", "floor plan of the simulated hall; empty: the built-in one",
            [](GatewaySettings & s) -> auto& { return s.floor_plan; }),
        file(
            "scenario", "file of the visitors who come to the hall, and when; empty: the built-in one",
            [](GatewaySettings & s) -> auto& { return s.scenario; }),
        {"profiles", "folder of component profiles to make components from, read again after SIGHUP; empty: none", "DIR",
         "a text", Key::Kind::text, [](GatewaySettings& s, std::string const& text) { return s.profiles = text, true; },
         [](GatewaySettings const& s) { return s.profiles; }},
        file(
            "engines", "file of sub engines, read again after SIGHUP; empty: none",
            [](GatewaySettings & s) -> auto& { return s.engines; }),
        {"join", "gateway to join as a sub engine; empty: none", "URL", "a URL such as ws://main.example:8080, or empty",
         Key::Kind::text, set_join, [](GatewaySettings const& s) { return s.join; }},
        {"join_as", "name used to join; empty: engine_name", "NAME", "a text", Key::Kind::text,
         [](GatewaySettings& s, std::string const& text) { return s.join_as = text, true; },
         [](GatewaySettings const& s) { return s.join_as; }},
        file(
            "join_token_file", "file with the token that is sent to the gateway to join; empty: none",
            [](GatewaySettings & s) -> auto& { return s.join_token_file; }),
        file(
            "join_ca_file", "certificates that the gateway to join may have, besides those of the system; empty: none",
            [](GatewaySettings & s) -> auto& { return s.join_ca_file; }),
        file(
            "join_certificate_file", "own certificate and its key, shown to the gateway to join; empty: none",
            [](GatewaySettings & s) -> auto& { return s.join_certificate_file; }),
        {"hosts", "further host names of the gateway, besides localhost, IP addresses and the name of its machine", "NAMES",
         "host names such as gateway or robots.example, without a port, separated by spaces", Key::Kind::text, set_hosts,
         [](GatewaySettings const& s) { return joined(s.net.hosts); }},
        {"allowed_origins", "origins of web pages that may send requests, besides the gateway's own", "ORIGINS",
         "origins such as https://console.example, in small letters and without a path, separated by spaces", Key::Kind::text,
         set_origins, [](GatewaySettings const& s) { return joined(s.net.allowed_origins); }},
    };
}

std::vector<Key> tls_keys() {
    return {
        file(
            "tls_certificate", "the gateway's certificate and those that signed it, read again after SIGHUP; empty: no TLS",
            [](GatewaySettings & s) -> auto& { return s.tls.certificate; }),
        file(
            "tls_key", "key of the certificate, read again after SIGHUP", [](GatewaySettings & s) -> auto& { return s.tls.key; }),
        file(
            "tls_client_ca", "certificates that sign those of clients, read again after SIGHUP; empty: clients need none",
            [](GatewaySettings & s) -> auto& { return s.tls.client_ca; }),
        choice<bool>("tls_clients", "whether a client without a certificate is accepted, with tls_client_ca",
                     [](GatewaySettings & s) -> auto& { return s.tls.client_must; }, {{"optional", false}, {"required", true}}),
        seconds(
            "handshake_timeout", "longest time for a TLS handshake",
            [](GatewaySettings & s) -> auto& { return s.net.handshake_timeout; }),
    };
}

std::vector<Key> access_keys() {
    return {
        file(
            "tokens", "file of tokens (rois-gateway token --help), read again when it changes; empty: clients need none",
            [](GatewaySettings & s) -> auto& { return s.tokens; }),
        choice<bool>("allow_anyone", "whether clients on other machines need no token",
                     [](GatewaySettings & s) -> auto& { return s.allow_anyone; }, {{"no", false}, {"yes", true}}),
        whole_number<std::size_t>(
            "max_wrong_tokens", "maximum number of wrong tokens of one address in a minute; further ones get 429",
            [](GatewaySettings & s) -> auto& { return s.max_wrong_tokens; }, 1, 1e6),
        file(
            "audit_log", "file that says who bound, commanded, stopped or was refused, and when; empty: none",
            [](GatewaySettings & s) -> auto& { return s.audit_log; }),
        whole_number<std::size_t>(
            "audit_log_bytes", "size at which the audit log begins another file",
            [](GatewaySettings & s) -> auto& { return s.audit_log_bytes; }, 10'000, 1e10),
        whole_number<std::size_t>(
            "audit_log_files", "number of earlier files of the audit log that are kept",
            [](GatewaySettings & s) -> auto& { return s.audit_log_files; }, 1, 1'000),
        {"state", "folder of the journal, from which the gateway continues after a crash; empty: none", "DIR", "a text",
         Key::Kind::text, [](GatewaySettings& s, std::string const& text) { return s.state = text, true; },
         [](GatewaySettings const& s) { return s.state; }},
        whole_number<std::size_t>(
            "state_bytes", "maximum bytes of all files in the journal's folder",
            [](GatewaySettings & s) -> auto& { return s.state_bytes; }, 1e7, 1e12),
    };
}

std::vector<Key> media_keys() {
    return {
        {"media", "address and port that serve media streams; port 0: any free port; empty: no streams", "HOST:PORT",
         "HOST:PORT, such as 127.0.0.1:8081, or empty", Key::Kind::text, set_media, show_media},
        {"media_url", "URL at which applications reach the media server; empty: http(s)://HOST:PORT of media", "URL",
         "a URL such as https://robots.example/media", Key::Kind::text, set_media_url,
         [](GatewaySettings const& s) { return s.media.url; }},
        choice<media::RtpTargets>("media_rtp", "RTP targets that applications may name",
                                  [](GatewaySettings & s) -> auto& { return s.media.rtp_targets; },
                                  {{"loopback", media::RtpTargets::loopback}, {"any", media::RtpTargets::any}}),
        whole_number<std::size_t>(
            "max_media_connections", "maximum number of connections to the media server",
            [](GatewaySettings & s) -> auto& { return s.media.limits.max_connections; }, 1, 10'000),
    };
}

std::vector<Key> session_keys() {
    return {
        choice<OnSessionEnd>("on_session_end", "whether the commands of a session that ends are stopped",
                             [](GatewaySettings & s) -> auto& { return s.engine.on_session_end; },
                             {{"stop", OnSessionEnd::stop}, {"continue", OnSessionEnd::continue_}}),
        seconds(
            "session_timeout", "time without a request or an open stream after which a session counts as lost",
            [](GatewaySettings & s) -> auto& { return s.engine.session_timeout; }),
        seconds(
            "resume_window", "time in which a lost session can be resumed before it ends",
            [](GatewaySettings & s) -> auto& { return s.engine.resume_window; }, 0),
        seconds(
            "motion_lease", "time without a sign of life on a WebSocket after which motion is held",
            [](GatewaySettings & s) -> auto& { return s.engine.motion_lease; }, 0.5, 3600),
        seconds(
            "motion_lease_http", "time without a request after which motion is held, for applications that only send requests",
            [](GatewaySettings & s) -> auto& { return s.engine.motion_lease_http; }, 0.5, 3600),
        seconds(
            "event_details", "time for which the details of an event can be fetched",
            [](GatewaySettings & s) -> auto& { return s.engine.event_details; }),
        seconds(
            "error_details", "time for which the details of an error can be fetched",
            [](GatewaySettings & s) -> auto& { return s.engine.error_details; }),
        seconds(
            "command_results", "time for which the results of a command can be fetched",
            [](GatewaySettings & s) -> auto& { return s.engine.command_results; }),
        seconds(
            "start_timeout", "time for a component to start a command, unless its profile sets another",
            [](GatewaySettings & s) -> auto& { return s.engine.start_timeout; }),
        seconds(
            "question_deadline", "time for a component to answer a query, or to say whether it can carry out a command",
            [](GatewaySettings & s) -> auto& { return s.engine.question_deadline; }),
        whole_number<std::size_t>(
            "max_sessions", "maximum number of sessions", [](GatewaySettings & s) -> auto& { return s.engine.max_sessions; }, 1,
            1e6),
        whole_number<std::size_t>(
            "max_waiting_notifications", "maximum number of notifications that wait for a session",
            [](GatewaySettings & s) -> auto& { return s.engine.max_waiting_notifications; }, 16, 1e6),
        whole_number<std::size_t>(
            "max_sent_notifications", "maximum number of sent notifications that are kept for a session to resume",
            [](GatewaySettings & s) -> auto& { return s.engine.max_sent_notifications; }, 16, 1e6),
        whole_number<std::size_t>(
            "max_command_results", "maximum number of ended commands of a session whose results are kept",
            [](GatewaySettings & s) -> auto& { return s.engine.max_command_results; }, 1, 1e6),
        whole_number<std::size_t>(
            "max_subscribed_predicates", "maximum number of predicates in the conditions of a session's subscriptions, in total",
            [](GatewaySettings & s) -> auto& { return s.engine.max_subscribed_predicates; }, 256, 1e6),
        whole_number<std::size_t>(
            "max_predicates", "maximum number of predicates in the conditions of all subscriptions, in total",
            [](GatewaySettings & s) -> auto& { return s.engine.max_predicates; }, 256, 1e8),
        whole_number<std::size_t>(
            "max_condition_bytes", "maximum bytes of text in the conditions of a session's subscriptions, in total",
            [](GatewaySettings & s) -> auto& { return s.engine.max_condition_bytes; }, 1'024, 1 << 30),
        whole_number<std::size_t>(
            "max_condition_steps",
            "maximum number of steps in a second, of some nanoseconds each, to compare values with conditions",
            [](GatewaySettings & s) -> auto& { return s.engine.max_condition_steps; }, 1e6, 1e12),
    };
}

std::vector<Key> network_keys() {
    return {
        {"memory_budget",
         "memory that the process may use; above 80 %, new sessions, subscriptions and long documents are refused", "SIZE",
         "a whole number of bytes, or of KiB, MiB or GiB, such as 512MiB, from 64MiB to 1024GiB", Key::Kind::text,
         set_memory_budget, show_memory_budget},
        whole_number<std::size_t>(
            "max_connections", "maximum number of connections",
            [](GatewaySettings & s) -> auto& { return s.net.max_connections; }, 1, 1e6),
        whole_number<std::size_t>(
            "max_connections_per_address",
            "maximum number of connections of one remote address or token, except loopback and proxies",
            [](GatewaySettings & s) -> auto& { return s.net.max_connections_per_address; }, 1, 1e6),
        whole_number<std::size_t>(
            "max_sessions_per_address",
            "maximum number of sessions of one token, or opened by one remote address, except loopback and proxies",
            [](GatewaySettings & s) -> auto& { return s.net.max_sessions_per_address; }, 1, 1e6),
        whole_number<std::size_t>(
            "max_sessions_per_connection", "maximum number of sessions opened on one connection, except those of proxies",
            [](GatewaySettings & s) -> auto& { return s.net.max_sessions_per_connection; }, 1, 1e6),
        whole_number<std::size_t>(
            "max_streams_per_session", "maximum number of event streams of a session",
            [](GatewaySettings & s) -> auto& { return s.net.max_streams_per_session; }, 1, 1e6),
        {"proxies", "addresses of reverse proxies, to which the limits per address and per connection do not apply", "ADDRESSES",
         "IP addresses or networks such as 192.0.2.1 10.0.0.0/8 2001:db8::/32, separated by spaces", Key::Kind::text, set_proxies,
         show_proxies},
        whole_number<std::size_t>(
            "max_requests_in_flight",
            "maximum number of answers of a connection that wait to be sent; the gateway then stops reading from it",
            [](GatewaySettings & s) -> auto& { return s.net.max_requests_in_flight; }, 1, 1'024),
        whole_number<std::size_t>(
            "max_body", "maximum bytes of a request document", [](GatewaySettings & s) -> auto& { return s.net.document.bytes; },
            1'024, 1 << 30),
        whole_number<std::size_t>(
            "max_header", "maximum bytes of an HTTP header", [](GatewaySettings & s) -> auto& { return s.net.max_header; }, 1'024,
            1 << 16),  // Beast's longest field
        whole_number<std::size_t>(
            "max_header_fields", "maximum number of header fields of an HTTP request",
            [](GatewaySettings & s) -> auto& { return s.net.max_header_fields; }, 16, 1'024),
        whole_number<std::size_t>(
            "max_target", "maximum bytes of the target of an HTTP request",
            [](GatewaySettings & s) -> auto& { return s.net.max_target; }, 1'024, 1 << 20),
        whole_number<std::size_t>(
            "max_depth", "maximum depth of nested elements in a document",
            [](GatewaySettings & s) -> auto& { return s.net.document.depth; }, 8, 1'024),
        whole_number<std::size_t>(
            "max_attributes", "maximum number of attributes of an element",
            [](GatewaySettings & s) -> auto& { return s.net.document.attributes; }, 8, 1'024),
        whole_number<std::size_t>(
            "max_elements", "maximum number of elements of a document",
            [](GatewaySettings & s) -> auto& { return s.net.document.elements; }, 16, 1e6),
        whole_number<std::size_t>(
            "max_name_length", "maximum bytes of the name of an element or attribute",
            [](GatewaySettings & s) -> auto& { return s.net.document.name_length; }, 64, 4'096),
        whole_number<std::size_t>(
            "max_namespaces", "maximum number of namespace declarations of an element and its ancestors",
            [](GatewaySettings & s) -> auto& { return s.net.document.namespaces; }, 8, 1'024),
        whole_number<std::size_t>(
            "max_fragments", "maximum number of frames of a WebSocket message",
            [](GatewaySettings & s) -> auto& { return s.net.max_fragments; }, 1, 1e6),
        whole_number<unsigned>(
            "max_control_frames", "maximum number of pings and other control frames that a WebSocket may send in a second",
            [](GatewaySettings & s) -> auto& { return s.net.max_control_frames; }, 10, 1e6),
        choice<xml::Validation>(
            "validation", "how documents are validated: fast, with tables made from the schemas where they suffice, or in full",
            [](GatewaySettings & s) -> auto& { return s.net.validation; },
            {{"fast", xml::Validation::fast}, {"full", xml::Validation::full}}),
        seconds(
            "request_timeout", "time for a request to arrive",
            [](GatewaySettings & s) -> auto& { return s.net.request_timeout; }),
        seconds(
            "connect_timeout", "time for a new WebSocket to open or resume a session",
            [](GatewaySettings & s) -> auto& { return s.net.connect_timeout; }),
        seconds(
            "idle_timeout", "time between two requests on an HTTP connection",
            [](GatewaySettings & s) -> auto& { return s.net.idle_timeout; }),
        seconds(
            "write_timeout", "time for a client to accept the data sent to it",
            [](GatewaySettings & s) -> auto& { return s.net.write_timeout; }),
        seconds(
            "ping_interval", "time between signs of life on WebSockets and event streams",
            [](GatewaySettings & s) -> auto& { return s.net.ping_interval; }),
        seconds(
            "max_poll_wait", "longest time that a long poll may wait for notifications",
            [](GatewaySettings & s) -> auto& { return s.net.max_poll_wait; }, 1, 3600),
        seconds(
            "shutdown_timeout",
            "time for clients to receive their last notifications, and for components to halt, when the gateway stops",
            [](GatewaySettings & s) -> auto& { return s.net.shutdown_timeout; }, 0.1, 5),  // see docs/safety.md#the-end
    };
}

std::string with_dashes(std::string name) {
    std::ranges::replace(name, '_', '-');
    return name;
}

}  // namespace

GatewaySettings::GatewaySettings() {
    net.threads = std::clamp(std::thread::hardware_concurrency(), 1u, 4u);
    media.host.clear();
}

std::vector<Key> const& keys() {
    static auto const all = [] {
        std::vector<Key> together;
        for (auto const& part : {general_keys(), tls_keys(), access_keys(), media_keys(), session_keys(), network_keys()}) {
            together.insert(together.end(), part.begin(), part.end());
        }
        return together;
    }();
    return all;
}

std::string flag_of(Key const& key) { return "--" + with_dashes(key.name); }

std::string variable_of(Key const& key) {
    std::string name = "ROIS_" + key.name;
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return name;
}

}  // namespace rois
