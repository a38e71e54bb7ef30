#include "types/texts.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rois {

TEST(Texts, AreEqualIgnoringTheCaseOfAscii) {
    EXPECT_TRUE(equal_ignoring_case("", ""));
    EXPECT_TRUE(equal_ignoring_case("SSML_text", "ssml_TEXT"));
    EXPECT_FALSE(equal_ignoring_case("a", "ab"));
    EXPECT_FALSE(equal_ignoring_case("[", "{")) << "these differ by the bit that makes letters small";
    EXPECT_FALSE(equal_ignoring_case("\xC3\x84", "\xC3\xA4")) << "no letters of ASCII";
    EXPECT_EQ(lower_case("OMG::Navigation \xC3\x84"), "omg::navigation \xC3\x84");
}

TEST(Texts, AreTrimmedOfTheWhiteSpaceOfXml) {
    EXPECT_EQ(trimmed(" \t\r\n a b \n"), "a b");
    EXPECT_EQ(trimmed(""), "");
    EXPECT_EQ(trimmed(" \t"), "");
    EXPECT_EQ(trimmed("\v a"), "\v a");
}

TEST(Texts, AreNumbersAsAWhole) {
    EXPECT_EQ(to_int(" +5 "), 5);
    EXPECT_EQ(to_int("-2147483648"), -2147483648);
    EXPECT_EQ(to_int("2147483648"), std::nullopt);
    EXPECT_EQ(to_int("5x"), std::nullopt);
    EXPECT_EQ(to_int(""), std::nullopt);
    EXPECT_EQ(to_double(" +2.5e1 "), 25.0);
    EXPECT_EQ(to_double("-INF"), -HUGE_VAL);
    EXPECT_EQ(to_double("INF"), HUGE_VAL);
    EXPECT_TRUE(std::isnan(to_double("NaN").value()));
    EXPECT_EQ(to_double("1e400"), std::nullopt);
    EXPECT_EQ(to_double("infinity"), std::nullopt);
    EXPECT_EQ(to_double("2.5 "), 2.5);
    EXPECT_EQ(to_double("2.5 1"), std::nullopt);
}

TEST(Texts, AreQuotedWithoutControlCharacters) {
    EXPECT_EQ(quoted("navigation"), "'navigation'");
    EXPECT_EQ(quoted(""), "''");
    EXPECT_EQ(quoted(std::string_view{"a\r\nb\0c\x7F\x1B[31m", 12}), "'a  b c  [31m'");
}

TEST(Texts, AreQuotedAtABearableLength) {
    EXPECT_EQ(quoted("abcdef", 6), "'abcdef'");
    EXPECT_EQ(quoted("abcdefg", 6), "'abcdef...'");
    std::string_view const long_text =
        "0123456789012345678901234567890123456789012345678901234567890123456789012345678901234567890";
    EXPECT_EQ(quoted(long_text), "'" + std::string{long_text.substr(0, 80)} + "...'");
    EXPECT_EQ(quoted("ab\xE3\x81\x82", 4), "'ab...'") << "no character is cut";
    EXPECT_EQ(quoted("ab\xE3\x81\x82", 5), "'ab\xE3\x81\x82'");
    EXPECT_EQ(quoted("\xE3\x81\x82", 1), "'...'");
}

}  // namespace rois
