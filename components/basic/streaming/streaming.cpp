#include "basic/streaming/streaming.hpp"

#include <algorithm>
#include <array>
#include <ranges>
#include <utility>

#include "basic/base/parameter_reading.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois::basic {

namespace {

constexpr std::size_t most_streams = 8;
constexpr std::size_t most_closed = 16;  // closed streams in get_stream_status

Results row(std::string const& id, StreamStatus status) { return {{text("stream_id", id), status_of("status", status)}, {}}; }

std::vector<MediaOffer> all_of(std::vector<std::string_view> const& names) {
    std::vector<MediaOffer> all;
    all.reserve(names.size());
    for (auto const name : names) all.push_back({std::string{name}, {}});
    return all;
}

// Returns a transport's name without the target.
std::string_view kind_of(MediaOffer const& transport) {
    return std::string_view{transport.name}.substr(0, transport.name.find(':'));
}

// Returns an error of the transport that is independent of the encoding, or nothing.
std::optional<std::string> flaw(MediaOffer const& transport) {
    if (transport.name.starts_with("http:")) return "'http' takes no target: connect_stream returns the address";
    return MediaFields{transport}.problem();
}

// Returns an error if the name is unknown.
std::optional<std::string> unknown(std::string_view name, std::vector<std::string_view> const& known) {
    if (std::ranges::any_of(known, [&](auto each) { return equal_ignoring_case(each, name); })) return {};
    return quoted(name) + " is not supported; expected one of " + listed(known);
}

}  // namespace

Prepared Streaming::prepare_start(ParameterList const& parameters) {
    return [this, parameters](CommandHandle command, Instant) {
        parameters_ = parameters;
        port().completed(command, CompletedStatus::ok);
    };
}

Halted Streaming::halt(Instant now) {
    while (!streams_.empty()) disconnect(streams_.front(), now);
    held_ = false;
    return Halted::confirmed;
}

void Streaming::suspend(Instant now) {
    held_ = true;
    for (auto& stream : streams_) {
        if (stream.status == StreamStatus::suspended) continue;
        hold(stream, now);
        stream.held_with_all = true;
    }
}

void Streaming::resume(Instant now) {
    held_ = false;
    for (auto& stream : streams_)
        if (std::exchange(stream.held_with_all, false)) go_on(stream, now);
}

void Streaming::change(CommandHandle command, std::string_view command_type, std::string_view stream_id, Instant now) {
    auto* const stream = find(stream_id);
    // The stream may have changed since the command was accepted.
    bool const held = stream != nullptr && stream->status == StreamStatus::suspended;
    auto const failed = [&](std::string reason) {
        port().completed(command, CompletedStatus::error, {}, Afterwards::as_before, std::move(reason));
    };
    if (stream == nullptr) return failed("the stream has been closed");
    if (command_type == "suspend_stream" && held) return failed("the stream is already suspended");
    if (command_type == "resume_stream" && !held) return failed("the stream is not suspended");
    if (command_type == "suspend_stream") {
        hold(*stream, now);
    } else if (command_type == "resume_stream") {
        stream->held_with_all = false;
        go_on(*stream, now);
    } else {
        disconnect(*stream, now);
        held_ = held_ && !streams_.empty();
    }
    port().completed(command, CompletedStatus::ok, {}, streams_.empty() ? Afterwards::idle : Afterwards::as_before);
}

ParameterList Streaming::readable_parameters() const {
    return {text("available_encodings", listed(encodings())), text("available_transports", listed(transports()))};
}

// Returns the connected streams, the latest first, then the closed ones.
std::vector<Results> Streaming::query(std::string_view query_type, Instant) {
    if (query_type != "get_stream_status") return {};
    std::vector<Results> rows;
    for (auto const& stream : streams_ | std::views::reverse) rows.push_back(row(stream.id, stream.status));
    for (auto const& id : closed_) rows.push_back(row(id, StreamStatus::not_connected));
    if (rows.empty()) rows.push_back(row("", StreamStatus::not_connected));
    return rows;
}

void Streaming::on_step(Instant when) {
    if (streams_.empty()) return;
    look(when);
}

void Streaming::time_passed(Instant now) {
    for (auto& stream : streams_) receptions(stream, now);
}

std::optional<std::string> Streaming::parameter_problem(ParameterList const& parameters) const {
    auto agreed = negotiated(parameters);
    if (auto* problem = std::get_if<std::string>(&agreed)) return std::move(*problem);
    return {};
}

