// Audio and video streams (RoIS 2.0): connect, suspend, resume and disconnect them, and receive their media.

#include "conformance/context.hpp"
#include "kit/received_media.hpp"

namespace rois::conformance {

namespace {

std::string one(kit::Values const& values, std::string const& name) {
    auto const found = values.find(name);
    return found == values.end() || found->second.size() != 1 ? "" : found->second.front();
}

// A streaming component, its owner, and a connected stream.
class ConnectedStream {
public:
    explicit ConnectedStream(Context& context)
        : streamer{context.component_of_kind({"audiostreaming", "videostreaming"})}, owner{context} {
        owner.bind_or_skip(streamer);
        require_ok(owner.subscribe("notify_stream_status", only(streamer), true));
        auto const command = owner.execute_one(rois::conformance::command(streamer, "connect_stream"));
        owner.require_success(command, streamer);
        auto const results = require_ok(owner.get_command_result(command)).values();
        stream = one(results, "stream_id");
        address = one(results, "transport_parameters");
        if (stream.empty()) throw NotObservable{"connect_stream of " + streamer.ref + " does not return the stream_id"};
    }

    Document execute(std::string const& type, std::string const& id) {
        return owner.execute({.component = streamer.ref, .type = type, .arguments = {{"stream_id", "string", {id}}}});
    }
    void run_command(std::string const& type) {
        require_equal("the status of " + type, "OK",
                      owner.status_of(first_of("a command in the answer", kit::command_ids(require_ok(execute(type, stream))))));
    }
    Document query_status() {
        return owner.query("get_stream_status",
                           kit::where(kit::both(kit::equal("component_ref", streamer.ref), kit::equal("stream_id", stream))));
    }
    std::string status() {
        auto const reported = one(require_ok(query_status()).values(), "status");
        if (reported.empty()) throw NotObservable{"get_stream_status of " + streamer.ref + " does not return the status"};
        return reported;
    }

    // Waits for a notification with this status of the stream. Starts after the notification found by the last call.
    void await_status(std::string const& status) {
        while (true) {
            if (next_notification_ == owner.history().size()) owner.receive();
            auto const reported = owner.history()[next_notification_++].values();
            if (one(reported, "stream_id") == stream && one(reported, "status") == status) return;
        }
    }

    Component const& streamer;
    Client owner;
    std::string stream, address;

private:
    std::size_t next_notification_ = 0;  // of the owner's history
};

void a_stream_is_connected_until_disconnect(Context& context) {
    ConnectedStream stream{context};
    auto const status = stream.status();
    require(status == "STREAMING_NOT_RUNNING" || status == "STREAMING_RUNNING",
            "expected a connected stream to be STREAMING_NOT_RUNNING or STREAMING_RUNNING, got " + status);
    stream.run_command("disconnect_stream");
    stream.await_status("STREAMING_NOT_CONNECTED");
    auto const answer = stream.query_status();
    if (answer.return_code() == "UNSUPPORTED") return;  // the gateway has forgotten the stream
    require_equal("the status of a disconnected stream", "STREAMING_NOT_CONNECTED", one(require_ok(answer).values(), "status"));
}

void a_stream_is_suspended_until_resume(Context& context) {
    ConnectedStream stream{context};
    stream.run_command("suspend_stream");
    stream.await_status("STREAMING_SUSPENDED");
    require_equal("the status of a suspended stream", "STREAMING_SUSPENDED", stream.status());
    stream.run_command("resume_stream");
    stream.await_status("STREAMING_RESUMED");
    require(stream.status() != "STREAMING_SUSPENDED", "a resumed stream is still STREAMING_SUSPENDED");
    stream.run_command("disconnect_stream");
}

void release_ends_a_stream(Context& context) {
    ConnectedStream stream{context};
    require_ok(stream.owner.release(stream.streamer.ref));
    stream.await_status("STREAMING_NOT_CONNECTED");
}

void an_unknown_stream_is_refused(Context& context) {
    ConnectedStream stream{context};
    for (auto const* const type : {"suspend_stream", "resume_stream", "disconnect_stream"})
        require_refusal(stream.execute(type, unique_name()), "BAD_PARAMETER");
    require_refusal(stream.owner.query("get_stream_status", kit::where(kit::equal("stream_id", unique_name()))), "UNSUPPORTED");
}

// The format of the stream is unknown: the check only requires that bytes arrive.
void a_stream_is_served_at_its_url(Context& context) {
    ConnectedStream stream{context};
    if (!stream.address.starts_with("http://"))
        throw Skipped{"the stream is served at '" + stream.address + "': only http:// is supported"};
    kit::MediaReceiver receiving{stream.address};
    require(receiving.head().find(" 200 ") < receiving.head().find('\r'),
            "GET of the stream: expected status 200, got " + receiving.head());
    receiving.line().take(1);
    stream.await_status("STREAMING_RUNNING");
    require_equal("the status of a stream during its reception", "STREAMING_RUNNING", stream.status());
    stream.run_command("disconnect_stream");
    receiving.line().rest();
}

}  // namespace

Clause stream_clause() {
    return {"RoIS 2.0: streams",
            {{"a_stream_is_connected_until_disconnect", "2.0, 8.2.2.5", a_stream_is_connected_until_disconnect},
             {"a_stream_is_suspended_until_resume", "2.0, 8.2.2.5", a_stream_is_suspended_until_resume},
             {"release_ends_a_stream", "decision 6", release_ends_a_stream},
             {"an_unknown_stream_is_refused", "decisions 10, 18", an_unknown_stream_is_refused},
             {"a_stream_is_served_at_its_url", "2.0, 8.2.2.5", a_stream_is_served_at_its_url, Transport::http}}};
}

}  // namespace rois::conformance
