// Hostile documents: they leave no memory in use, they take little time, and each of many thousands is answered.
#include <algorithm>
#include <chrono>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "kit/cpu_time.hpp"
#include "xml/speaking.hpp"
#include "xml/validation/grammars.hpp"
#include "xml/validation/validator.hpp"

namespace rois::xml {
namespace {

TEST(HostileDocument, TwentyThousandUnknownNamesLeaveNoMemoryInUse) {
    Validator validator{schemas()};
    auto& pool = *schemas()->grammars().pool().getURIStringPool();
    ASSERT_FALSE(validator.objection_to(document("connect")));  // the first document creates the parser
    auto const names = pool.getStringCount();
    auto const bytes = validator.bytes_in_use();
    for (int i = 0; i < 20'000; ++i) {
        auto const fresh = std::string{"n"}.append(std::to_string(i));
        auto const unknown = document("bind", std::string{"<"}.append(fresh).append(" ").append(fresh).append("a='1'/>"));
        EXPECT_TRUE(validator.objection_to(unknown)) << unknown;
    }
    EXPECT_FALSE(validator.objection_to(document("connect")));
    EXPECT_EQ(validator.bytes_in_use(), bytes);
    EXPECT_EQ(pool.getStringCount(), names);
}

TEST(HostileDocument, NamesOfValidDocumentsUseBoundedMemory) {
    Validator validator{schemas()};
    auto& pool = *schemas()->grammars().pool().getURIStringPool();
    ASSERT_FALSE(validator.objection_to(document("connect")));
    auto const names = pool.getStringCount();
    std::size_t most = 0;
    for (int i = 0; i < 20'000; ++i) {
        std::ostringstream written;
        written << "<p" << i << ":bind xmlns:p" << i << "='urn:x-rois:psm:xml:message:1' request_id='" << i << "'><p" << i
                << ":component_ref xmlns:r" << i << "='http://www.omg.org/spec/RoIS/20240801' r" << i << ":code='" << i
                << "'/></p" << i << ":bind>";
        auto const valid = written.str();
        ASSERT_FALSE(validator.objection_to(valid)) << valid;
        most = std::max(most, validator.bytes_in_use());
    }
    EXPECT_LT(most, 1u << 20);
    EXPECT_EQ(pool.getStringCount(), names);
}

TEST(HostileDocument, ForeignNamespacesNeverReachTheGrammars) {
    RequestReader reader{schemas()};
    auto& pool = *schemas()->grammars().pool().getURIStringPool();
    auto const names = pool.getStringCount();
    for (int i = 0; i < 2'000; ++i) {
        auto const answer = reader.read(document("bind", std::string{"<a xmlns='urn:"}.append(std::to_string(i)).append("'/>")));
        EXPECT_EQ(std::get<Fault>(answer).code, FaultCode::invalid);
    }
    EXPECT_EQ(pool.getStringCount(), names);
}

// A document at one of the limits. `how` names the limit, for messages.
struct Worst {
    std::string how;
    std::string text;
};

// Repeats `one` as often as it fits between the others into a document of 1 MiB.
std::string filled(std::string const& before, std::string const& one, std::string const& after) {
    auto const room = DocumentLimits{}.bytes - before.size() - after.size();
    std::string text = before;
    for (auto times = room / one.size(); times > 0; --times) text += one;
    return text + after;
}

std::string times(std::size_t many, std::string const& one) {
    std::string all;
    for (std::size_t i = 0; i < many; ++i) all += one;
    return all;
}

std::vector<Worst> worst_documents() {
    DocumentLimits const limits;
    std::string const whole = document("search", "|");
    auto const bar = whole.find('|');
    auto const begin = whole.substr(0, bar), end = whole.substr(bar + 1);
    std::string const filter = begin + "<condition><fes:Filter>", filter_end = "</fes:Filter></condition>" + end;
    auto const comparison = [](std::string const& literal, std::string const& attributes = {}) {
        return "<fes:PropertyIsEqualTo" + attributes + "><fes:ValueReference>name</fes:ValueReference><fes:Literal>" + literal +
               "</fes:Literal></fes:PropertyIsEqualTo>";
    };
    auto const nots = limits.depth - 5;                  // besides search, condition, Filter, the comparison and its reference
    auto const comparisons = (limits.elements - 4) / 3;  // besides search, condition, Filter and Or
    std::string declarations;
    for (std::size_t i = 1; i < limits.attributes; ++i)
        declarations += " xmlns:n" + std::to_string(i) + "='http://www.omg.org/spec/RoIS/20240801'";
    std::string many_names, nested_names, closing;
    for (std::size_t i = 1; i < limits.elements; ++i) {
        auto const name = "n" + std::to_string(i) + std::string(180, 'x');
        many_names += "<" + name + "/>";
        if (i >= limits.depth) continue;
        nested_names += "<" + name + times(limits.attributes, " a" + name + "=''") + ">";
        closing.insert(0, "</" + name + ">");
    }
    return {
        {"nested predicates", filter + times(nots, "<fes:Not>") + comparison("x") + times(nots, "</fes:Not>") + filter_end},
        {"many predicates", filter + "<fes:Or>" + times(comparisons, comparison("x")) + "</fes:Or>" + filter_end},
        {"namespace declarations", filled(filter + "<fes:Or>", comparison("x", declarations), "</fes:Or>" + filter_end)},
        {"many names", begin + many_names + end},
        {"long names, nested, with the same attribute again and again", begin + nested_names + closing + end},
        {"a long text", filled(filter + comparison("x").substr(0, comparison("").find("</fes:Literal>")), "x",
                               comparison("").substr(comparison("").find("</fes:Literal>")) + filter_end)},
        {"references", filled(filter + comparison("x").substr(0, comparison("").find("</fes:Literal>")), "&amp;",
                              comparison("").substr(comparison("").find("</fes:Literal>")) + filter_end)},
        {"white space", filled(begin, " \n", end)},
        {"comments", filled(begin, "<!---->", end)},
        {"CDATA sections", filled(begin, "<![CDATA[ ]]>", end)},
        {"begun comments", filled(begin, "<!--", end)},
        {"begun tags", filled(begin, "<", end)},
        {"ended tags", filled(begin, "</search>", end)},
        {"lines without an end", filled(begin, "<a\n", end)},
    };
}

TEST(HostileDocument, AtTheLimitsTakesLessThanASecond) {
    constexpr std::chrono::seconds most{kit::has_sanitizer ? 15 : 1};
    for (auto const validation : {Validation::fast, Validation::full}) {
        RequestReader reader{schemas(), {}, validation};
        reader.read(document("connect"));  // the first document creates the parser
        for (auto const& [how, text] : worst_documents()) {
            ASSERT_LE(text.size(), DocumentLimits{}.bytes) << how;
            EXPECT_LT(kit::cpu_time_of([&] { reader.read(text); }), most) << how;
        }
    }
}

TEST(HostileDocument, IsReadIfItOnlyReachesALimit) {
    for (auto const& [how, text] : worst_documents()) {
        if (how != "nested predicates" && how != "many predicates" && how != "a long text" && how != "comments") continue;
        auto const answer = read(text);
        auto const* const refused = std::get_if<Fault>(&answer);
        EXPECT_EQ(refused, nullptr) << how << ": " << refused->reason;
    }
}

// Returns the text with one to three random changes.
std::string mutant(std::string text, std::vector<std::string> const& all, std::mt19937& random) {
    auto const any = [&](std::size_t below) { return static_cast<std::size_t>(random() % std::max<std::size_t>(below, 1)); };
    static std::vector<std::string> const pieces{"<",
                                                 ">",
                                                 "/>",
                                                 "\"",
                                                 "'",
                                                 "&",
                                                 "&#0;",
                                                 "<!--",
                                                 "-->",
                                                 "<![CDATA[",
                                                 "]]>",
                                                 "<?x?>",
                                                 "<!DOCTYPE a>",
                                                 "xmlns=''",
                                                 "xsi:nil='true'",
                                                 ":",
                                                 "\xC3",
                                                 std::string(1, '\0'),
                                                 "rois:",
                                                 "xsi:type=''",
                                                 "<a>",
                                                 "</a>",
                                                 " ",
                                                 "\xEF\xBB\xBF",
                                                 "&lt;",
                                                 "20151201"};
    for (auto changes = 1 + any(3); changes > 0; --changes) {
        auto const at = any(text.size());
        switch (any(7)) {
            case 0:
                text[std::min(at, text.size() - 1)] = static_cast<char>(random() % 256);
                break;
            case 1:
                text.erase(at, 1 + any(20));
                break;
            case 2:
                text.insert(at, pieces[any(pieces.size())]);
                break;
            case 3:
                text.insert(any(text.size()), text.substr(at, any(80)));
                break;
            case 4:
                text = text.substr(0, at);
                break;
            case 5: {
                auto const& other = all[any(all.size())];
                text.insert(at, other.substr(any(other.size()), any(200)));
                break;
            }
            default: {  // move a tag
                auto const one = text.find('<', at), two = text.find('>', one);
                if (two != text.npos) text.insert(any(text.size()), text.substr(one, two - one + 1)).erase(one, 1);
            }
        }
        if (text.empty()) text = "<";
    }
    return text;
}

std::vector<std::string> all_samples() {
    std::vector<std::string> all;
    for (auto const* folder : {"valid", "invalid"}) {
        std::vector<std::filesystem::path> paths;
        for (auto const& entry : std::filesystem::directory_iterator{samples() / folder}) paths.push_back(entry.path());
        std::ranges::sort(paths);  // independent of the order of the directory
        for (auto const& path : paths) all.push_back(file(path));
    }
    return all;
}

TEST(HostileDocument, EveryMutantIsAnswered) {
    auto const samples = all_samples();
    std::mt19937 random{20261121};
    RequestReader reader{schemas()};
    std::size_t taken = 0;
    std::size_t refused[3] = {};
    for (int i = 0; i < 20'000; ++i) {
        auto const text = mutant(samples[random() % samples.size()], samples, random);
        auto const answer = reader.read(text);
        if (std::holds_alternative<Request>(answer)) {
            ++taken;
            continue;
        }
        auto const& fault = std::get<Fault>(answer);
        ASSERT_LE(static_cast<int>(fault.code), 2) << text;
        ++refused[static_cast<int>(fault.code)];
        ASSERT_TRUE(fault.place) << text;
        auto const place = fault.place.value_or(Place{});
        ASSERT_TRUE(place.line >= 1 && place.column >= 1) << text;
        ASSERT_LE(place.line, static_cast<std::uint64_t>(std::ranges::count(text, '\n') + std::ranges::count(text, '\r') + 1))
            << text;
        ASSERT_LE(place.column, text.size() + 1) << text;
        ASSERT_TRUE(!fault.reason.empty() && fault.reason.size() < 2'000) << text;
        if (i % 20 == 0) {
            EXPECT_EQ(problem("fault", encode(fault)), "") << text;
        }
    }
    EXPECT_GT(taken, 20u);
    for (auto const count : refused) EXPECT_GT(count, 20u);
}

TEST(HostileDocument, ThreadsReadWithTheSameSchemas) {
    auto const samples = all_samples();
    auto const compiled = schemas();
    std::vector<std::vector<std::size_t>> outcomes(4);
    {
        std::vector<std::jthread> threads;
        threads.reserve(outcomes.size());
        for (auto& mine : outcomes) {
            threads.emplace_back([&mine, &samples, &compiled] {
                RequestReader reader{compiled};
                for (int round = 0; round < 3; ++round) {
                    for (auto const& text : samples) {
                        auto const answer = reader.read(text);
                        auto const* fault = std::get_if<Fault>(&answer);
                        mine.push_back(fault == nullptr ? 0 : std::hash<std::string>{}(fault->reason));
                    }
                }
            });
        }
    }
    for (auto const& each : outcomes) EXPECT_EQ(each, outcomes[0]);
}

}  // namespace
}  // namespace rois::xml
