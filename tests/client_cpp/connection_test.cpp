// Connection: calls, documents, deadlines and states, over WebSocket and HTTP, with the real gateway.
#include "client_cpp/rig.hpp"

namespace rois::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

class TheConnection : public BothWays {};
ROIS_BOTH_WAYS(TheConnection);

TEST_P(TheConnection, OpensASessionAndEndsIt) {
    History history;
    SessionId session;
    {
        Blocking robot{settings(), history.observers()};
        robot.open();
        session = robot.client().session();
        EXPECT_THAT(session.text, SizeIs(testing::Ge(16U)));
    }
    EXPECT_THAT(history.states(), ElementsAre("connecting", "open", "closed"));
    // The session has ended: it cannot be resumed.
    Blocking other{settings()};
    auto const text = "<resume xmlns='urn:x-rois:psm:xml:message:1' session='" + session.text + "' last_sequence='0'/>";
    auto const answer = other(other.client().send(text));
    EXPECT_THAT(std::get<std::string>(answer), HasSubstr(GetParam() == Way::http ? "not_allowed" : "no_session"));
}

TEST_P(TheConnection, ReturnsReturnCodesAsValues) {
    Blocking robot{settings()};
    auto const unknown = robot.call(Bind{{"nobody", {}, {}, {}}});
    EXPECT_EQ(unknown.return_code, ReturnCode::bad_parameter);
    EXPECT_THAT(unknown.reason, HasSubstr("nobody"));
    auto const found = robot.call(Search{type == "Navigation"});
    EXPECT_EQ(found.return_code, ReturnCode::ok);
    ASSERT_THAT(found.component_ref_list, SizeIs(1));
    EXPECT_EQ(found.component_ref_list.front().code, "navigation");
    auto const profile = robot.call(GetProfile{type == "Navigation"});
    ASSERT_THAT(profile.components, SizeIs(1));
    EXPECT_NE(find_message(*profile.components.front().profile, MessageKind::event, "reached_target"), nullptr);
    EXPECT_THAT(profile.profile->components, testing::Contains("navigation"));
}

TEST_P(TheConnection, ReturnsFaultsUnchanged) {
    Blocking robot{settings()};
    Request resume{Resume{}, {}};
    EXPECT_EQ(std::get<Fault>(robot(robot.client().request(resume))).code, FaultCode::not_allowed);
}

TEST_P(TheConnection, SendsAnyDocumentAndReturnsItsAnswer) {
    std::vector<std::string> tapped;
    Observers observers;
    observers.tap = [&](Direction direction, std::string_view document) {
        tapped.push_back((direction == Direction::out ? "> " : "< ") + std::string{document});
    };
    {
        Blocking robot{settings(), observers};
        robot.open();
        auto const bad = std::get<std::string>(robot(robot.client().send("<search")));
        EXPECT_THAT(bad, HasSubstr("code=\"not_well_formed\""));
        auto const good =
            std::get<std::string>(robot(robot.client().send("<search xmlns='urn:x-rois:psm:xml:message:1' request_id='mine'/>")));
        EXPECT_THAT(good, HasSubstr("request_id=\"mine\""));
        // Operations get their own answers.
        EXPECT_EQ(robot.call(Search{}).return_code, ReturnCode::ok);
    }
    EXPECT_THAT(
        tapped,
        ElementsAre(StartsWith("> <connect "), StartsWith("< <connect_response "), "> <search", StartsWith("< <fault "),
                    StartsWith("> <search xmlns='urn"), StartsWith("< <search_response "), StartsWith("> <search "),
                    StartsWith("< <search_response "), StartsWith("> <disconnect "), StartsWith("< <disconnect_response ")));
}

