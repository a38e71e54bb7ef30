#include "command/input/condition_text.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "rois/condition.hpp"
#include "types/text/texts.hpp"

namespace rois::command {

namespace {

struct Word {
    enum class Kind { word, quoted, sign, end } kind = Kind::end;
    std::string text;
    std::size_t at = 0;
};

constexpr std::string_view signs = "=<>!(),";

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// A word ends before a space, a sign or a quote. A comma inside a word is part of it, as in 0,0.
std::size_t end_of_word(std::string_view text, std::size_t at) {
    while (at < text.size() && !is_blank(text[at]) && text[at] != '"' && text[at] != '\'') {
        bool const separates = text[at] == ',' && (at + 1 == text.size() || is_blank(text[at + 1]));
        if (separates || (text[at] != ',' && signs.find(text[at]) != signs.npos)) break;
        ++at;
    }
    return at;
}

std::vector<Word> words_of(std::string_view text) {
    std::vector<Word> words;
    std::size_t at = 0;
    while (at < text.size()) {
        auto const c = text[at];
        auto const begin = at;
        if (is_blank(c)) {
            ++at;
        } else if (c == '"' || c == '\'') {
            auto const end = text.find(c, at + 1);
            if (end == text.npos) throw BadCondition{"this quote does not end", at};
            words.push_back({Word::Kind::quoted, std::string{text.substr(at + 1, end - at - 1)}, begin});
            at = end + 1;
        } else if (signs.find(c) != signs.npos) {
            auto const two = text.substr(at, 2);
            bool const is_two = two == "<=" || two == ">=" || two == "!=" || two == "==" || two == "<>";
            words.push_back({Word::Kind::sign, std::string{is_two ? two : two.substr(0, 1)}, begin});
            at += is_two ? 2 : 1;
        } else {
            at = end_of_word(text, at);
            words.push_back({Word::Kind::word, std::string{text.substr(begin, at - begin)}, begin});
        }
    }
    words.push_back({Word::Kind::end, "", text.size()});
    return words;
}

std::optional<std::pair<double, double>> point_of(std::string_view text) {
    auto const comma = text.find(',');
    if (comma == text.npos) return std::nullopt;
    auto const x = to_double(text.substr(0, comma));
    auto const y = to_double(text.substr(comma + 1));
    if (!x || !y) return std::nullopt;
    return std::pair{*x, *y};
}

class ConditionParser {
public:
    explicit ConditionParser(std::string_view text) : words_{words_of(text)} {}

    QueryExpression whole() {
        QueryExpression whole;
        if (!is_order() && now().kind != Word::Kind::end) whole.filter = either();
        while (is_order()) whole.sort_by.push_back(order());
        if (now().kind != Word::Kind::end) fail("expected 'and', 'or', 'nearest', 'order by' or the end");
        return whole;
    }

private:
    Word const& now() const { return words_[at_]; }
    Word const& next() const { return words_[std::min(at_ + 1, words_.size() - 1)]; }
    Word take() { return words_[now().kind == Word::Kind::end ? at_ : at_++]; }

    bool is(std::string_view keyword) const { return now().kind == Word::Kind::word && equal_ignoring_case(now().text, keyword); }
    bool is_sign(std::string_view sign) const { return now().kind == Word::Kind::sign && now().text == sign; }
    bool took(std::string_view keyword) {
        bool const there = is(keyword);
        if (there) ++at_;
        return there;
    }
    bool took_sign(std::string_view sign) {
        bool const there = is_sign(sign);
        if (there) ++at_;
        return there;
    }
    bool is_order() const { return is("nearest") || (is("order") && equal_ignoring_case(next().text, "by")); }

    [[noreturn]] void fail(std::string const& expected) const {
        auto const found = now().kind == Word::Kind::end ? "the end" : quoted(now().text);
        throw BadCondition{expected + ", not " + found, now().at};
    }

    Condition either() {
        auto condition = both();
        while (took("or")) condition = std::move(condition) || both();
        return condition;
    }

    Condition both() {
        auto condition = one();
        while (took("and")) condition = std::move(condition) && one();
        return condition;
    }

    Condition one() {
        struct Deeper {
            ConditionParser& reader;
            explicit Deeper(ConditionParser& r) : reader{r} {
                if (++reader.depth_ > 50) reader.fail("too many parentheses");
            }
            ~Deeper() { --reader.depth_; }
        } const deeper{*this};
        if (took("not")) return !one();
        if (took_sign("(")) {
            auto inside = either();
            if (!took_sign(")")) fail("expected ')'");
            return inside;
        }
        return predicate();
    }