Prepared Streaming::prepare_command(std::string_view command_type, ParameterList const& arguments) {
    if (command_type == "connect_stream") return [this](CommandHandle command, Instant now) { connect(command, now); };
    std::string id{text_of(arguments, "stream_id")};
    if (find(id) == nullptr) {
        auto const there_are = listed(streams_, &Stream::id);
        return Refused{"argument 'stream_id': stream " + quoted(id) +
                       " is not connected; connected: " + (there_are.empty() ? "none" : there_are)};
    }
    return [this, type = std::string{command_type}, id = std::move(id)](CommandHandle command, Instant now) {
        change(command, type, id, now);
    };
}

// Returns the first supported pair; the order of the transports comes first.
std::variant<Streaming::Opening, std::string> Streaming::negotiated(ParameterList const& parameters) const {
    std::array<std::vector<MediaOffer>, 2> wanted;
    std::array<std::string_view, 2> const names{"transport_parameters", "encoding_parameters"};
    for (std::size_t i = 0; i < names.size(); ++i) {
        auto read = read_media_offers(text_of(parameters, names[i]));
        if (auto* problem = std::get_if<std::string>(&read)) return "parameter " + quoted(names[i]) + ": " + *problem;
        wanted[i] = std::get<std::vector<MediaOffer>>(std::move(read));
    }
    auto& [transports_wanted, encodings_wanted] = wanted;
    if (transports_wanted.empty()) transports_wanted.push_back({std::string{transports().front()}, {}});
    if (encodings_wanted.empty()) encodings_wanted = all_of(encodings());
    std::vector<std::string> problems;
    for (auto const& transport : transports_wanted) {
        auto problem = unknown(kind_of(transport), transports());
        if (!problem) problem = flaw(transport);
        if (!problem) problem = unreachable(transport);
        if (problem) {
            problems.push_back("parameter 'transport_parameters': " + *problem);
            continue;
        }
        for (auto const& encoding : encodings_wanted) {
            auto stranger = unknown(encoding.name, encodings());
            auto agreed = stranger ? std::variant<Opening, std::string>{std::move(*stranger)} : opening(encoding, transport);
            if (std::holds_alternative<Opening>(agreed)) return agreed;
            problems.push_back("parameter 'encoding_parameters': " + std::get<std::string>(agreed));
        }
    }
    return problems.front();
}

void Streaming::connect(CommandHandle command, Instant now) {
    if (streams_.size() >= most_streams)
        return port().completed(command, CompletedStatus::out_of_resources, {}, Afterwards::as_before,
                                std::to_string(most_streams) + " streams are open: close one first");
    auto const agreed = negotiated(parameters_);
    auto const* opening = std::get_if<Opening>(&agreed);
    if (opening == nullptr)
        return port().completed(command, CompletedStatus::error, {}, Afterwards::as_before, std::get<std::string>(agreed));
    Stream stream{.id = description().ref.code + "-" + std::to_string(++last_),
                  .outlet = opening->open(held_ ? media::Flow::held : media::Flow::on)};
    Results results{{text("stream_id", stream.id), text("encoding_parameters", opening->encoding),
                     text("transport_parameters", stream.outlet->address())},
                    {}};
    stream.held_with_all = held_;
    auto& connected = streams_.emplace_back(std::move(stream));
    turn(connected, held_ ? StreamStatus::suspended : StreamStatus::not_running, now);
    receptions(connected, now);
    look(now);
    port().completed(command, CompletedStatus::ok, std::move(results), Afterwards::active);
}

void Streaming::disconnect(Stream& stream, Instant now) {
    turn(stream, StreamStatus::not_connected, now);
    closed_.push_front(stream.id);
    if (closed_.size() > most_closed) closed_.pop_back();
    streams_.erase(streams_.begin() + (&stream - streams_.data()));
}

void Streaming::hold(Stream& stream, Instant now) {
    stream.outlet->hold();
    turn(stream, StreamStatus::suspended, now);
}

void Streaming::go_on(Stream& stream, Instant now) {
    stream.outlet->go_on();
    turn(stream, StreamStatus::resumed, now);
    if (!stream.received) turn(stream, StreamStatus::not_running, now);
}

void Streaming::receptions(Stream& stream, Instant now) {
    for (auto const reception : stream.outlet->receptions()) {
        stream.received = reception == media::Reception::begun;
        if (stream.status != StreamStatus::suspended)
            turn(stream, stream.received ? StreamStatus::running : StreamStatus::not_running, now);
    }
}

Streaming::Stream* Streaming::find(std::string_view id) {
    auto const found = std::ranges::find(streams_, id, &Stream::id);
    return found == streams_.end() ? nullptr : &*found;
}

void Streaming::turn(Stream& stream, StreamStatus status, Instant now) {
    stream.status = status;
    port().event("notify_stream_status",
                 {{text("stream_id", stream.id), date_time("timestamp", now.utc), status_of("status", status)}, {}});
}

}  // namespace rois::basic