TEST_P(TheConnection, ReturnsTheAnswerToADocumentWithAnyRequestId) {
    Blocking robot{settings()};
    robot.open();
    auto const both = [](Client& client, std::string id) -> Task<std::string> {
        client.spawn([](Client& other) -> Task<> {  // another operation at the same time
            Search const all;
            co_await other.call(all);
        }(client));
        auto const answer = co_await client.send("<search xmlns='urn:x-rois:psm:xml:message:1' request_id='" + id + "'/>", 2s);
        co_return std::get<std::string>(answer);
    };
    for (auto const* id : {"rois-cpp-1", "rois-cpp-2", "rois-cpp-3", "rois-cpp-4"})
        EXPECT_THAT(robot(both(robot.client(), id)), HasSubstr("request_id=\"" + std::string{id} + '"'));
}

TEST_P(TheConnection, DropsTheAnswerToACallThatTimedOut) {
    Proxy proxy{shared_gateway().port()};
    Blocking robot{settings(proxy.url())};
    robot.open();
    proxy.delay(100ms);
    EXPECT_EQ(robot(robot.client().call(Search{}, 10ms)).return_code, ReturnCode::timeout);
    EXPECT_EQ(std::get<NoAnswer>(robot(robot.client().send("<search/>", 10ms))).why, NoAnswer::Why::deadline);
    auto const document = "<query xmlns='urn:x-rois:psm:xml:message:1'><query_type>robot_position</query_type></query>";
    EXPECT_THAT(std::get<std::string>(robot(robot.client().send(document))), StartsWith("<query_response "));
    EXPECT_THAT(robot.call(Search{type == "Move"}).component_ref_list, SizeIs(1));
}

TEST_P(TheConnection, EveryCallHasADeadline) {
    Proxy proxy{shared_gateway().port()};
    Blocking robot{settings(proxy.url())};
    robot.open();
    proxy.half_open();
    auto const begun = std::chrono::steady_clock::now();
    auto const late = robot(robot.client().call(Search{}, 50ms));
    EXPECT_EQ(late.return_code, ReturnCode::timeout);
    EXPECT_THAT(late.reason, HasSubstr("50 ms"));
    EXPECT_LT(std::chrono::steady_clock::now() - begun, 2s);
    auto const raw = robot(robot.client().send("<search/>", 50ms));
    EXPECT_EQ(std::get<NoAnswer>(raw).why, NoAnswer::Why::deadline);
}

TEST_P(TheConnection, WaitsWithoutLimitForTheLongestDeadline) {
    constexpr auto ever = std::chrono::milliseconds::max();
    auto patient = settings();
    patient.deadline = patient.connect_deadline = patient.ping_interval = patient.stream_silence = patient.longest_pause = ever;
    Blocking robot{patient};
    auto& client = robot.client();
    robot.open();
    EXPECT_FALSE(robot(client.opened(ever)));
    auto const sleeping = begun(client, client.sleep(ever));
    for (std::chrono::milliseconds const long_enough : {ever, std::chrono::milliseconds{std::chrono::years{400}}})
        EXPECT_EQ(robot(client.call(Search{}, long_enough)).return_code, ReturnCode::ok);
    EXPECT_TRUE(std::holds_alternative<std::string>(robot(client.send("<search/>", ever))));
    auto const detection = robot.bind_any<PersonDetection>();
    auto detected = robot(detection.person_detected());
    EXPECT_EQ(robot(detection.start()), CompletedStatus::ok);
    EXPECT_TRUE(robot(detected.next(ever)));
    EXPECT_EQ(sleeping.wait_for(0s), std::future_status::timeout);
    EXPECT_EQ(robot(client.call(Search{}, std::chrono::milliseconds::min())).return_code, ReturnCode::timeout);
    robot(detection.release());
}

TEST_P(TheConnection, KeepsTheFirstOfTwoCommandsWithOneId) {
    Blocking robot{settings()};
    auto& client = robot.client();
    auto const follow = robot.bind<Follow>("follow");
    auto following = command(follow, "start", {reference("target_object_ref", "nobody"), integer("distance", 500)});
    std::get<CommandMessage>(following.unit).command_id = {"mine"};
    CommandUnitSequence sequence;
    sequence.command_unit_list = {following};
    auto first = begun(client, client.execute(sequence));
    auto at_once = begun(client, client.execute(sequence));
    auto const mine = first.get().at(0);
    EXPECT_THROW(at_once.get(), Error);
    EXPECT_THROW(robot(client.execute(sequence)), Error);
    EXPECT_EQ(robot(follow.stop()), CompletedStatus::ok);
    auto completed = begun(client, mine.completed());
    ASSERT_EQ(completed.wait_for(5s), std::future_status::ready);
    EXPECT_EQ(completed.get(), CompletedStatus::ok);
    robot(follow.release());
}

