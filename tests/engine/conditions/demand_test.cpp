// The demands of conditions, and that a lookup by demand finds the same components as a search of all.

#include <algorithm>
#include <random>

#include "engine/conditions/conditions.hpp"
#include "engine/conditions/filter.hpp"
#include "engine/world.hpp"

namespace rois {

namespace {

std::string urn(std::string const& name) { return "urn:x-rois:def:component:OMG::" + name; }
Condition of_type(std::string const& name) { return equal("component_type", urn(name)); }
Condition resource(std::string rid) { return {ResourceId{std::move(rid)}}; }

// The same condition, in a form without a demand.
Condition scanned(Condition condition) {
    Condition const met_by_all{PropertyComparison{Comparator::equal, literal("a"), literal("a")}};
    return contrary(both({contrary(std::move(condition)), met_by_all}));
}

class Demands : public testing::Test {
protected:
    // "ref ref; type type", or "nothing".
    std::string demand(Condition const& condition) const {
        auto const compiled =
            Filter::compile(QueryExpression{condition}, {.places = &places_, .parameters = &none_, .results = nullptr});
        auto const demand = std::get<Filter>(compiled).demand();
        if (!demand) return "nothing";
        std::string text;
        for (auto const ref : demand->refs) text += std::string{ref} + " ";
        text += ";";
        for (auto const type : demand->types) text += " " + std::string{type};
        return text;
    }

private:
    Places places_;
    Declarations none_;
};

}  // namespace

TEST_F(Demands, AreRefsAndTypesInEqualComparisons) {
    EXPECT_EQ(demand(equal("component_ref", " b ")), "b ;");
    EXPECT_EQ(demand(equal_reversed("b", "name")), "b ;");
    EXPECT_EQ(demand(equal("component_ref/@code", "b")), "b ;");
    EXPECT_EQ(demand(resource("b")), "b ;");
    EXPECT_EQ(demand(equal("component_type", " URN:x:Lamp ")), "; urn:x:lamp") << "types are not case-sensitive";
    EXPECT_EQ(demand(equal_reversed("Lamp", "component_type")), "; lamp");
    EXPECT_EQ(demand(alike("component_type", "Lamp")), "; lamp");
}

TEST_F(Demands, OfAndAreThoseOfTheNarrowestOperand) {
    EXPECT_EQ(demand(both({equal("engine", "x"), equal("component_type", "Lamp")})), "; lamp");
    EXPECT_EQ(demand(both({equal("component_type", "Lamp"), equal("component_ref", "b")})), "b ;");
    auto const one_of = either({equal("component_type", "Lamp"), equal("component_type", "Clock")});
    EXPECT_EQ(demand(both({one_of, equal("component_type", "Clock")})), "; clock");
}

TEST_F(Demands, OfOrAreThoseOfAllItsOperands) {
    auto const lamp = equal("component_type", "Lamp");
    EXPECT_EQ(demand(either({equal("name", "c"), lamp, equal("name", "b"), equal("name", "c"), lamp})), "b c ; lamp");
    EXPECT_EQ(demand(either({equal("name", "c"), equal("engine", "x")})), "nothing");
}

TEST_F(Demands, AreNotDerivedFromOtherPredicates) {
    for (auto const& condition :
         {alike("component_ref", "b"), not_equal("component_type", "Lamp"), not_equal("component_ref", "b"),
          like("component_type", "Lamp"), less("component_type", "Lamp"), contrary(equal("component_ref", "b")),
          equal("component_ref/@authority", "OMG"), equal("component_ref[2]", "b"), equal("engine", "x"),
          between("component_type", "Lamp", "Lamp"), scanned(equal("component_ref", "b")), both({equal("engine", "x")})})
        EXPECT_EQ(demand(condition), "nothing");
}

namespace {

// Random numbers that are the same for a seed on every machine.
class Drawing {
public:
    explicit Drawing(std::uint64_t seed) : random_{seed} {}

    std::size_t below(std::size_t bound) { return random_() % bound; }
    bool once_in(std::size_t times) { return below(times) == 0; }
    std::string const& of(std::vector<std::string> const& texts) { return texts[below(texts.size())]; }

