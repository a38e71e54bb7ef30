// Comparisons in conditions: numbers, times, texts, lists, missing values and patterns.
#include "engine/conditions/conditions.hpp"
#include "engine/world.hpp"

namespace rois {

namespace {

// Two lamps with parameters that the test sets, and a component without these parameters.
struct Comparisons : testing::Test {
    World world{named("dim", desk_lamp), named("bright", desk_lamp), navigation};
    Application desk = world.connect();

    Comparisons() {
        desk.bind("dim");
        desk.bind("bright");
    }

    void set(std::string const& lamp, std::string const& name, std::string const& type, std::vector<std::string> values) {
        ASSERT_EQ(desk.set_parameter(lamp, {value(name, type, std::move(values))}).return_code, ReturnCode::ok);
    }
    std::vector<std::string> found(Condition condition) { return desk.search(std::move(condition)); }
    std::string reason(Condition condition) { return desk.ask(Search{std::move(condition)}).reason; }
};

TEST_F(Comparisons, NumbersAreComparedAsNumbers) {
    set("dim", "count", "int", {"9"});
    set("bright", "count", "int", {"+10"});
    EXPECT_THAT(found(less("Property/count", "10")), ElementsAre("dim"));
    EXPECT_THAT(found(greater("Property/count", "9.5")), ElementsAre("bright"));
    EXPECT_THAT(found(equal("Property/count", "10.0")), ElementsAre("bright"));
    EXPECT_THAT(found(not_equal("Property/count", " 9 ")), ElementsAre("bright"));
    EXPECT_THAT(found(compared("count", Comparator::less_or_equal, "9")), ElementsAre("dim"));
    EXPECT_THAT(found(compared("count", Comparator::greater_or_equal, "9")), ElementsAre("bright", "dim"));
}

TEST_F(Comparisons, TheSidesMayStandInEitherOrder) {
    set("dim", "count", "int", {"9"});
    set("bright", "count", "int", {"10"});
    auto const literal_first = [](Comparator comparator, std::string text) {
        return Condition{PropertyComparison{comparator, literal(std::move(text)), reference("count")}};
    };
    EXPECT_THAT(found(literal_first(Comparator::less, "9")), ElementsAre("bright")) << "9 is less than the count";
    EXPECT_THAT(found(literal_first(Comparator::greater_or_equal, "9")), ElementsAre("dim"));
}

TEST_F(Comparisons, ReferencesAreComparedWithEachOther) {
    set("dim", "count", "int", {"1"});
    set("dim", "ratio", "double", {"0.5"});
    set("bright", "count", "int", {"1"});
    set("bright", "ratio", "double", {"1e3"});
    EXPECT_THAT(found({PropertyComparison{Comparator::less, reference("count"), reference("ratio")}}), ElementsAre("bright"));
}

TEST_F(Comparisons, TimesAreComparedAsTimes) {
    set("dim", "since", "DateTime", {"2026-11-20T12:00:00Z"});
    set("bright", "since", "DateTime", {"2026-11-20T12:30:00+09:00"});
    EXPECT_THAT(found(less("since", "2026-11-20T04:00:00Z")), ElementsAre("bright"));
    EXPECT_THAT(found(equal("since", "2026-11-20T21:00:00+09:00")), ElementsAre("dim"));
    auto const noon = *to_utc("2026-11-20T12:00:00Z");
    EXPECT_THAT(found({PropertyComparison{Comparator::equal, reference("since"), {Period{noon, noon}}}}), ElementsAre("dim"));
}

TEST_F(Comparisons, TextsAreComparedAsNumbersWhenBothSidesAreAndElseAsTexts) {
    set("dim", "label", "string", {"9"});
    set("bright", "label", "string", {"b"});
    EXPECT_THAT(found(less("label", "10")), ElementsAre("dim"));
    EXPECT_THAT(found(less("label", "a")), ElementsAre("dim"));
    EXPECT_THAT(found(greater("label", "a")), ElementsAre("bright"));
    EXPECT_THAT(found(equal("component_ref", "dim")), ElementsAre("dim"));
}

TEST_F(Comparisons, NamesAreNeverNumbers) {
    World halls{named("1", navigation), named("01", navigation)};
    auto guide = halls.connect();
    EXPECT_THAT(guide.search(equal("component_ref", "1")), ElementsAre("1"));
}

TEST_F(Comparisons, TrueEqualsOneAndFalseEqualsZero) {
    set("dim", "lit", "bool", {"0"});
    set("bright", "lit", "bool", {"true"});
    EXPECT_THAT(found(equal("lit", "1")), ElementsAre("bright"));
    EXPECT_THAT(found(equal("lit", "false")), ElementsAre("dim"));
    EXPECT_THAT(found(equal("bound", "0")), ElementsAre("navigation"));
}

TEST_F(Comparisons, WithALiteralOfAnotherTypeAreRefused) {
    EXPECT_EQ(reason(less("count", "many")), "the condition compares a number with 'many', which is not one");
    EXPECT_EQ(reason(less("since", "noon")), "the condition compares a time with 'noon', which is not one");
    EXPECT_EQ(reason(equal("lit", "yes")), "the condition compares a true or false with 'yes', which is not one");
    EXPECT_THAT(reason({PropertyComparison{Comparator::equal, reference("label"), {spot(1, 2)}}}), HasSubstr("geometry"));
}

TEST_F(Comparisons, AreCaseSensitiveByDefault) {
    set("dim", "label", "string", {"Grün"});
    set("bright", "label", "string", {"GRÜN"});
    EXPECT_THAT(found(equal("label", "GRÜN")), ElementsAre("bright"));
    EXPECT_THAT(found(alike("label", "grün")), ElementsAre("bright", "dim"));
}

TEST_F(Comparisons, WhiteSpaceAroundTextsDoesNotCount) {
    set("dim", "labels", "string[]", {" hi\n"});
    for (auto const* text : {" hi\n", "hi", "  hi"}) {
        EXPECT_THAT(found(equal("labels", text)), ElementsAre("dim")) << text;
        EXPECT_THAT(found(alike("labels", text)), ElementsAre("dim")) << text;
    }
    EXPECT_THAT(found(like("labels", "\n h?\n")), ElementsAre("dim"));
    EXPECT_THAT(found(equal("labels", "h i")), IsEmpty());
}

TEST_F(Comparisons, SeveralValuesMatchAnyAllOrOne) {
    set("dim", "counts", "int[]", {"1 2 2"});
    set("bright", "counts", "int[]", {"3 4"});
    auto const below = [](std::string text, MatchAction action) {
        return compared("counts", Comparator::less, std::move(text), action);
    };
    EXPECT_THAT(found(below("4", MatchAction::any)), ElementsAre("bright", "dim"));
    EXPECT_THAT(found(below("4", MatchAction::all)), ElementsAre("dim"));
    EXPECT_THAT(found(below("4", MatchAction::one)), ElementsAre("bright"));
    EXPECT_THAT(found(compared("counts", Comparator::equal, "2", MatchAction::one)), IsEmpty()) << "two of the values are 2";
}

TEST_F(Comparisons, OneOfSeveralValuesIsChosenByItsPlace) {
    set("dim", "labels", "string[]", {"a", "b"});
    set("dim", "counts", "int[]", {"7 8"});
    EXPECT_THAT(found(equal("Property/labels[2]", "b")), ElementsAre("dim"));
    EXPECT_THAT(found(equal("labels[1]", "b")), IsEmpty());
    EXPECT_THAT(found(equal("counts[2]", "8")), ElementsAre("dim"));
    EXPECT_THAT(found(is_null("labels[3]")), ElementsAre("bright", "dim", "navigation"));
}

TEST_F(Comparisons, MissingValuesNeverMatch) {
    set("dim", "count", "int", {"1"});
    EXPECT_THAT(found(not_equal("count", "5")), ElementsAre("dim"));
    EXPECT_THAT(found(compared("count", Comparator::equal, "1", MatchAction::all)), ElementsAre("dim"));
    EXPECT_THAT(found(contrary(equal("count", "1"))), ElementsAre("bright", "navigation"));
}

TEST_F(Comparisons, BoundariesAreIncluded) {
    set("dim", "count", "int", {"5"});
    set("bright", "count", "int", {"10"});
    EXPECT_THAT(found(between("count", "5", "9")), ElementsAre("dim"));
    EXPECT_THAT(found(between("count", "5.1", "10.0")), ElementsAre("bright"));
    EXPECT_THAT(found(between("count", "9", "5")), IsEmpty());
    EXPECT_THAT(found(between("component_ref", "a", "c")), ElementsAre("bright"));
    EXPECT_THAT(reason(between("count", "low", "9")), HasSubstr("'low'"));
    set("dim", "counts", "int[]", {"1 9"});
    EXPECT_THAT(found(between("counts", "3", "7")), IsEmpty()) << "one and the same value must be between";
}

TEST_F(Comparisons, NullIsWithoutAValue) {
    set("dim", "count", "int", {"5"});
    EXPECT_THAT(found(is_null("count")), ElementsAre("bright", "navigation"));
    EXPECT_THAT(found(contrary(is_null("count"))), ElementsAre("dim"));
    EXPECT_THAT(found(is_null("component_ref")), IsEmpty());
    EXPECT_THAT(reason({PropertyIsNull{literal("5")}}), HasSubstr("value reference"));
}

TEST_F(Comparisons, NilMayRequireTheReasonOfAMissingValue) {
    set("dim", "count", "int", {"5"});
    EXPECT_THAT(found(is_nil("count", "")), ElementsAre("bright", "navigation"));
    EXPECT_THAT(found(is_nil("count", "missing")), ElementsAre("bright"));
    EXPECT_THAT(found(is_nil("count", "inapplicable")), ElementsAre("navigation"));
    EXPECT_THAT(found(is_nil("count", "withheld")), IsEmpty());
    EXPECT_THAT(reason(is_nil("count", "lost")), HasSubstr("'lost'"));
}

TEST_F(Comparisons, APatternHasWildCards) {
    EXPECT_THAT(found(like("component_ref", "*i*")), ElementsAre("bright", "dim", "navigation"));
    EXPECT_THAT(found(like("component_ref", "d?m")), ElementsAre("dim"));
    EXPECT_THAT(found(like("component_ref", "d?")), IsEmpty());
    EXPECT_THAT(found(like("component_ref", "*")), ElementsAre("bright", "dim", "navigation"));
    EXPECT_THAT(found(like("component_ref", "")), IsEmpty());
    EXPECT_THAT(found(like("component_ref", "bri*ght*")), ElementsAre("bright")) << "a wild card matches an empty text";
    EXPECT_THAT(found({PropertyIsLike{literal("na*"), reference("name"), "*", "?", "!"}}), ElementsAre("navigation"));
    EXPECT_THAT(found({PropertyIsLike{reference("name"), literal("d%"), "%", "_", "\\"}}), ElementsAre("dim"));
}

TEST_F(Comparisons, APatternIsCaseSensitiveByDefault) {
    set("dim", "label", "string", {"Please HELP Élodie"});
    EXPECT_THAT(found(like("label", "*help*")), IsEmpty());
    EXPECT_THAT(found(like("label", "*help*", Letters::ignored)), ElementsAre("dim"));
    EXPECT_THAT(found(like("label", "*éLODIE", Letters::ignored)), ElementsAre("dim"));
    EXPECT_THAT(found(like("component_type", "*::LAMP")), ElementsAre("bright", "dim")) << "types are not case-sensitive";
}

TEST_F(Comparisons, APatternsCharactersMayBeEscaped) {
    set("dim", "label", "string", {"50*?"});
    set("bright", "label", "string", {"50ab"});
    EXPECT_THAT(found(like("label", "50!*!?")), ElementsAre("dim"));
    EXPECT_THAT(found(like("label", "50??")), ElementsAre("bright", "dim"));
    set("bright", "label", "string", {"!"});
    EXPECT_THAT(found(like("label", "!!")), ElementsAre("bright"));
    EXPECT_THAT(found(like("label", "!")), ElementsAre("bright")) << "at the end, it matches itself";
}

TEST_F(Comparisons, APatternCountsCharactersAndNotBytes) {
    set("dim", "label", "string", {"受付です"});
    EXPECT_THAT(found(like("label", "受?です")), ElementsAre("dim"));
    EXPECT_THAT(found(like("label", "????")), ElementsAre("dim"));
    EXPECT_THAT(found({PropertyIsLike{reference("label"), literal("受＊"), "＊", "？", "！"}}), ElementsAre("dim"));
}

TEST_F(Comparisons, AnInvalidPatternIsRefused) {
    auto const with = [](std::string wild, std::string single, std::string escape) {
        return Condition{PropertyIsLike{reference("name"), literal("d*"), std::move(wild), std::move(single), std::move(escape)}};
    };
    EXPECT_THAT(reason(with("", "?", "!")), HasSubstr("wildCard"));
    EXPECT_THAT(reason(with("*", "??", "!")), HasSubstr("singleChar"));
    EXPECT_THAT(reason(with("*", "?", "no")), HasSubstr("escapeChar"));
    EXPECT_THAT(reason(with("*", "*", "!")), HasSubstr("three different"));
    EXPECT_THAT(reason({PropertyIsLike{reference("name"), reference("engine"), "*", "?", "!"}}), HasSubstr("literal"));
    EXPECT_THAT(reason(like("name", std::string(1'001, 'a'))), HasSubstr("1000"));
}

// Backtracking would practically never end here.
TEST_F(Comparisons, AHostilePatternIsMatchedQuickly) {
    set("dim", "label", "string", {std::string(60'000, 'a')});
    std::string stars;
    for (int i = 0; i < 400; ++i) stars += "*a?";
    EXPECT_THAT(found(like("label", stars + "b")), IsEmpty());
    EXPECT_THAT(found(like("label", stars + "*")), ElementsAre("dim"));
}

TEST_F(Comparisons, ValuesThatAreTooLongCountAsMissing) {
    set("dim", "label", "string", {std::string(64 * 1'024, 'a')});
    EXPECT_THAT(found(like("label", "a*")), ElementsAre("dim"));
    set("dim", "label", "string", {std::string(64 * 1'024 + 1, 'a')});
    EXPECT_THAT(found(like("label", "a*")), IsEmpty());
}

TEST_F(Comparisons, ListsOfTooManyPairsNeverMatch) {
    auto const numbers = [](int count) {
        std::string text;
        for (int i = 0; i < count; ++i) text += "7 ";
        return text;
    };
    Condition const with_itself{PropertyComparison{Comparator::equal, reference("counts"), reference("counts")}};
    set("dim", "counts", "int[]", {numbers(300)});
    set("bright", "counts", "int[]", {numbers(1'000)});
    EXPECT_THAT(found(with_itself), ElementsAre("dim"));
    EXPECT_THAT(found(equal("counts", "7")), ElementsAre("bright", "dim")) << "comparing one value with many is allowed";
}

TEST_F(Comparisons, TooManyPredicatesAreRefused) {
    EXPECT_THAT(found(both(std::vector<Condition>(255, equal("name", "dim")))), ElementsAre("dim"));
    EXPECT_THAT(reason(both(std::vector<Condition>(256, equal("name", "dim")))), HasSubstr("more than 256 predicates"));
}

}  // namespace
}  // namespace rois
