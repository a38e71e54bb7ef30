#include <algorithm>
#include <array>
#include <regex>
#include <set>

#include "house/rules.hpp"
#include "house/text.hpp"

namespace rois::house {

namespace {

constexpr auto summary = "docs/conformance.md";
constexpr std::array<std::string_view, 3> known_states{"done", "not done", "not ours"};

// | clause | what it asks | how we do it | tests | state |
struct Row {
    std::string document;
    std::size_t line;
    std::string clause;
    std::string how;
    std::string tests;
    std::string state;
};

// The numbered items of the specification, and the last number.
struct Numbered {
    std::string word;
    int last;
};
std::array<Numbered, 3> const numbered{{{"table", 47}, {"figure", 31}, {"decision", 35}}};
std::array<std::string, 4> const annexes{"annex A", "annex B", "annex C", "annex D"};

bool is_proof(std::string_view file) {
    return file.starts_with("docs/conformance") && file.ends_with(".md") && file != "docs/conformance-program.md";
}

// The texts between the bars, without surrounding white space.
std::vector<std::string> cells(std::string const& line) {
    static std::regex const cell(R"re(\|\s*([^|]*[^|\s])?\s*(?=\|))re");
    std::vector<std::string> found;
    if (!line.starts_with('|')) return found;
    for (std::sregex_iterator at(line.begin(), line.end(), cell), end; at != end; ++at) found.push_back((*at)[1]);
    return found;
}

bool is_head(std::vector<std::string> const& row) {
    return row.front() == "clause" || row.front() == "document" || row.front().starts_with("--");
}

// A line of the summary: | [conformance.md](conformance.md) | rows | done | not done | not ours |, or the sums of "all".
bool is_count(std::vector<std::string> const& row) { return row.size() == 5 && (row[0] == "all" || row[0].starts_with('[')); }

std::vector<Row> rows(Tree const& tree) {
    std::vector<Row> found;
    for (auto const& [file, text] : tree) {
        if (!is_proof(file)) continue;
        for_each_line(text, [&, &document = file](std::string const& line, std::size_t number) {
            auto const row = cells(line);
            if (row.size() == 5 && !is_head(row) && !is_count(row))
                found.push_back({document, number, row[0], row[2], row[3], row[4]});
        });
    }
    return found;
}

// "not done" for "not done: too costly"; empty for an unknown state.
std::string_view kind_of(std::string_view state) {
    auto const kind = state.substr(0, state.find(':'));
    return std::ranges::find(known_states, kind) == known_states.end() ? "" : kind;
}

// `Suite.Name` of a test, `folder.script` of a script, `a_check` of rois-conformance.
std::set<std::string> all_tests(Tree const& tree) {
    static std::regex const test(R"re(\s*TEST(?:_F|_P)?\(\s*(\w+)\s*,\s*(\w+)\s*\).*)re");
    static std::regex const script(R"re(tests/(\w+)/(\w+)[.]sh)re");
    static std::regex const check(R"re(\{"([a-z0-9_]+)", ")re");
    std::set<std::string> names;
    for (auto const& [file, text] : tree) {
        std::smatch match;
        if (std::regex_match(file, match, script)) names.insert(match[1].str() + "." + match[2].str());
        if (!file.starts_with("tests/") || !file.ends_with(".cpp")) continue;
        for_each_line(code_alone(text), [&](std::string const& line, std::size_t) {
            std::smatch found;
            if (line.find("TEST") != line.npos && std::regex_match(line, found, test))
                names.insert(found[1].str() + "." + found[2].str());
        });
        if (!file.starts_with("tests/conformance/")) continue;
        // A check has a function with its name; a rule for all messages has none.
        bool const of_functions = file.ends_with("_checks.cpp");
        for_each_line(text, [&, &source = text](std::string const& line, std::size_t) {
            for (std::sregex_iterator at(line.begin(), line.end(), check), end; at != end; ++at)
                if (!of_functions || source.find("void " + (*at)[1].str() + "(Context") != source.npos) names.insert((*at)[1]);
        });
    }
    return names;
}

void judge(Row const& row, std::set<std::string> const& tests, Complaints& complaints) {
    static std::regex const name(R"re(`([^`]+)`)re");
    auto const here = at(row.document, row.line);
    auto const kind = kind_of(row.state);
    if (kind.empty()) complaints.push_back(here + "'" + row.state + "' is not a state: done, not done: why, not ours: why");
    if (kind != "done" && !kind.empty() && row.state.size() < kind.size() + 3)
        complaints.push_back(here + "'" + row.state + "' needs a reason after a colon");
    if (kind == "done" && row.state != kind) complaints.push_back(here + "'done' takes no reason");
    std::sregex_iterator found(row.tests.begin(), row.tests.end(), name), end;
    if (std::regex_replace(row.tests, name, "").find_first_not_of(", -") != std::string::npos)
        complaints.push_back(here + "write tests between backticks: " + row.tests);
    if (kind == "done" && found == end) complaints.push_back(here + "'done' needs a test");
    for (; found != end; ++found)
        if (!tests.contains((*found)[1])) complaints.push_back(here + "there is no test " + (*found)[1].str());
}

// The source files of a row, such as `engine/commands/executor.cpp`, must exist.
void judge_files(Tree const& tree, Row const& row, Complaints& complaints) {
    static std::regex const name(R"re(`([a-z]+/[\w/]+[.](?:cpp|hpp|xsd|xml))`)re");
    for (std::sregex_iterator found(row.how.begin(), row.how.end(), name), end; found != end; ++found) {
        std::string const file = (*found)[1];
        if (!tree.contains(file) && !tree.contains("server/" + file) && !tree.contains("components/" + file))
            complaints.push_back(at(row.document, row.line) + "there is no file " + file);
    }
}

bool speaks_of(Row const& row, std::string const& what) {
    return std::regex_search(row.clause, std::regex("\\b" + what + "\\b", std::regex::icase));
}

void judge_completeness(std::vector<Row> const& all, std::set<std::string> const& tests, Complaints& complaints) {
    auto const needs = [&](std::string const& what) {
        if (std::ranges::none_of(all, [&](Row const& row) { return speaks_of(row, what); }))
            complaints.push_back(at(summary, 1) + "no row is about " + what);
    };
    for (auto const& [word, last] : numbered)
        for (int number = 1; number <= last; ++number) needs(word + " " + std::to_string(number));
    for (auto const& annex : annexes) needs(annex);
    for (int number = 1; number <= numbered.back().last; ++number) {
        auto const decision = "decision " + std::to_string(number);
        if (std::ranges::none_of(all, [&](Row const& row) { return row.state == "done" && speaks_of(row, decision); })) continue;
        auto const suite = std::string("Decision") + (number < 10 ? "0" : "") + std::to_string(number) + ".";
        auto const first = tests.lower_bound(suite);
        if (first == tests.end() || !first->starts_with(suite))
            complaints.push_back(at(summary, 1) + "no test is called " + suite + "*");
    }
}

void judge_summary(Tree const& tree, std::vector<Row> const& all, Complaints& complaints) {
    auto const counted = [&](std::string const& document) {
        std::string counts;
        auto const of = [&](auto const& what) {
            counts += " " + std::to_string(std::ranges::count_if(all, [&](Row const& row) {
                          return (document.empty() || row.document == document) && what(row);
                      }));
        };
        of([](Row const&) { return true; });
        for (auto const state : known_states) of([&](Row const& row) { return kind_of(row.state) == state; });
        return counts;
    };
    std::map<std::string, std::string, std::less<>> missing{{"all", counted("")}};
    for (auto const& row : all)
        missing["[" + row.document.substr(5) + "](" + row.document.substr(5) + ")"] = counted(row.document);
    auto const text = tree.find(summary);
    if (text != tree.end())
        for_each_line(text->second, [&](std::string const& line, std::size_t number) {
            auto const row = cells(line);
            if (!is_count(row)) return;
            std::string said;
            for (std::size_t i = 1; i < 5; ++i) said += " " + row[i];
            auto const known = missing.find(row[0]);
            if (known == missing.end()) {
                complaints.push_back(at(summary, number) + row[0] + " is not a document with rows, or appears twice");
                return;
            }
            if (said != known->second) complaints.push_back(at(summary, number) + "it should say" + known->second);
            missing.erase(known);
        });
    for (auto const& [document, counts] : missing)
        complaints.push_back(at(summary, 1).append("the summary has no line for ").append(document).append(":").append(counts));
}

}  // namespace

Complaints against_proof(Tree const& tree) {
    Complaints complaints;
    auto const all = rows(tree);
    auto const tests = all_tests(tree);
    for (auto const& row : all) judge(row, tests, complaints), judge_files(tree, row, complaints);
    judge_completeness(all, tests, complaints);
    judge_summary(tree, all, complaints);
    return complaints;
}

}  // namespace rois::house
