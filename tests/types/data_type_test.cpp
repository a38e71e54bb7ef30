// Decision 26: data types and their values.
#include "types/data_type.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace rois {

using testing::HasSubstr;

namespace {

DataType type(std::string const& code) {
    return DataType::of({.code = code, .authority = {}, .codebook_ref = {}, .version = {}});
}

// Return whether the value, or the values, are valid for the type.
bool is(std::string const& code, std::string const& value) { return !why_not(type(code), std::vector{value}); }
bool are(std::string const& code, std::vector<std::string> const& values) { return !why_not(type(code), values); }
std::string reason(std::string const& code, std::vector<std::string> const& values) {
    return why_not(type(code), values).value_or("");
}

}  // namespace

TEST(DataType, IsRecognizedInAnyCaseAndByAllItsNames) {
    for (auto const* code : {"int", "INT", "integer", " Integer ", "UnlimitedNatural", "urn:x-rois:def:DataType:ATR::Integer",
                             "URN:X-ROIS:DEF:DATATYPE:atr::int"})
        EXPECT_EQ(type(code), type("int")) << code;
    for (auto const* code : {"double", "real", "urn:x-rois:def:DataType:ATR::Real"})
        EXPECT_EQ(type(code), type("double")) << code;
    for (auto const* code : {"bool", "Boolean"}) EXPECT_EQ(type(code), type("bool")) << code;
    for (auto const* code : {"string", "String"}) EXPECT_EQ(type(code), type("string")) << code;
    for (auto const* code : {"DateTime", "datetime"}) EXPECT_EQ(type(code), type("DateTime")) << code;
    for (auto const* code : {"RoISIdentifier", "rois_identifier"}) EXPECT_EQ(type(code), type("RoISIdentifier")) << code;
    for (auto const* code : {"Component_Status", "componentstatus"}) EXPECT_EQ(type(code), type("Component_Status")) << code;
    for (auto const* code : {"Stream_Status", "stream_status", "StreamStatus", "urn:x-rois:def:DataType:OMG::Stream_Status"})
        EXPECT_EQ(type(code), type("Stream_Status")) << code;
}

TEST(DataType, IsRecognizedByItsNamesInProgramsAndSchemas) {
    for (auto const* code : {"long", "Long", "xsd:int", "xs:integer", "xsd:long", "xs:unsignedInt", "xs:nonNegativeInteger",
                             "xsd:short", "urn:x-other:types:int", "http://www.w3.org/2001/XMLSchema#int"})
        EXPECT_EQ(type(code), type("int")) << code;
    for (auto const* code :
         {"Float", "float", "Double", "xsd:double", "xs:float", "xsd:decimal", "urn:ogc:def:dataType:OGC::Real"})
        EXPECT_EQ(type(code), type("double")) << code;
    for (auto const* code : {"xsd:boolean", "xs:boolean"}) EXPECT_EQ(type(code), type("bool")) << code;
    for (auto const* code : {"xsd:string", "xs:anyURI", "CharacterString", "xsd:token", "RLS::Data"})
        EXPECT_EQ(type(code), type("string")) << code;
    EXPECT_EQ(type("xsd:dateTime"), type("DateTime"));
    EXPECT_EQ(type("xs:date"), type("Date"));
    EXPECT_EQ(type("xs:time"), type("Time"));
}

TEST(DataType, IsAListInAnyForm) {
    for (auto const* code : {"Set<Integer>", "List<int>", "list< Long >", "Sequence<xsd:int>", "seq<Integer>", "xsd:int[]"})
        EXPECT_EQ(type(code), type("int[]")) << code;
    EXPECT_EQ(type("Set<RoIS_Identifier>"), type("RoISIdentifier[]"));
    EXPECT_EQ(to_text(type("List<Shade>")), "Shade[]");
    EXPECT_EQ(type("List<List<int>>").base, BaseType::other);
    EXPECT_EQ(type("Set<>").base, BaseType::other);
    EXPECT_EQ(type("Map<int>").base, BaseType::other);
    EXPECT_FALSE(type("Map<int>").list);
}