TEST_P(TheConnection, RetriesAndReportsTheReason) {
    Proxy proxy{shared_gateway().port()};
    proxy.refuse(true);
    Blocking robot{settings(proxy.url())};
    auto const call = robot(robot.client().call(Search{}, 100ms));
    EXPECT_EQ(call.return_code, ReturnCode::timeout);
    EXPECT_THAT(call.reason, testing::AllOf(HasSubstr("100 ms: "), HasSubstr("reset")));
    EXPECT_GT(proxy.connections(), 1U);
    proxy.refuse(false);
    EXPECT_EQ(robot.call(Search{}).return_code, ReturnCode::ok);
}

TEST_P(TheConnection, ClosesAfterTheLastAttempt) {
    Proxy proxy{shared_gateway().port()};
    proxy.refuse(true);
    auto few = settings(proxy.url());
    few.attempts = 3;
    History history;
    Blocking robot{few, history.observers()};
    auto asked = begun(robot.client(), [](Client& client) -> Task<State> {
        Search const all;
        co_await client.call(all);
        co_return client.state();
    }(robot.client()));
    EXPECT_THROW(robot.open(), Error);
    EXPECT_EQ(proxy.connections(), 3U);
    history.await_states({"connecting", "closed"});
    EXPECT_EQ(asked.get(), State::closed) << "when the call ends";
    EXPECT_EQ(robot.call(Search{}).return_code, ReturnCode::error);
}

TEST_P(TheConnection, DoesNotRetryAtAPathWithoutAGateway) {
    Proxy proxy{shared_gateway().port()};
    History history;
    Blocking robot{settings(proxy.url() + "/nowhere"), history.observers()};
    try {
        robot.open();
        ADD_FAILURE() << "it is open";
    } catch (Error const& refused) {
        EXPECT_THAT(refused.what(), testing::AnyOf(HasSubstr("404"), HasSubstr("/nowhere")));
    }
    EXPECT_EQ(robot.client().state(), State::closed);
    EXPECT_EQ(proxy.connections(), 1U);
}

TEST_P(TheConnection, EndsWithDisconnect) {
    History history;
    Blocking robot{settings(), history.observers()};
    EXPECT_EQ(robot.call(Disconnect{}).return_code, ReturnCode::ok);
    history.await_states({"connecting", "open", "closed"});
    auto const after = robot.call(Search{});
    EXPECT_EQ(after.return_code, ReturnCode::error);
    EXPECT_THAT(after.reason, HasSubstr("closed"));
}

TEST_P(TheConnection, RejectsAWaitOnTheClientsThread) {
    Blocking robot{settings()};
    auto const caught = robot([](Client& client) -> Task<bool> {
        co_await client.sleep(1ms);
        bool thrown = false;
        try {
            client.wait(client.sleep(1ms));
        } catch (std::logic_error const&) {
            thrown = true;
        }
        co_return thrown;
    }(robot.client()));
    EXPECT_TRUE(caught);
}

TEST(TheUrl, NeedsASchemeAndAHostAndHasNoUserOrQuery) {
    for (auto const* bad : {"", "localhost", "ftp://a", "http://", "http://:80", "http://a:0", "http://a:65536", "http://a:1x",
                            "http://a b", "http://u@a", "http://a/?q", "http://[::1", "http://a]"})
        EXPECT_THROW(Blocking{quick(bad)}, std::invalid_argument) << bad;
    for (auto const* good : {"http://localhost", "WS://a:1/", "wss://[::1]:8443/robots/", "https://robot.example"})
        EXPECT_NO_THROW(Blocking{quick(good)}) << good;
}

}  // namespace
}  // namespace rois::test
