// A reader that is being destroyed, like a WebSocket after an exception.
#include "engine/world.hpp"
#include "files/files.hpp"
#include "gateway/access/secrets.hpp"
#include "gateway/gateway.hpp"
#include "gateway/wakes.hpp"
#include "xml/validation/schemas.hpp"

namespace rois {

namespace {

// Stays registered with the session until its destruction is complete.
class Leaving : public Reader {
public:
    Leaving(Wakes& wakes, std::function<void()> meanwhile) : Reader{wakes}, meanwhile_{std::move(meanwhile)} {}
    ~Leaving() override { meanwhile_(); }
    Leaving(Leaving const&) = delete;
    Leaving& operator=(Leaving const&) = delete;

    std::unique_ptr<Reading> reading;

private:
    void woken() override {}

    std::function<void()> meanwhile_;
};

EngineProfile profile() {
    EngineProfile profile;
    profile.object.name = "main";
    return profile;
}

}  // namespace

TEST(AReaderThatIsBeingDestroyed, DoesNotAffectRequestsOfOthers) {
    xml::Platform const platform;
    auto const schemas = std::make_shared<xml::Schemas const>(files::schemas());
    xml::RequestReader requests{schemas};
    Readers readers;
    Engine engine{profile(), {common}, {}, readers, fresh_secret};
    Telemetry telemetry;
    Gateway gateway{engine, readers, telemetry};
    Troubles troubles{telemetry, [] {}};
    Wakes wakes{[] {}, troubles};
    auto const ask = [&](SessionId const& session, std::string const& operation) {
        return gateway
            .answer(requests, session, "<" + operation + " xmlns=\"urn:x-rois:psm:xml:message:1\"/>", Via::websocket, {})
            .take();
    };
    auto const session = ask({}, "connect").session;
    auto const other = ask({}, "connect").session;
    Answer answer;
    auto leaving = std::make_shared<Leaving>(wakes, [&] { answer = (gateway.stop_everything(), ask(other, "disconnect")); });
    auto read = gateway.read(session, nullptr, LinkKind::websocket, 0, *leaving);
    leaving->reading = std::move(std::get<std::unique_ptr<Reading>>(read));
    EXPECT_NO_THROW(leaving.reset()) << "every session is notified meanwhile, also this one";
    EXPECT_EQ(answer.turn, Answer::Turn::disconnected);
    EXPECT_NO_THROW(ask(session, "disconnect")) << "no destroyed reader is woken";
}

}  // namespace rois
