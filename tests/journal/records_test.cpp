// Changes of the engine become records, and records become its state again.
#include "journal/records.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "files/files.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::journal {

namespace {

using testing::HasSubstr;

std::shared_ptr<xml::Schemas const> schemas() {
    static xml::Platform const platform;
    static auto const made = std::make_shared<xml::Schemas const>(files::schemas());
    return made;
}

std::vector<Record> sorted(std::vector<Record> records) {
    std::ranges::sort(records, {}, &Record::key);
    return records;
}

StoredState through_records(Changes const& changes) { return state_of(sorted(records_of(changes).set), schemas()); }

Numbered numbered(std::uint64_t sequence, Notification notification) {
    return {sequence, std::make_shared<OutgoingNotification const>(std::move(notification))};
}

Identifier identifier(std::string code) { return {.code = std::move(code), .authority = {}, .codebook_ref = {}, .version = {}}; }

}  // namespace

// Components may give any bytes.
TEST(Records, MayHaveAReasonThatIsNotUtf8) {
    Changes changes;
    changes.commands = {{.session = 1, .id = {"c-1"}, .type = "start", .ref = "navigation", .end = StoredCommand::End{}}};
    changes.commands.front().end->reason = "no \xff";
    EXPECT_EQ(through_records(changes).commands.at(0).end->reason, "no \xef\xbf\xbd");
}

TEST(Records, ReturnASession) {
    StoredSession session;
    session.session = 7;
    session.id.text = "secret";
    session.rights = "abc";
    session.links_count = false;
    session.is_engine = true;
    session.last_stop = ~0ULL;
    session.window = std::chrono::milliseconds{30'000};
    session.lease = std::chrono::milliseconds{2'000};
    session.bindings = {
        {"navigation", Switching::restart, std::make_shared<QueryExpression const>()},
        {"a b", Switching::none, {}, {{.name = "speed", .data_type_ref = identifier("double"), .values = {"0.5"}}}}};
    Changes changes;
    changes.sessions = {session};
    auto const back = through_records(changes).sessions.at(0);
    EXPECT_EQ(back.session, 7U);
    EXPECT_EQ(back.id.text, "secret");
    EXPECT_EQ(back.rights, "abc");
    EXPECT_EQ(back.window, session.window);
    EXPECT_EQ(back.lease, session.lease);
    EXPECT_FALSE(back.links_count);
    EXPECT_TRUE(back.is_engine);
    EXPECT_EQ(back.last_stop, ~0ULL);
    ASSERT_EQ(back.bindings.size(), 2U);
    EXPECT_EQ(back.bindings[0].switching, Switching::restart);
    EXPECT_TRUE(back.bindings[0].preference);
    EXPECT_EQ(back.bindings[1].ref, "a b");
    EXPECT_EQ(back.bindings[0].parameters, ParameterList{});
    EXPECT_EQ(back.bindings[1].parameters, session.bindings[1].parameters);
}

TEST(Records, ReturnACommandWithItsResults) {
    Parameter const charge{.name = "charge", .data_type_ref = identifier("integer"), .values = {"80"}};
    Utc const at{std::chrono::milliseconds{1'764'000'000'123}};
    Changes changes;
    changes.commands = {{.session = 1, .id = {"c-1 <&>"}, .type = "dock", .ref = "navigation", .end = {}},
                        {.session = 1,
                         .id = {"c-2"},
                         .type = "dock",
                         .ref = "navigation",
                         .end = StoredCommand::End{.status = CompletedStatus::timeout,
                                                   .reason = "it was \"slow\"",
                                                   .results = {.parameters = {charge}, .located = {}},
                                                   .at = at,
                                                   .notified = true}}};
    auto const back = through_records(changes).commands;
    ASSERT_EQ(back.size(), 2U);
    EXPECT_EQ(back[0].id.text, "c-1 <&>");
    EXPECT_FALSE(back[0].end);
    ASSERT_TRUE(back[1].end);
    EXPECT_EQ(back[1].end->status, CompletedStatus::timeout);
    EXPECT_EQ(back[1].end->reason, "it was \"slow\"");
    EXPECT_EQ(back[1].end->results.parameters, std::vector{charge});
    EXPECT_EQ(back[1].end->at, at);
    EXPECT_TRUE(back[1].end->notified);
}

TEST(Records, ReturnNotificationsInOrder) {
    Changes changes;
    changes.notifications = {{1, numbered(10, Completed{.command_id = {"go"}, .status = CompletedStatus::abort})},
                             {1, numbered(9, Lost{3})},
                             {1, numbered(11, ReceiveEvent{.event_id = {"e-1"},
                                                           .event_type = "reached_target",
                                                           .subscribe_id = {"s-1"},
                                                           .expire = Utc{std::chrono::seconds{1'764'000'000}},
                                                           .component_ref = identifier("navigation"),
                                                           .results = nullptr})}};
    auto const back = through_records(changes).notifications;
    ASSERT_EQ(back.size(), 3U);
    EXPECT_EQ(back[0].numbered.sequence, 9U);
    EXPECT_EQ(std::get<Lost>(back[0].numbered.notification->body).count, 3U);
    EXPECT_EQ(std::get<Completed>(back[1].numbered.notification->body).command_id.text, "go");
    EXPECT_EQ(std::get<ReceiveEvent>(back[2].numbered.notification->body).event_type, "reached_target");
}

TEST(Records, ReturnASubscriptionAndTheEngine) {
    Changes changes;
    changes.engine = {.last_session = 5, .next_event = 6, .is_stopped = true, .last_stop = 0xffff'ffff'ffff'fff0};
    changes.subscriptions = {{2, {"s-4"}, {.event_type = "person_detected", .condition = {}, .inline_results = true}}};
    auto const back = through_records(changes);
    EXPECT_EQ(back.engine.last_session, 5U);
    EXPECT_TRUE(back.engine.is_stopped);
    EXPECT_EQ(back.engine.last_stop, 0xffff'ffff'ffff'fff0);
    ASSERT_EQ(back.subscriptions.size(), 1U);
    EXPECT_EQ(back.subscriptions[0].id.text, "s-4");
    EXPECT_TRUE(back.subscriptions[0].asked.inline_results);
}

TEST(Records, ThatCannotBeReadAreNamed) {
    auto const problem = [](Record const& record) -> std::string {
        try {
            state_of({record}, schemas());
            return "";
        } catch (BadRecord const& why) {
            return why.what();
        }
    };
    EXPECT_THAT(problem({{kind::session, 3, ""}, "{}"}), HasSubstr("the 'session' '' of session 3 cannot be read"));
    EXPECT_THAT(problem({{kind::session, 3, ""}, "no json"}), HasSubstr("cannot be read"));
    EXPECT_THAT(problem({{kind::engine, 0, ""}, R"({"last_session": 99999999999999999999})"}),
                HasSubstr("cannot be read: 1e+20 is not an integer of 64 bits"));
    EXPECT_THAT(problem({{kind::session, 3, ""}, R"({"id": "x", "rights": "", "window": 17295857133614})"}),
                HasSubstr("17295857133614 is not from 0 to 10000000000"));
    EXPECT_THAT(problem({{kind::notification, 3, "1"}, "<completed/>"}), HasSubstr("it is not a notification"));
    EXPECT_THAT(problem({{kind::subscription, 3, "s-1"}, "<connect/>"}), HasSubstr("cannot be read"));
    EXPECT_THAT(problem({{"other", 3, ""}, ""}), HasSubstr("unknown kind"));
}

}  // namespace rois::journal