    std::string ref() { return "c" + std::to_string(below(30)); }

    Condition condition(int depth = 3) {
        auto const kind = depth == 0 ? 0 : below(10);
        if (kind < 5) return leaf();
        if (kind == 5) return contrary(condition(depth - 1));
        std::vector<Condition> operands;
        for (auto i = below(3) + 1; i > 0; --i) operands.push_back(condition(depth - 1));
        return kind < 8 ? both(std::move(operands)) : either(std::move(operands));
    }

    // A component of one of several types: some in other case, and some in another engine.
    Part part(std::string ref) {
        static std::vector<Part> const kinds{navigation, speech, detection, localization};
        auto part = named(std::move(ref), kinds[below(kinds.size())]);
        if (once_in(3)) part.profile.object.identifier = "URN:X-ROIS:DEF:COMPONENT:omg::" + part.profile.object.name;
        if (once_in(4)) part.engine = "annex";
        return part;
    }

    QueryExpression sorted_at_times(Condition condition) {
        if (!once_in(4)) return condition;
        return {std::move(condition), {{reference(of({"name", "component_type", "status"})), SortOrder::descending}}};
    }

private:
    Condition leaf() {
        static std::vector<std::string> const types{"Navigation", "SpeechSynthesis", "persondetection", "PERSONLOCALIZATION",
                                                    "Lamp"};
        switch (below(12)) {
            case 0:
            case 1:
                return equal("component_ref", ref());
            case 2:
                return resource(ref());
            case 3:
            case 4:
            case 5:
                return of_type(of(types));
            case 6:
                return equal_reversed(urn(of(types)), "component_type");
            case 7:
                return equal("engine", of({"main", "annex"}));
            case 8:
                return equal("status", of({"READY", "BUSY", "WARNING"}));
            case 9:
                return equal("bound", of({"true", "false"}));
            case 10:
                return group({.types = {of(types)}, .aliases = {}, .filter = {}, .members = {}});
            default:
                return less("component_ref", ref());
        }
    }

    std::mt19937_64 random_;
};

std::vector<Part> drawn_parts(Drawing& drawing) {
    std::vector<Part> parts;
    for (int i = 0; i < 30; ++i) parts.push_back(drawing.part("c" + std::to_string(i)));
    for (auto i = parts.size(); i > 1; --i) std::swap(parts[i - 1], parts[drawing.below(i)]);
    return parts;
}

// A world that changes: components are replaced and bound, and some are not READY.
struct Changing {
    Drawing drawing;
    World world{drawn_parts(drawing), EngineSettings{}};
    Application desk = world.connect();
    Application hall = world.connect();

    explicit Changing(std::uint64_t seed) : drawing{seed} {}

    void change() {
        auto const ref = drawing.ref();
        switch (drawing.below(4)) {
            case 0:
                world.change({ref}, {drawing.part(ref)});
                break;
            case 1:
                world[ref].status_now = drawing.once_in(2) ? ComponentStatus::ready : ComponentStatus::warning;
                break;
            case 2:
                hall.bind(ref);
                break;
            default:
                hall.release(ref);
        }
    }
};

// The results of all operations with a condition, as text.
std::string found_by(Application& desk, QueryExpression const& condition) {
    std::string words;
    for (auto const& ref : desk.search(condition)) words += ref + " ";
    words += "profile:";
    for (auto const& component : desk.ask(GetProfile{condition}).components) words += " " + component.ref;
    for (auto const* type : {"route", "component_status", "get_parameter"}) {
        auto const reply = desk.query(type, condition);
        words += "; " + std::string{type} + ": " + std::string{to_text(reply.return_code)} + " " + reply.component_ref.code +
                 " " + in_words(reply.results.parameters);
    }
    auto const bound = desk.bind_any(condition);
    desk.release(bound);
    return words + "; bound: " + bound;
}

}  // namespace

TEST(LookingUp, FindsTheSameAsASearchOfAll) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        Changing changing{seed};
        for (int i = 0; i < 40; ++i) {
            auto const condition = changing.drawing.sorted_at_times(changing.drawing.condition());
            auto by_all = condition;
            by_all.filter = scanned(*condition.filter);
            ASSERT_EQ(found_by(changing.desk, condition), found_by(changing.desk, by_all)) << "seed " << seed << ", " << i;
            changing.change();
        }
    }
}

