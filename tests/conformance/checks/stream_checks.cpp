// Streams (RoIS 2.0, audio and video streaming): connected, held and closed in messages, and served where the answer says.

#include "conformance/stage.hpp"
#include "kit/received_media.hpp"

namespace rois::conformance {

namespace {

std::string one(kit::Values const& values, std::string const& name) {
    auto const found = values.find(name);
    return found == values.end() || found->second.size() != 1 ? "" : found->second.front();
}

// A component that streams, its owner, and one stream.
class Broadcast {
public:
    explicit Broadcast(Stage& stage) : streamer{stage.one_of({"audiostreaming", "videostreaming"})}, owner{stage} {
        owner.take(streamer);
        ok(owner.subscribe("notify_stream_status", only(streamer), true));
        auto const command = owner.order(rois::conformance::command(streamer, "connect_stream"));
        owner.require_success(command, streamer);
        auto const results = ok(owner.get_command_result(command)).values();
        stream = one(results, "stream_id");
        address = one(results, "transport_parameters");
        if (stream.empty()) throw NotObservable{"connect_stream of " + streamer.ref + " does not return the stream_id"};
    }

    Document execute(std::string const& type, std::string const& id) {
        return owner.execute({.component = streamer.ref, .type = type, .arguments = {{"stream_id", "string", {id}}}});
    }
    void order(std::string const& type) {
        same("the status of " + type, "OK",
             owner.status_of(first("a command in the answer", kit::command_ids(ok(execute(type, stream))))));
    }
    Document asked() {
        return owner.query("get_stream_status",
                           kit::where(kit::both(kit::equal("component_ref", streamer.ref), kit::equal("stream_id", stream))));
    }
    std::string status() {
        auto const told = one(ok(asked()).values(), "status");
        if (told.empty()) throw NotObservable{"get_stream_status of " + streamer.ref + " does not return the status"};
        return told;
    }

    // Skips notifications until one reports this status of the stream; begins after the last such notification.
    void hear(std::string const& status) {
        while (true) {
            if (heard_ == owner.history().size()) owner.hear();
            auto const told = owner.history()[heard_++].values();
            if (one(told, "stream_id") == stream && one(told, "status") == status) return;
        }
    }

    Component const& streamer;
    Guest owner;
    std::string stream, address;

private:
    std::size_t heard_ = 0;  // of the owner's history
};

void a_stream_is_connected_until_it_is_disconnected(Stage& stage) {
    Broadcast broadcast{stage};
    auto const status = broadcast.status();
    require(status == "STREAMING_NOT_RUNNING" || status == "STREAMING_RUNNING", "a stream that was connected is " + status);
    broadcast.order("disconnect_stream");
    broadcast.hear("STREAMING_NOT_CONNECTED");
    auto const answer = broadcast.asked();
    if (answer.return_code() == "UNSUPPORTED") return;  // it is not known any more
    same("the status of a stream that was disconnected", "STREAMING_NOT_CONNECTED", one(ok(answer).values(), "status"));
}

void a_stream_is_suspended_until_it_is_resumed(Stage& stage) {
    Broadcast broadcast{stage};
    broadcast.order("suspend_stream");
    broadcast.hear("STREAMING_SUSPENDED");
    same("the status of a stream that is held", "STREAMING_SUSPENDED", broadcast.status());
    broadcast.order("resume_stream");
    broadcast.hear("STREAMING_RESUMED");
    require(broadcast.status() != "STREAMING_SUSPENDED", "a stream that was resumed is not suspended");
    broadcast.order("disconnect_stream");
}

void a_stream_ends_with_the_binding(Stage& stage) {
    Broadcast broadcast{stage};
    ok(broadcast.owner.release(broadcast.streamer.ref));
    broadcast.hear("STREAMING_NOT_CONNECTED");
}

void a_stream_that_there_is_not_is_refused(Stage& stage) {
    Broadcast broadcast{stage};
    for (auto const* const type : {"suspend_stream", "resume_stream", "disconnect_stream"})
        refused(broadcast.execute(type, unique_name()), "BAD_PARAMETER");
    refused(broadcast.owner.query("get_stream_status", kit::where(kit::equal("stream_id", unique_name()))), "UNSUPPORTED");
}

// The format of the stream is unknown here: checks only that bytes arrive.
void a_stream_is_where_its_url_says(Stage& stage) {
    Broadcast broadcast{stage};
    if (!broadcast.address.starts_with("http://")) throw NotPlayed{"the stream is at " + broadcast.address + ", not at http://"};
    kit::Receiving receiving{broadcast.address};
    require(receiving.head().find(" 200 ") < receiving.head().find('\r'), "a stream is fetched: " + receiving.head());
    receiving.line().take(1);
    broadcast.hear("STREAMING_RUNNING");
    same("the status of a stream that is received", "STREAMING_RUNNING", broadcast.status());
    broadcast.order("disconnect_stream");
    receiving.line().rest();
}

}  // namespace

Clause stream_clause() {
    return {"RoIS 2.0: streams",
            {{"a_stream_is_connected_until_it_is_disconnected", "2.0, 8.2.2.5", a_stream_is_connected_until_it_is_disconnected},
             {"a_stream_is_suspended_until_it_is_resumed", "2.0, 8.2.2.5", a_stream_is_suspended_until_it_is_resumed},
             {"a_stream_ends_with_the_binding", "decision 6", a_stream_ends_with_the_binding},
             {"a_stream_that_there_is_not_is_refused", "decisions 10, 18", a_stream_that_there_is_not_is_refused},
             {"a_stream_is_where_its_url_says", "2.0, 8.2.2.5", a_stream_is_where_its_url_says, Way::http}}};
}

}  // namespace rois::conformance
