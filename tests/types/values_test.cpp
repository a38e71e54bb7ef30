// Functions that make parameters, codes and their texts, and the comparison of conditions.
#include "types/values.hpp"

#include <gmock/gmock.h>

#include "types/codes.hpp"
#include "types/condition.hpp"
#include "types/data_type.hpp"
#include "types/messages.hpp"

namespace rois {

using testing::ElementsAre;

TEST(Values, HaveTheTypeCodesOfTheProfiles) {
    auto const type_and_values = [](Parameter const& p) {
        auto words = p.name + ":" + p.data_type_ref.code;
        for (auto const& value : p.values) words += " " + value;
        return words;
    };
    EXPECT_EQ(type_and_values(integer("number", -3)), "number:int -3");
    EXPECT_EQ(type_and_values(boolean("lit", true)), "lit:bool true");
    EXPECT_EQ(type_and_values(boolean("lit", false)), "lit:bool false");
    EXPECT_EQ(type_and_values(text("label", "a b")), "label:string a b");
    EXPECT_EQ(type_and_values(texts("labels", {"a", "b"})), "labels:string[] a b");
    EXPECT_EQ(type_and_values(date_time("since", Utc{})), "since:DateTime 1970-01-01T00:00:00.000Z");
    EXPECT_EQ(type_and_values(status_of("status", ComponentStatus::busy)), "status:Component_Status BUSY");
    EXPECT_EQ(type_and_values(reference("person_ref", "p1")), "person_ref:RoISIdentifier p1");
    EXPECT_EQ(type_and_values(references("person_ref", {"p1", "p2"})), "person_ref:RoISIdentifier[] p1 p2");
    EXPECT_EQ(type_and_values(positions("position", {"1, 2, 3"}, "hall")), "position:string[] 1, 2, 3");
}

TEST(Values, AreValidForTheirTypes) {
    for (auto const& p :
         {integer("a", 2147483647), boolean("a", true), text("a", ""), texts("a", {}), date_time("a", Utc{}),
          status_of("a", ComponentStatus::ready), reference("a", "x"), references("a", {}), positions("a", {}, "")})
        EXPECT_EQ(why_not(DataType::of(p.data_type_ref), p.values), std::nullopt) << p.data_type_ref.code;
}

TEST(Values, HaveTheirCodebook) {
    EXPECT_EQ(reference("person_ref", "p1", "urn:visitors").data_type_ref.codebook_ref, "urn:visitors");
    EXPECT_EQ(references("person_ref", {}, "urn:visitors").data_type_ref.codebook_ref, "urn:visitors");
    EXPECT_EQ(positions("position", {}, "hall").data_type_ref.codebook_ref, "hall");
}

TEST(Values, AreFoundByNameInAnyCase) {
    ParameterList const list{integer("a", 1), integer("B", 2)};
    EXPECT_EQ(find(list, "b"), &list[1]);
    EXPECT_EQ(find(list, "c"), nullptr);
    EXPECT_EQ(find({}, "a"), nullptr);
}

TEST(Codes, HaveTheTextsOfTheSpecification) {
    using enum ReturnCode;
    std::vector<std::string_view> texts;
    for (auto code : {ok, error, bad_parameter, unsupported, out_of_resources, timeout}) texts.push_back(to_text(code));
    EXPECT_THAT(texts, ElementsAre("OK", "ERROR", "BAD_PARAMETER", "UNSUPPORTED", "OUT_OF_RESOURCES", "TIMEOUT"));
    texts.clear();
    for (auto status : {CompletedStatus::ok, CompletedStatus::error, CompletedStatus::abort, CompletedStatus::out_of_resources,
                        CompletedStatus::timeout})
        texts.push_back(to_text(status));
    EXPECT_THAT(texts, ElementsAre("OK", "ERROR", "ABORT", "OUT_OF_RESOURCES", "TIMEOUT"));
    texts.clear();
    for (auto type : {ErrorType::engine_internal_error, ErrorType::component_internal_error, ErrorType::component_not_responding,
                      ErrorType::user_defined_error})
        texts.push_back(to_text(type));
    EXPECT_THAT(texts, ElementsAre("ENGINE_INTERNAL_ERROR", "COMPONENT_INTERNAL_ERROR", "COMPONENT_NOT_RESPONDING",
                                   "USER_DEFINED_ERROR"));
    texts.clear();
    for (auto status : {ComponentStatus::uninitialized, ComponentStatus::ready, ComponentStatus::busy, ComponentStatus::warning,
                        ComponentStatus::error})
        texts.push_back(to_text(status));
    EXPECT_THAT(texts, ElementsAre("UNINITIALIZED", "READY", "BUSY", "WARNING", "ERROR"));
    EXPECT_EQ(to_text(FaultCode::not_well_formed), "not_well_formed");
    EXPECT_EQ(to_text(FaultCode::no_session), "no_session");
    EXPECT_EQ(to_text(FaultCode::shutting_down), "shutting_down");
}

TEST(Conditions, AreEqualWhenTheirPartsAre) {
    Condition const a{PropertyComparison{Comparator::equal, {ValueReference{"name"}}, {Literal{"x"}}}};
    Condition const b{PropertyComparison{Comparator::equal, {Literal{"x"}}, {ValueReference{"name"}}}};
    EXPECT_EQ(a, a);
    EXPECT_NE(a, b);
    EXPECT_EQ((Condition{And{{a, b}}}), (Condition{And{{a, b}}}));
    EXPECT_NE((Condition{And{{a, b}}}), (Condition{Or{{a, b}}}));
    EXPECT_NE((Condition{And{{a, b}}}), (Condition{And{{b, a}}}));
}

}  // namespace rois
