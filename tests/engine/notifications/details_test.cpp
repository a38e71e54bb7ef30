// Conditions on details select results (decision 19).
#include "engine/conditions/conditions.hpp"
#include "engine/world.hpp"

namespace rois {

namespace {

ParameterList found_people(std::vector<std::string> refs, std::vector<std::string> points) {
    return {value("timestamp", "DateTime", {"2026-11-20T12:00:00Z"}), references("person_ref", std::move(refs)),
            positions("position_data", std::move(points), "hall")};
}

Located person(std::string ref, double x, double y) {
    return {.of = "position_data",
            .ref = std::move(ref),
            .crs = "hall",
            .position = {x, y, 1'700},
            .orientation = {},
            .certainty = {}};
}

struct Details : testing::Test {
    World world{localization};
    Application desk = world.connect();

    std::string const noon = "2026-11-20T12:00:00Z";
    ParameterList two = found_people({"p-1", "p-2"}, {"1000, 1000, 0", "8000, 8000, 0"});
    std::vector<Located> both_of_them{person("p-1", 1'000.4, 1'000), person("p-2", 8'000, 8'000)};

    Details() {
        world.engine->describe({.frames = {"hall"}, .all = {{"desk", box(0, 0, 2'000, 1'000, "hall")}}});
        desk.subscribe("person_localized");
    }

    // The results that the condition selects of an event.
    Results left_of(Condition condition, ParameterList results, std::vector<Located> located = {}) {
        world["localization"].fires("person_localized", std::move(results), std::move(located));
        desk.received();
        auto reply = desk.detail_of(desk.last_received<ReceiveEvent>().event_id, std::move(condition));
        EXPECT_EQ(reply.return_code, ReturnCode::ok) << reply.reason;
        return std::move(reply.results);
    }

    // The same as text: "p-1@1000, 1000, 0 located p-1".
    std::string left(Condition condition, ParameterList given, std::vector<Located> located = {}) {
        auto const results = left_of(std::move(condition), std::move(given), std::move(located));
        if (results.parameters.empty()) return "nothing";
        EXPECT_NE(find(results.parameters, "timestamp"), nullptr) << "scalars stay";
        auto const& refs = find(results.parameters, "person_ref")->values;
        auto const& points = find(results.parameters, "position_data")->values;
        EXPECT_EQ(refs.size(), points.size());
        std::string text;
        for (std::size_t i = 0; i < refs.size(); ++i) text += (i == 0 ? "" : "; ") + refs[i] + "@" + points[i];
        for (auto const& each : results.located) text += " located " + each.ref;
        return text;
    }

    std::string const first = "p-1@1000, 1000, 0 located p-1";
    std::string const second = "p-2@8000, 8000, 0 located p-2";
    std::string const both_there = "p-1@1000, 1000, 0; p-2@8000, 8000, 0 located p-1 located p-2";
};

}  // namespace

TEST_F(Details, AreTheEntriesThatMatchInAllParallelLists) {
    EXPECT_EQ(left(equal("person_ref", "p-2"), two, both_of_them), second);
    EXPECT_EQ(left(within("position_data", {box(0, 0, 2'000, 2'000)}), two, both_of_them), first);
    EXPECT_EQ(left(within("located", {box(7'000, 7'000, 9'000, 9'000)}), two, both_of_them), second);
    EXPECT_EQ(left(spatial(SpatialRelation::within, {{box(0, 0, 2'000, 2'000)}}), two, both_of_them), first) << "one operand";
    EXPECT_EQ(left(spatial(SpatialRelation::disjoint, {reference("position_data"), literal("desk")}), two, both_of_them), second)
        << "of each entry, not of all";
    EXPECT_EQ(left(like("person_ref", "p-*"), two, both_of_them), both_there);
    EXPECT_EQ(left(equal("person_ref", "p-3"), two, both_of_them), "") << "the lists are empty, the time stays";
    EXPECT_EQ(left(equal("person_ref", "p-1"), two), "p-1@1000, 1000, 0") << "without located elements, too";
}

TEST_F(Details, MatchAsWholeRows) {
    auto const near_the_desk = within("position_data", {box(0, 0, 2'000, 2'000)});
    EXPECT_EQ(left(both({equal("person_ref", "p-1"), near_the_desk}), two, both_of_them), first);
    EXPECT_EQ(left(both({equal("person_ref", "p-2"), near_the_desk}), two, both_of_them), "")
        << "one person is p-2 and another is near, but none is both";
    EXPECT_EQ(left(either({equal("person_ref", "p-2"), near_the_desk}), two, both_of_them), both_there);
    EXPECT_EQ(left(contrary(equal("person_ref", "p-2")), two, both_of_them), first);
    EXPECT_EQ(left(contrary(near_the_desk), two, both_of_them), second);
    EXPECT_EQ(left(compared("person_ref", Comparator::equal, "p-2", MatchAction::all), two, both_of_them), second);
    EXPECT_EQ(left(equal("person_ref[2]", "p-2"), two, both_of_them), second);
    EXPECT_EQ(left(equal("person_ref[1]", "p-2"), two, both_of_them), "");
    EXPECT_EQ(left(near("position_data[@ref='p-2']", {spot(8'000, 8'000)}, 1), two, both_of_them), second);
    EXPECT_EQ(left(is_null("person_ref"), two, both_of_them), "");
}

TEST_F(Details, OfScalarsAreAllOrNothing) {
    EXPECT_EQ(left(equal("timestamp", noon), two, both_of_them), both_there);
    EXPECT_EQ(left(greater("timestamp", noon), two, both_of_them), "nothing");
    EXPECT_EQ(left(both({equal("timestamp", noon), equal("person_ref", "p-1")}), two, both_of_them), first);
    EXPECT_EQ(left(both({greater("timestamp", noon), equal("person_ref", "p-1")}), two, both_of_them), "");
    EXPECT_EQ(left(equal("person_ref", "p-1"), found_people({}, {})), "") << "empty lists stay empty";
}

TEST_F(Details, OfListsOfAnotherLengthStay) {
    auto const results = found_people({"p-1", "p-2", "p-3"}, {"1000, 1000, 0", "8000, 8000, 0"});
    auto const reply = left_of(equal("person_ref", "p-2"), results);
    EXPECT_THAT(find(reply.parameters, "person_ref")->values, ElementsAre("p-2"));
    EXPECT_THAT(find(reply.parameters, "position_data")->values, testing::SizeIs(2)) << "not parallel";
    auto const chosen = left_of(both({equal("person_ref", "p-2"), near("position_data", {spot(1'000, 1'000)}, 1)}), results);
    EXPECT_THAT(find(chosen.parameters, "person_ref")->values, ElementsAre("p-2"));
    EXPECT_THAT(find(chosen.parameters, "position_data")->values, ElementsAre("1000, 1000, 0"))
        << "each entry is matched with all entries of the other list";
}

TEST_F(Details, OfListsOfNumbersArePackedAgain) {
    auto part = named("counter", detection);
    part.profile.messages.back().results.push_back({"numbers", {"int[]", {}, {}, {}}, {}, {}});
    part.profile.messages.back().results.push_back({"names", {"string[]", {}, {}, {}}, {}, {}});
    World counting{part};
    auto watcher = counting.connect();
    watcher.subscribe("person_detected");
    counting["counter"].fires("person_detected", {value("numbers", "int[]", {"5 6 7"}), texts("names", {"a", "b", "c"})});
    watcher.received();
    auto const left = watcher.detail_of(watcher.last_received<ReceiveEvent>().event_id, greater("numbers", "5"));
    EXPECT_EQ(in_words(left.results.parameters), "numbers=6 7 names=b|c");
}

// If a component reports only some located elements, the ref says to which entry each belongs.
TEST_F(Details, FindTheEntryOfALocatedElementByItsRef) {
    EXPECT_EQ(left(equal("person_ref", "p-2"), two, {both_of_them[1]}), second);
    EXPECT_EQ(left(equal("person_ref", "p-1"), two, {both_of_them[1]}), "p-1@1000, 1000, 0");
}

}  // namespace rois