    std::string name() {
        if (now().kind != Word::Kind::word) fail("expected a name such as type, status, number or position_data");
        return take().text;
    }

    std::string value(std::string const& expected = "expected a value") {
        if (now().kind != Word::Kind::word && now().kind != Word::Kind::quoted) fail(expected);
        return take().text;
    }

    Condition predicate() {
        auto const named = name();
        bool const of_type = equal_ignoring_case(named, "type");
        Reference const reference{of_type ? "component_type" : named};
        if (took("like")) return reference.like(value());
        if (took("between")) {
            auto const lower = value();
            if (!took("and")) fail("expected 'and' and the upper boundary");
            return reference.between(lower, value());
        }
        if (took("is")) {
            bool const negated = took("not");
            if (!took("null")) fail("expected 'null'");
            return negated ? !reference.is_null() : reference.is_null();
        }
        if (took("within")) return within(reference);
        if (took("near")) return near(reference);
        if (took("before")) return reference.before(moment());
        if (took("after")) return reference.after(moment());
        if (took("during")) return during(reference);
        return comparison(reference, of_type);
    }

    Condition comparison(Reference const& reference, bool of_type) {
        if (now().kind != Word::Kind::sign || is_sign("(") || is_sign(")") || is_sign(",") || is_sign("!"))
            fail("expected =, !=, <, >, <=, >=, like, between, is null, within, near, before, after or during");
        auto const sign = take();
        auto const text = value();
        bool const equal = sign.text == "=" || sign.text == "==";
        bool const unequal = sign.text == "!=" || sign.text == "<>";
        if (of_type && equal) return conditions::type == text;
        if (of_type && unequal) return conditions::type != text;
        if (equal) return reference == text;
        if (unequal) return reference != text;
        if (sign.text == "<") return reference < text;
        if (sign.text == ">") return reference > text;
        return sign.text == "<=" ? reference <= text : reference >= text;
    }

    // A place, or two corners.
    Condition within(Reference const& reference) {
        auto const begin = now().at;
        auto const text = value("expected the name of a place, or two corners such as 0,0 4000,3000");
        auto const corner = point_of(text);
        if (!corner) return reference.within(std::string_view{text});
        auto const opposite = point_of(now().text);
        if (!opposite)
            throw BadCondition{"expected a second corner after " + quoted(text),
                               now().kind == Word::Kind::end ? begin : now().at};
        take();
        return reference.within(Box{millimetres{corner->first},
                                    millimetres{corner->second},
                                    millimetres{opposite->first},
                                    millimetres{opposite->second},
                                    {}});
    }

    // A place or a point, and a distance: 2000, 2000mm, 2m.
    Condition near(Reference const& reference) {
        auto const text = value("expected the name of a place, or a point such as 4000,3000");
        auto const away = distance();
        auto const point = point_of(text);
        if (!point) return reference.near(std::string_view{text}, away);
        return reference.near(Pose{millimetres{point->first}, millimetres{point->second}, degrees{}, {}}, away);
    }

    millimetres distance() {
        auto const at = now().at;
        auto text = value("expected a distance such as 2000 or 2m");
        double factor = 1;
        if (text.ends_with("mm")) {
            text.resize(text.size() - 2);
        } else if (text.ends_with('m')) {
            text.pop_back();
            factor = 1'000;
        }
        auto const number = to_double(text);
        if (!number || *number < 0) throw BadCondition{"expected a distance such as 2000 or 2m, not " + quoted(text), at};
        return millimetres{*number * factor};
    }

    Utc moment() {
        auto const at = now().at;
        auto const text = value("expected a time");
        auto const time = to_utc(text);
        if (!time) throw BadCondition{"expected a time such as 2026-11-20T12:00:00Z, not " + quoted(text), at};
        return *time;
    }

    // A day, month or year, or two times.
    Condition during(Reference const& reference) {
        auto const at = now().at;
        auto const text = value("expected a period");
        auto const period = to_period(text);
        if (!period) throw BadCondition{"expected a period such as 2026-11-20, or TIME to TIME, not " + quoted(text), at};
        if (!took("to")) return reference.during(*period);
        return reference.during(Period{period->begin, moment()});
    }

    SortProperty order() {
        if (took("nearest")) return nearest_to(value("expected the name of a place"));
        take();
        take();
        Reference const by{name()};
        if (took("descending") || took("desc")) return descending(by);
        if (!took("ascending")) took("asc");
        return ascending(by);
    }

    std::vector<Word> words_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

}  // namespace

QueryExpression read_condition(std::string_view text) { return ConditionParser{text}.whole(); }

}  // namespace rois::command
