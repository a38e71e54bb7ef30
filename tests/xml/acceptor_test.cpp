// The acceptor: which documents it accepts, and that its answers are those of the full validation.
#include <map>
#include <set>

#include "fuzz/comparison.hpp"
#include "fuzz/mutation.hpp"
#include "fuzz/samples.hpp"
#include "xml/speaking.hpp"
#include "xml/tables/acceptor.hpp"

namespace rois::xml {
namespace {

using Outcome = fuzz::Comparison::Outcome;

bool accepted(std::string_view text, DocumentLimits limits = {}) { return Acceptor{schemas(), limits}.accepts(text); }

TEST(Acceptor, AcceptsTheSamplesOfAllOperations) {
    std::set<std::size_t> operations;
    for (auto const& entry : std::filesystem::directory_iterator{samples() / "valid"}) {
        auto const text = file(entry.path());
        auto const answer = read(text);
        EXPECT_EQ(accepted(text), entry.path().filename() != "receive_event_with_results.xml")
            << entry.path() << ": its sequence has 20 digits";
        if (auto const* taken = std::get_if<Request>(&answer)) operations.insert(taken->operation.index());
    }
    EXPECT_EQ(operations.size(), std::variant_size_v<Operation>);
}

TEST(Acceptor, AcceptsAllProfiles) {
    std::filesystem::path const root{ROIS_SOURCE_DIR};
    std::size_t profiles = 0;
    for (auto const& folder : {root / "schemas" / "profiles", root / "components" / "simulation" / "profiles"}) {
        for (auto const& entry : std::filesystem::directory_iterator{folder}) {
            EXPECT_TRUE(accepted(file(entry.path()))) << entry.path();
            ++profiles;
        }
    }
    EXPECT_GT(profiles, 20u);
}

TEST(Acceptor, AcceptsCommonWaysToWriteXml) {
    auto const* const bind = R"(bind xmlns="urn:x-rois:psm:xml:message:1" xmlns:r="http://www.omg.org/spec/RoIS/20240801")";
    for (std::string const& text : std::initializer_list<std::string>{
             std::string{R"(<?xml version="1.0" encoding="UTF-8"?>)"} + "\n" + document("connect"),
             std::string{"<?xml version='1.0' encoding='utf-8'?>\r\n<!-- a client -->\r\n"} + document("connect") +
                 "\n<!-- -->\n",
             "<m:connect xmlns:m='urn:x-rois:psm:xml:message:1' request_id='&lt;&#x20AC;&#10;\xE2\x82\xAC'  />",
             std::string{"<"} + bind + ">\n\t<component_ref r:code='a\tb' r:version=\"'\"></component_ref>\n</bind>",
             std::string{"<"} + bind + "><component_ref xmlns='urn:x-rois:psm:xml:message:1' r:code='a'/></bind>",
             "<p:bind xmlns:p='urn:x-rois:psm:xml:message:1'><q:component_ref xmlns:q='urn:x-rois:psm:xml:message:1' "
             "xmlns:p='http://www.omg.org/spec/RoIS/20240801' p:code='a'/></p:bind>"}) {
        EXPECT_TRUE(accepted(text)) << text;
        EXPECT_TRUE(std::holds_alternative<Request>(read(text))) << text;
    }
}

TEST(Acceptor, LeavesUnusualXmlToXerces) {
    auto const old = [](std::string text) { return text.replace(text.find("20240801"), 8, "20151201"); };
    for (auto const& text :
         {"\xEF\xBB\xBF" + document("connect"), "<?xml version='1.0' standalone='yes'?>" + document("connect"),
          "<?xml version = '1.0'?>" + document("connect"), old(document("connect")), document("connect", {}, " request_id = 'a'"),
          document("connect", {}, " xsi:schemaLocation='a b'"), document("query", "<query_type><![CDATA[a]]></query_type>"),
          document("query", "<query_type>a</query_type\n>"), document("query", "<query_type>a<!-- b --></query_type>"),
          document("connect", {}, " xmlns:xml='http://www.w3.org/XML/1998/namespace'"),
          document("connect", {}, " xmlns:\xC3\xA9='http://www.opengis.net/fes/2.0'")}) {
        EXPECT_FALSE(accepted(text)) << text;
        EXPECT_TRUE(std::holds_alternative<Request>(read(text))) << text;
    }
}

// Returns a request with `depth` nested Not elements.
std::string nested(std::size_t depth) {
    std::string text;
    for (std::size_t i = 0; i < depth; ++i) text += "<fes:Not>";
    text += "<fes:PropertyIsNull><fes:ValueReference>a</fes:ValueReference></fes:PropertyIsNull>";
    for (std::size_t i = 0; i < depth; ++i) text += "</fes:Not>";
    return document("search", "<condition><fes:Filter>" + text + "</fes:Filter></condition>");
}

TEST(Acceptor, EnforcesTheLimits) {
    EXPECT_TRUE(accepted(nested(59)));
    EXPECT_FALSE(accepted(nested(60)));
    EXPECT_TRUE(accepted(nested(2), {.depth = 7}));
    EXPECT_FALSE(accepted(nested(2), {.depth = 6}));
    EXPECT_TRUE(accepted(nested(2), {.elements = 7}));
    EXPECT_FALSE(accepted(nested(2), {.elements = 6}));
    EXPECT_TRUE(accepted(document("connect", {}, " request_id=''"), {.attributes = 7}));
    EXPECT_FALSE(accepted(document("connect", {}, " request_id=''"), {.attributes = 6}));
    EXPECT_TRUE(accepted(document("connect", {}, " request_id=''"), {.name_length = 10}));
    EXPECT_FALSE(accepted(document("connect", {}, " request_id=''"), {.name_length = 9}));
    auto const declaring = [](std::string const& prefix) {
        return document("bind", "<component_ref xmlns:" + prefix + "='http://www.opengis.net/fes/2.0' rois:code='a'/>");
    };
    EXPECT_TRUE(accepted(declaring("f"), {.namespaces = 7}));
    EXPECT_FALSE(accepted(declaring("f"), {.namespaces = 6}));
    EXPECT_FALSE(accepted(document("connect"), {.namespaces = 5}));
    auto const corner = [](std::size_t blanks) {
        return document(
            "search",
            "<condition><fes:Filter><fes:BBOX><fes:ValueReference>a</fes:ValueReference><gml:Envelope><gml:lowerCorner>1 1" +
                std::string(blanks, ' ') +
                "</gml:lowerCorner><gml:upperCorner>2 2</gml:upperCorner></gml:Envelope></fes:BBOX></fes:Filter></condition>");
    };
    std::size_t const most = (8 << 10) - std::string_view{"<gml:lowerCorner>1 1"}.size();
    for (auto const blanks : {most, most + 1}) {
        EXPECT_EQ(accepted(corner(blanks)), blanks == most);
        EXPECT_EQ(std::holds_alternative<Request>(read(corner(blanks))), blanks == most);
    }
}

// The acceptor takes repeated start tags as a whole (KnownTag). Verdict and tree must not change.
TEST(Acceptor, ReadsEveryDocumentLikeTheFirst) {
    auto const fes = [](std::string const& prefix, std::string const& name_space, std::string const& inside) {
        return "<search xmlns='urn:x-rois:psm:xml:message:1' xmlns:" + prefix + "='http://www.opengis.net/" + name_space + "'>" +
               inside + "</search>";
    };
    auto const null_of = [](std::string const& reference) {
        return "<condition><f:Filter><f:PropertyIsNull>" + reference + "</f:PropertyIsNull></f:Filter></condition>";
    };
    std::string const a = "<f:ValueReference>a</f:ValueReference>";
    std::vector<std::string> documents{
        fes("f", "fes/2.0", null_of(a)),
        fes("f", "gml/3.2", null_of(a)),
        fes("f", "fes/2.0", null_of(a)),
        fes("g", "fes/2.0", null_of(a)),
        fes("f", "fes/2.0", "<condition xmlns:f='http://www.opengis.net/gml/3.2'><f:Filter/></condition>"),
        fes("f", "fes/2.0", null_of("<f:ValueReference xmlns:f='http://www.opengis.net/gml/3.2'>a</f:ValueReference>")),
        fes("f", "fes/2.0", null_of("<f:ValueReference xmlns:g='http://www.opengis.net/gml/3.2'>a</f:ValueReference>")),
        fes("f", "fes/2.0", null_of("<f:ValueReference></f:ValueReference>")),
        fes("f", "fes/2.0", null_of("<f:ValueReference>a&amp;b</f:ValueReference>")),
        fes("f", "fes/2.0", null_of("<f:ValueReference>a]]>b</f:ValueReference>")),
        fes("f", "fes/2.0", null_of("<f:ValueReference>a]b</f:ValueReference>")),
        fes("f", "fes/2.0", null_of("<f:ValueReference>a</f:ValueReferencf>")),
        fes("f", "fes/2.0", null_of("<f:ValueReference>a</f:ValueReference")),
        fes("f", "fes/2.0", null_of("<f:ValueReference>a<b/></f:ValueReference>")),
        fes("f", "fes/2.0", null_of("<f:ValueReference>a")),
        fes("f", "fes/2.0", null_of(a + a)),
        fes("f", "fes/2.0", a),
        fes("f", "fes/2.0", null_of(a)).substr(0, 120)};
    auto const samples = fuzz::samples();
    documents.insert(documents.end(), samples.begin(), samples.end());
    Acceptor kept{schemas(), {}};
    std::size_t taken = 0;
    for (int twice = 0; twice < 2; ++twice) {
        for (auto const& text : documents) {
            Acceptor fresh{schemas(), {}};
            ASSERT_EQ(kept.accepts(text), fresh.accepts(text)) << text;
            if (!fresh.accepts(text)) continue;
            ++taken;
            ASSERT_EQ(kept.tree() == nullptr, fresh.tree() == nullptr) << text;
            if (fresh.tree() != nullptr) {
                ASSERT_TRUE(*kept.tree() == *fresh.tree()) << text;
            }
        }
    }
    EXPECT_GT(taken, 200u);
    EXPECT_TRUE(kept.accepts(documents.front()));
    EXPECT_FALSE(kept.accepts(documents.at(1)));
    EXPECT_FALSE(kept.accepts(documents.at(5)));
}

TEST(Acceptor, EnforcesTheLimitsForCachedTags) {
    Acceptor deep{schemas(), {.depth = 7}}, many{schemas(), {.elements = 7}};
    for (auto* const each : {&deep, &many}) {
        for (int twice = 0; twice < 2; ++twice) {
            EXPECT_TRUE(each->accepts(nested(2)));
            EXPECT_FALSE(each->accepts(nested(3)));
        }
    }
}

// Verdict, reason and place must be the same.
TEST(Acceptor, GivesTheSameAnswersAsFullValidation) {
    RequestReader fast{schemas()}, full{schemas(), {}, Validation::full};
    std::map<Validation, std::size_t> ways;
    for (auto const& text : fuzz::samples()) {
        auto const quickly = fast.read(text), slowly = full.read(text);
        EXPECT_EQ(full.checked(), Validation::full);
        ++ways[fast.checked().value_or(Validation::full)];
        ASSERT_EQ(quickly.index(), slowly.index()) << text;
        if (auto const* fault = std::get_if<Fault>(&quickly)) {
            EXPECT_EQ(encode(*fault), encode(std::get<Fault>(slowly))) << text;
        } else {
            EXPECT_EQ(std::get<Request>(quickly).operation.index(), std::get<Request>(slowly).operation.index());
            EXPECT_EQ(std::get<Request>(quickly).request_id, std::get<Request>(slowly).request_id);
        }
    }
    EXPECT_GT(ways[Validation::fast], 100u);
    EXPECT_GT(ways[Validation::full], 100u);
    fast.read(std::string((1 << 20) + 1, ' '));
    EXPECT_FALSE(fast.checked());
}

// fuzz-validator does the same with millions of documents.
TEST(Acceptor, NeverAcceptsADocumentThatXercesRejects) {
    fuzz::Comparison comparison{schemas()};
    fuzz::Mutation mutation{fuzz::samples(), 20261121};
    for (int i = 0; i < 25'000; ++i) {
        auto document = mutation.next();
        auto const outcome = comparison.look_at(document);
        ASSERT_NE(outcome, Outcome::wrong) << document << '\n' << comparison.complaint();
        if (outcome == Outcome::both) mutation.learn(std::move(document));
    }
    EXPECT_GT(comparison.count(Outcome::both), 2'000u);
    EXPECT_GT(comparison.count(Outcome::both), 10 * comparison.count(Outcome::xerces_only));
    EXPECT_GT(comparison.count(Outcome::neither), 10'000u);
}

}  // namespace
}  // namespace rois::xml