TEST(DataType, IsKnownIfItIsDefined) {
    for (auto const* code : {"int", "Set<Date>", "string[]", "NBestType", "urn:x-rois:def:DataType:OMG::LatticeType"})
        EXPECT_TRUE(is_known(type(code))) << code;
    for (auto const* code : {"Shade", "Shade[]", "urn:x-other:Shade", "Map<int>"}) EXPECT_FALSE(is_known(type(code))) << code;
}

TEST(DataType, WholeNumbersHaveTheRangeOfTheirName) {
    for (auto const* code : {"UnlimitedNatural", "xsd:nonNegativeInteger", "xs:unsignedInt", "unsignedShort"}) {
        EXPECT_TRUE(is(code, "0")) << code;
        EXPECT_FALSE(is(code, "-1")) << code;
    }
    EXPECT_EQ(reason("UnlimitedNatural", {"-1"}), "'-1' is not of the type UnlimitedNatural");
    EXPECT_FALSE(is("UnlimitedNatural[]", "1 -1"));
    EXPECT_FALSE(is("positiveInteger", "0"));
    EXPECT_TRUE(is("xsd:long", "9223372036854775807"));
    EXPECT_FALSE(is("xsd:long", "9223372036854775808"));
    EXPECT_TRUE(is("unsignedInt", "4294967295"));
    EXPECT_FALSE(is("unsignedInt", "4294967296"));
    EXPECT_FALSE(is("short", "32768"));
    EXPECT_FALSE(is("byte", "-129"));
}

TEST(DataType, DatesAndTimesMustExist) {
    for (auto const* text : {"2026-11-20", " 2024-02-29 ", "2026-11-20Z", "2026-11-20+09:00"})
        EXPECT_TRUE(is("Date", text)) << text;
    for (auto const* text : {"", "2026-02-30", "2026-11", "2026-11-20T12:00:00Z", "2026-11-20z", "20 November"})
        EXPECT_FALSE(is("Date", text)) << text;
    for (auto const* text : {"12:00:00", " 23:59:59.5 ", "12:00:00Z", "12:00:00.25-03:30"}) EXPECT_TRUE(is("Time", text)) << text;
    for (auto const* text : {"", "24:00:00", "12:60:00", "12:00", "12:00:00.", "noon", "2026-11-20T12:00:00Z"})
        EXPECT_FALSE(is("Time", text)) << text;
}

TEST(DataType, IsWrittenWithItsCanonicalName) {
    EXPECT_EQ(to_text(type("urn:x-rois:def:DataType:ATR::Integer")), "int");
    EXPECT_EQ(to_text(type("REAL[]")), "double[]");
    EXPECT_EQ(to_text(type("Shade")), "Shade");
    EXPECT_EQ(to_text(type("urn:x-rois:def:DataType:ATR::Shade[]")), "Shade[]");
}

TEST(DataType, ComparesBaseListAndUserDefinedName) {
    EXPECT_NE(type("int"), type("double"));
    EXPECT_NE(type("int"), type("int[]"));
    EXPECT_EQ(type("int[]"), type("urn:x-rois:def:DataType:ATR::Integer[]"));
    EXPECT_EQ(type("Shade"), type("SHADE"));
    EXPECT_NE(type("Shade"), type("Colour"));
    EXPECT_EQ(type("urn:x-other:Shade").base, BaseType::other);
    EXPECT_EQ(type("").base, BaseType::other);
}

TEST(DataType, IntHas32Bits) {
    for (auto const* text : {"0", "-0", "7", "+5", " 7 ", "\t7\r\n", "007", "2147483647", "-2147483648"})
        EXPECT_TRUE(is("int", text)) << text;
    for (auto const* text : {"", " ", "2147483648", "-2147483649", "99999999999999999999", "1.0", "1e3", "0x10", "1 2", "+-5",
                             "++5", "- 5", "+", "-", "seven", "7,000"})
        EXPECT_FALSE(is("int", text)) << text;
}