namespace {

// The subscriptions of an application, by their meaning, and the events that it received, as text.
class Subscriber {
public:
    explicit Subscriber(World& world) : application_{world.connect()} {}

    // Returns whether the subscription was accepted.
    bool subscribe(int number, std::string const& event_type, Condition condition) {
        auto const reply = application_.subscribe(event_type, std::move(condition));
        if (reply.return_code == ReturnCode::ok) numbers_.emplace_back(reply.subscribe_id, number);
        return reply.return_code == ReturnCode::ok;
    }

    void unsubscribe(std::size_t place) {
        if (numbers_.empty()) return;
        auto const id = numbers_[place % numbers_.size()].first;
        application_.unsubscribe(id);
        std::erase_if(numbers_, [&](auto const& each) { return each.first == id; });
    }

    std::vector<std::string> received() {
        std::vector<std::string> words;
        for (auto const& [sequence, notification] : application_.notifications().read(after_, 100'000)) {
            after_ = sequence;
            if (auto const* error = std::get_if<ReceiveError>(&notification->body))
                words.push_back("error of " + error->component_ref->code);
            auto const* event = std::get_if<ReceiveEvent>(&notification->body);
            if (event == nullptr) continue;
            auto const known = std::ranges::find(numbers_, event->subscribe_id, [](auto const& each) { return each.first; });
            words.push_back(event->event_type + " of " + event->component_ref.code + " by " + std::to_string(known->second));
        }
        return words;
    }

private:
    Application application_;
    std::uint64_t after_ = 0;
    std::vector<std::pair<SubscribeId, int>> numbers_;
};

}  // namespace

TEST(LookingUp, NotifiesTheSameSessionsAsASearchOfAll) {
    std::size_t received = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        Changing changing{seed};
        auto& drawing = changing.drawing;
        Subscriber one{changing.world}, other{changing.world};
        for (int i = 0; i < 60; ++i) {
            auto const event_type = drawing.of({"person_detected", "person_localized", "reached_target"});
            auto const condition = drawing.condition();
            ASSERT_EQ(one.subscribe(i, event_type, condition), other.subscribe(i, event_type, scanned(condition)));
            if (drawing.once_in(3)) {
                auto const place = drawing.below(60);
                one.unsubscribe(place);
                other.unsubscribe(place);
            }
            changing.change();
            auto& component = changing.world[drawing.ref()];
            component.fires("person_detected");
            component.fires("person_localized");
            component.fires("reached_target");
            component.reports(ErrorType::user_defined_error, "it broke");
            auto const words = one.received();
            ASSERT_EQ(words, other.received()) << "seed " << seed << ", " << i;
            received += words.size();
        }
    }
    EXPECT_GT(received, 1'000u) << "otherwise the test proves little";
}

TEST(Subscriptions, ByRefAndByTypeAreNotifiedInTheOrderOfSubscribing) {
    World world{detection, named("other", detection)};
    Subscriber desk{world};
    desk.subscribe(1, "person_detected", equal("component_ref", "detection"));
    desk.subscribe(2, "person_detected", equal("engine", "main"));
    desk.subscribe(3, "person_detected", of_type("PersonDetection"));
    desk.subscribe(4, "person_detected", either({equal("name", "detection"), of_type("PERSONDETECTION")}));
    desk.subscribe(5, "person_detected", either({equal("name", "other"), equal("name", "detection")}));
    world["detection"].fires("person_detected");
    EXPECT_THAT(desk.received(), ElementsAre("person_detected of detection by 1", "person_detected of detection by 2",
                                             "person_detected of detection by 3", "person_detected of detection by 4",
                                             "person_detected of detection by 5"));
    for (auto const place : {3, 2, 1}) desk.unsubscribe(static_cast<std::size_t>(place));
    world["other"].fires("person_detected");
    EXPECT_THAT(desk.received(), ElementsAre("person_detected of other by 5"));
    desk.unsubscribe(1);
    world["other"].fires("person_detected");
    EXPECT_THAT(desk.received(), IsEmpty());
}

}  // namespace rois
