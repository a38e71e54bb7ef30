// A complete proof, and variants with one error each.
#include <gmock/gmock.h>

#include "house/rules.hpp"

namespace rois::house {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

namespace {

std::string replaced(std::string text, std::string const& what, std::string const& by) {
    auto const at = text.find(what);
    EXPECT_NE(at, text.npos) << what;
    return at == text.npos ? text : text.replace(at, what.size(), by);
}

std::string row(std::string const& clause, std::string const& tests = "`Lamp.Shines`", std::string const& state = "done") {
    return "| " + clause + " | what | how | " + tests + " | " + state + " |\n";
}

// A row for everything that has a number: 47 tables, 31 figures, 35 decisions, 4 annexes.
std::string all_rows() {
    std::string text = "| clause | what it asks | how we do it | tests | state |\n|---|---|---|---|---|\n";
    for (int table = 1; table <= 47; ++table) text += row("7.4, table " + std::to_string(table));
    for (int figure = 1; figure <= 31; ++figure) text += row("figure " + std::to_string(figure), "`a_lamp_shines`");
    for (int decision = 1; decision <= 35; ++decision) text += row("decision " + std::to_string(decision), "`lamp.shines`");
    for (auto const* annex : {"annex A", "annex B.1", "annex C", "annex D"}) text += row(annex, "`documents_are_valid`");
    return text;
}

std::string numbered_tests() {
    std::string text;
    for (int decision = 1; decision <= 35; ++decision)
        text += std::string("TEST(Decision") + (decision < 10 ? "0" : "") + std::to_string(decision) + ", Holds) {}\n";
    return text;
}

Tree whole() {
    std::string const head =
        "| document | rows | done | not done | not ours |\n|---|---|---|---|---|\n"
        "| [conformance.md](conformance.md) | 117 | 117 | 0 | 0 |\n| [conformance-xml.md](conformance-xml.md) | 2 | 0 | 1 | 1 |\n"
        "| all | 119 | 117 | 1 | 1 |\n\n";
    return {{"docs/conformance.md", head + all_rows()},
            {"docs/conformance-xml.md", row("C++", "-", "not ours: this is XML") + row("1.2", "-", "not done: too costly")},
            {"docs/conformance-program.md", row("7", "`No.Test`", "some day")},
            {"tests/lamp/lamp_test.cpp", "TEST_F(Lamp, Shines) {}\n// TEST(Lamp, IsGreen)\n" + numbered_tests()},
            {"tests/lamp/shines.sh", ""},
            {"tests/conformance/lamp_checks.cpp",
             "void a_lamp_shines(Context&) {}\n{{\"a_lamp_shines\", \"table 1\", a_lamp_shines},\n{\"an_operation\", \"\"}\n"},
            {"tests/conformance/traffic.cpp", "rules_{{\"documents_are_valid\", \"schemas\"},\n"}};
}

// Returns the complaints after replacing `what` by `by` in one file.
Complaints with(std::string const& file, std::string const& what, std::string const& by) {
    auto tree = whole();
    tree[file] = replaced(tree[file], what, by);
    return against_proof(tree);
}

Complaints in_document(std::string const& what, std::string const& by) { return with("docs/conformance.md", what, by); }

}  // namespace

TEST(Proof, ThatIsCompleteIsAccepted) { EXPECT_THAT(against_proof(whole()), IsEmpty()); }

TEST(Proof, NamesExistingTests) {
    auto const first = "`Lamp.Shines`";
    for (auto const* name : {"Lamp.IsGreen", "Lamp.Shine", "lamp.glows", "an_operation", "a_lamp_glows"}) {
        auto const said = in_document(first, "`Lamp.Shines`, `" + std::string(name) + "`");
        EXPECT_THAT(said, ElementsAre("docs/conformance.md:9: there is no test " + std::string(name)));
    }
    EXPECT_THAT(with("tests/lamp/lamp_test.cpp", "TEST_F(Lamp", "TEST_P(Torch"), testing::SizeIs(47));
}

TEST(Proof, NamesExistingFiles) {
    EXPECT_THAT(in_document("| how |", "| `lamp/shade.cpp`, `lamp/lamp_test.cpp`, `/rois/profile` |"),
                ElementsAre("docs/conformance.md:9: there is no file lamp/shade.cpp",
                            "docs/conformance.md:9: there is no file lamp/lamp_test.cpp"));
    auto tree = whole();
    tree["components/lamp/shade.cpp"] = tree["server/lamp/lamp.cpp"] = "";
    tree["docs/conformance.md"] =
        replaced(tree["docs/conformance.md"], "| how |", "| `lamp/shade.cpp`, `lamp/lamp.cpp`, `docs/conformance.md` |");
    EXPECT_THAT(against_proof(tree), IsEmpty());
}

TEST(Proof, HasItsTestsBetweenBackticks) {
    EXPECT_THAT(in_document("`Lamp.Shines`", "`Lamp.Shines`, Lamp.Burns"),
                ElementsAre("docs/conformance.md:9: write tests between backticks: `Lamp.Shines`, Lamp.Burns"));
}

TEST(Proof, WithoutATestIsRejected) {
    EXPECT_THAT(in_document("`Lamp.Shines`", "-"), ElementsAre("docs/conformance.md:9: 'done' needs a test"));
}

TEST(Proof, KnowsThreeStates) {
    EXPECT_THAT(in_document("| done |\n", "| partly |\n"),
                testing::Contains("docs/conformance.md:9: 'partly' is not a state: done, not done: why, not ours: why"));
    EXPECT_THAT(in_document("| done |\n", "| done: mostly |\n"), ElementsAre("docs/conformance.md:9: 'done' takes no reason"));
    auto const document = "docs/conformance-xml.md";
    EXPECT_THAT(with(document, "not ours: this is XML", "not ours"),
                ElementsAre("docs/conformance-xml.md:1: 'not ours' needs a reason after a colon"));
    EXPECT_THAT(with(document, "not done: too costly", "not done: "),
                ElementsAre("docs/conformance-xml.md:2: 'not done:' needs a reason after a colon"));
}

TEST(Proof, HasARowForEachTableFigureDecisionAndAnnex) {
    for (auto const* what : {"table 1", "table 47", "figure 1", "figure 31", "decision 1", "decision 35", "annex A", "annex D"})
        EXPECT_THAT(in_document(" " + std::string(what) + " |", " clause 9 |"),
                    ElementsAre("docs/conformance.md:1: no row is about " + std::string(what)));
}

TEST(Proof, HasATestWithTheNumberOfEachDecision) {
    EXPECT_THAT(with("tests/lamp/lamp_test.cpp", "Decision07", "Decision7"),
                ElementsAre("docs/conformance.md:1: no test is called Decision07.*"));
}

TEST(Proof, HasCorrectTotals) {
    EXPECT_THAT(in_document("| 117 | 117 | 0 | 0 |", "| 117 | 116 | 1 | 0 |"),
                ElementsAre("docs/conformance.md:3: it should say 117 117 0 0"));
    EXPECT_THAT(in_document("| 2 | 0 | 1 | 1 |", "| 2 | 2 | 0 | 0 |"),
                ElementsAre("docs/conformance.md:4: it should say 2 0 1 1"));
    EXPECT_THAT(in_document("| all | 119 |", "| all | 120 |"), ElementsAre("docs/conformance.md:5: it should say 119 117 1 1"));
    EXPECT_THAT(
        in_document("| [conformance-xml.md](conformance-xml.md) | 2 | 0 | 1 | 1 |\n", ""),
        ElementsAre("docs/conformance.md:1: the summary has no line for [conformance-xml.md](conformance-xml.md): 2 0 1 1"));
    EXPECT_THAT(
        in_document("[conformance-xml.md]", "[conformance-idl.md]"),
        UnorderedElementsAre(HasSubstr("is not a document with rows"), HasSubstr("has no line for [conformance-xml.md]")));
}

}  // namespace rois::house
