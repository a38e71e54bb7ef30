#include "command/recording/relay.hpp"

#include <boost/asio/post.hpp>
#include <utility>

#include "xml/codec/codec.hpp"

namespace rois::command {

namespace {

Observers observers(std::function<void(Notification)> take, std::shared_ptr<RecordingWriter> recorded, std::string session) {
    Observers observers;
    observers.notification = [take = std::move(take)](Notification const& notification, std::uint64_t) { take(notification); };
    observers.tap = [recorded = std::move(recorded), session = std::move(session)](Direction direction,
                                                                                   std::string_view document) {
        recorded->add(direction, document, session);
        if (direction == Direction::in) recorded->keep();  // the engine has answered
    };
    return observers;
}

std::string no_engine(std::variant<Request, Fault> const& read, NoAnswer const& none) {
    auto const* const request = std::get_if<Request>(&read);
    return xml::encode(Fault{FaultCode::shutting_down,
                             "the engine does not answer: " + none.reason,
                             {},
                             request != nullptr ? request->request_id : ""});
}

}  // namespace

// For the front's thread.
struct Relay::Door {
    HostedSession* session;
};

Relay::Relay(asio::io_context& io, HostedSession& session, Settings settings, std::shared_ptr<RecordingWriter> recorded,
             std::string name)
    : io_{io},
      door_{std::make_shared<Door>(&session)},
      connection_{std::move(settings), observers(
                                           [&io, door = door_](Notification notification) {
                                               asio::post(io, [door, notification = std::move(notification)] {
                                                   if (door->session != nullptr) door->session->notify(notification);
                                               });
                                           },
                                           std::move(recorded), std::move(name))} {}

Relay::~Relay() { door_->session = nullptr; }

void Relay::take(std::string const& document, std::variant<Request, Fault> const& read, std::function<void(std::string)> reply) {
    auto const pass_on = [](Connection& connection, asio::io_context& io, std::string text, std::variant<Request, Fault> what,
                            std::function<void(std::string)> answered) -> Task<> {
        auto sent = co_await connection.send(std::move(text));
        auto* const answer = std::get_if<std::string>(&sent);
        auto said = answer != nullptr ? std::move(*answer) : no_engine(what, std::get<NoAnswer>(sent));
        asio::post(io, [answered = std::move(answered), said = std::move(said)] { answered(said); });
    };
    connection_.spawn(pass_on(connection_, io_, document, read, std::move(reply)));
}

}  // namespace rois::command