TEST(DataType, DoubleHasTheValuesOfXmlSchema) {
    for (auto const* text : {"0", "-1.5", "+1.5", ".5", "5.", " 1e3 ", "1E-3", "1e+3", "INF", "-INF", "NaN", "1e308"})
        EXPECT_TRUE(is("double", text)) << text;
    for (auto const* text :
         {"", "1e400", "-1e400", "inf", "nan", "Infinity", "-NaN", "0x1p3", "1e", "e3", ".", "1,5", "1.5.1", "+-1", "++1", "1 2"})
        EXPECT_FALSE(is("double", text)) << text;
}

TEST(DataType, BoolHasTheValuesOfXmlSchema) {
    for (auto const* text : {"true", "false", "1", "0", " true "}) EXPECT_TRUE(is("bool", text)) << text;
    for (auto const* text : {"", "True", "FALSE", "yes", "2", "true false"}) EXPECT_FALSE(is("bool", text)) << text;
}

TEST(DataType, StringAcceptsAnyText) {
    for (auto const* text : {"", " ", "a b", "\xE3\x81\x82"}) EXPECT_TRUE(is("string", text)) << text;
}

TEST(DataType, DateTimeMustExist) {
    for (auto const* text : {"2026-11-20T12:00:00Z", "2026-11-20T12:00:00.1Z", "2026-11-20T12:00:00.123456789Z",
                             " 2026-11-20T12:00:00Z ", "2024-02-29T23:59:59Z", "2000-02-29T00:00:00Z"})
        EXPECT_TRUE(is("DateTime", text)) << text;
    for (auto const* text : {"", "2026-02-30T12:00:00Z", "2026-02-29T12:00:00Z", "1900-02-29T12:00:00Z", "2026-13-01T12:00:00Z",
                             "2026-00-01T12:00:00Z", "2026-01-00T12:00:00Z", "2026-11-20T24:00:00Z", "2026-11-20T12:60:00Z",
                             "2026-11-20T12:00:60Z", "2026-11-20T12:00:00", "2026-11-20T12:00:00.Z", "2026-11-20 12:00:00Z",
                             "2026-11-20", "26-11-20T12:00:00Z", "2026-11-20T12:00:00z", "2026-11-20T12:00:00Zulu", "yesterday"})
        EXPECT_FALSE(is("DateTime", text)) << text;
}

TEST(DataType, DateTimeMayHaveAnOffset) {
    for (auto const* offset : {"+09:00", "-03:30", "+00:00", "-00:00", "+14:00", "-14:00", "+13:59"})
        EXPECT_TRUE(is("DateTime", std::string{"2026-11-20T12:00:00"} + offset)) << offset;
    for (auto const* offset :
         {"+9:00", "+0900", "+09", "09:00", "+14:01", "+15:00", "+99:99", "-23:00", "+09:60", "+09:00Z", "+aa:00"})
        EXPECT_FALSE(is("DateTime", std::string{"2026-11-20T12:00:00.5"} + offset)) << offset;
    EXPECT_FALSE(is("DateTime", "0001-01-01T00:00:00+01:00")) << "its year in UTC does not have four digits";
    EXPECT_FALSE(is("DateTime", "9999-12-31T23:59:59-01:00"));
    EXPECT_TRUE(is("DateTime", "9999-12-31T23:59:59+01:00"));
}

TEST(DataType, IdentifierMustNotBeEmpty) {
    EXPECT_TRUE(is("RoISIdentifier", "visitor_1"));
    EXPECT_TRUE(is("RoISIdentifier", "urn:x-test:visitor 1"));
    EXPECT_FALSE(is("RoISIdentifier", ""));
    EXPECT_FALSE(is("RoISIdentifier", "  "));
}

TEST(DataType, ComponentStatusIsOneOfFive) {
    for (auto const* text : {"UNINITIALIZED", "READY", "BUSY", "WARNING", " ERROR "})
        EXPECT_TRUE(is("Component_Status", text)) << text;
    EXPECT_FALSE(is("Component_Status", "ready"));
    EXPECT_FALSE(is("Component_Status", "FINE"));
}

