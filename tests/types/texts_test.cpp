#include "types/text/texts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "types/text/listing.hpp"

namespace rois {

TEST(Texts, AreEqualIgnoringTheCaseOfAscii) {
    EXPECT_TRUE(equal_ignoring_case("", ""));
    EXPECT_TRUE(equal_ignoring_case("SSML_text", "ssml_TEXT"));
    EXPECT_FALSE(equal_ignoring_case("a", "ab"));
    EXPECT_FALSE(equal_ignoring_case("[", "{")) << "they differ only in the bit of the case";
    EXPECT_FALSE(equal_ignoring_case("\xC3\x84", "\xC3\xA4")) << "not letters of ASCII";
    EXPECT_EQ(lower_case("OMG::Navigation \xC3\x84"), "omg::navigation \xC3\x84");
}

TEST(Texts, AreTrimmedOfTheWhiteSpaceOfXml) {
    EXPECT_EQ(trimmed(" \t\r\n a b \n"), "a b");
    EXPECT_EQ(trimmed(""), "");
    EXPECT_EQ(trimmed(" \t"), "");
    EXPECT_EQ(trimmed("\v a"), "\v a");
}

TEST(Texts, AreNumbersOnlyAsAWhole) {
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

TEST(Texts, AreQuotedOnOneLineOfUtf8) {
    EXPECT_EQ(quoted("a\xC2\x85"
                     "b\xE2\x80\xA8"
                     "c\xE2\x80\xA9"
                     "d\xE2\x80\xAE"
                     "e\xE2\x81\xA6"
                     "f"),
              "'a b c d e f'");
    EXPECT_EQ(quoted("a\xFF\x16\x03\x80z"), "'a?  ?z'");
    EXPECT_EQ(quoted("\xC3\xA9\xE2\x82\xAC\xF0\x9F\x99\x82"), "'\xC3\xA9\xE2\x82\xAC\xF0\x9F\x99\x82'");
}

TEST(Texts, AreCutWhenTheyAreQuoted) {
    EXPECT_EQ(quoted("abcdef", 6), "'abcdef'");
    EXPECT_EQ(quoted("abcdefg", 6), "'abcdef...'");
    std::string_view const long_text =
        "0123456789012345678901234567890123456789012345678901234567890123456789012345678901234567890";
    EXPECT_EQ(quoted(long_text), "'" + std::string{long_text.substr(0, 80)} + "...'");
    EXPECT_EQ(quoted("ab\xE3\x81\x82", 4), "'ab...'") << "whole characters only";
    EXPECT_EQ(quoted("ab\xE3\x81\x82", 5), "'ab\xE3\x81\x82'");
    EXPECT_EQ(quoted("\xE3\x81\x82", 1), "'...'");
}

TEST(Texts, FoldTheCaseOfManyScripts) {
    EXPECT_EQ(folded_case("Hello, WORLD 42"), "hello, world 42");
    EXPECT_EQ(folded_case("GRÜẞE ÉCOLE ŁÓDŹ Ÿ"), folded_case("grüße école łódź ÿ"));
    EXPECT_EQ(folded_case("ΑΘΉΝΑΣ ΈΊΌΎΏ"), folded_case("αθήνας έίόύώ"));
    EXPECT_EQ(folded_case("МОСКВА Ёлка"), "москва ёлка");
    EXPECT_EQ(folded_case("ＲｏＩＳ"), "ｒｏｉｓ") << "full-width";
    EXPECT_EQ(folded_case("受付はこちらです ×÷"), "受付はこちらです ×÷") << "characters without case are unchanged";
    EXPECT_EQ(folded_case("a\xFFZ\xC3"), "a\xFFz\xC3") << "invalid bytes are unchanged";
}

TEST(Texts, AreSplitIntoCharacters) {
    std::string_view text = "a\u00E9\u3042\U0001F600\xFF";
    EXPECT_EQ(take_character(text), U'a');
    EXPECT_EQ(take_character(text), U'\u00E9');
    EXPECT_EQ(take_character(text), U'\u3042');
    EXPECT_EQ(take_character(text), U'\U0001F600');
    EXPECT_EQ(take_character(text), char32_t{0xFF}) << "a stray byte";
    EXPECT_EQ(take_character(text), std::nullopt);
}

TEST(Texts, AreListedUpToFifty) {
    std::vector<std::string> const two{"desk", "entrance"};
    EXPECT_EQ(first_listed(two), "desk, entrance");
    EXPECT_EQ(first_listed(two, [](auto const& text) { return rois::quoted(text); }), "'desk', 'entrance'");
    std::vector<std::string> const many(60, "a");
    EXPECT_TRUE(first_listed(many).ends_with("a, a and 10 more"));
    EXPECT_EQ(first_listed(many).size(), std::string_view{" and 10 more"}.size() + 50 * 3 - 2);
}

}  // namespace rois