TEST(DataType, StreamStatusIsOneOfFive) {
    for (auto const* text :
         {"STREAMING_NOT_RUNNING", "STREAMING_NOT_CONNECTED", "STREAMING_RUNNING", " STREAMING_SUSPENDED ", "STREAMING_RESUMED"})
        EXPECT_TRUE(is("Stream_Status", text)) << text;
    EXPECT_FALSE(is("Stream_Status", "RUNNING"));
    EXPECT_FALSE(is("Stream_Status", "streaming_running"));
    EXPECT_EQ(reason("stream_status[]", {"FINE"}), "'FINE' is not of the type Stream_Status");
}

TEST(DataType, UserDefinedTypesAcceptAnyText) { EXPECT_TRUE(is("Shade", "red")); }

TEST(DataType, ASingleValueNeedsExactlyOne) {
    for (auto const* code : {"int", "double", "bool", "string", "DateTime", "RoISIdentifier", "Component_Status", "Shade"}) {
        EXPECT_THAT(reason(code, {}), HasSubstr("needs exactly one value, got 0")) << code;
        EXPECT_THAT(reason(code, {"1", "1"}), HasSubstr("needs exactly one value, got 2")) << code;
    }
}

TEST(DataType, ListsOfNumbersAndBoolsAreOneValue) {
    EXPECT_TRUE(are("int[]", {}));
    EXPECT_TRUE(are("int[]", {""}));
    EXPECT_TRUE(are("int[]", {"  "}));
    EXPECT_TRUE(are("int[]", {"1"}));
    EXPECT_TRUE(are("int[]", {" 1\t2\n -3 "}));
    EXPECT_TRUE(are("double[]", {"1 2.5 INF"}));
    EXPECT_TRUE(are("bool[]", {"true 0"}));
    EXPECT_FALSE(are("int[]", {"1", "2"}));
    EXPECT_FALSE(are("int[]", {"1,2"}));
    EXPECT_FALSE(are("bool[]", {"true maybe"}));
    EXPECT_EQ(reason("int[]", {"1 2147483648 x"}), "'2147483648' is not of the type int");
}

TEST(DataType, ListsOfOtherTypesHaveOneValuePerItem) {
    EXPECT_TRUE(are("string[]", {}));
    EXPECT_TRUE(are("string[]", {"", "one two"}));
    EXPECT_TRUE(are("DateTime[]", {"2026-11-20T12:00:00Z", "2026-11-21T12:00:00Z"}));
    EXPECT_TRUE(are("RoISIdentifier[]", {"a", "b"}));
    EXPECT_TRUE(are("Component_Status[]", {"READY", "BUSY"}));
    EXPECT_TRUE(are("Shade[]", {"red", "green"}));
    EXPECT_FALSE(are("DateTime[]", {"2026-11-20T12:00:00Z 2026-11-21T12:00:00Z"}));
    EXPECT_FALSE(are("RoISIdentifier[]", {"a", ""}));
    EXPECT_EQ(reason("Component_Status[]", {"READY", "FINE"}), "'FINE' is not of the type Component_Status");
}

TEST(DataType, DefaultsAreOneValueOrOnePerItem) {
    auto const values = [](std::string code, std::string_view text) {
        return default_values({.code = std::move(code), .authority = {}, .codebook_ref = {}, .version = {}}, text);
    };
    using List = std::vector<std::string>;
    EXPECT_EQ(values("string", " red  green "), List{" red  green "});
    EXPECT_EQ(values("int[]", "1 2"), List{"1 2"});
    EXPECT_EQ(values("String[]", " red \n green "), (List{"red", "green"}));
    EXPECT_EQ(values("string[]", " "), List{});
    EXPECT_EQ(values("DateTime", "2026-11-20T12:00:00+01:00"), List{"2026-11-20T11:00:00Z"}) << "times are UTC (decision 28)";
    EXPECT_EQ(values("DateTime[]", "2026-11-20T12:00:00+01:00 2026-11-20T12:00:00Z"),
              (List{"2026-11-20T11:00:00Z", "2026-11-20T12:00:00Z"}));
}

}  // namespace rois
