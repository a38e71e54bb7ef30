#include "simulation/ssml.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "simulation/languages.hpp"
#include "simulation/ssml_meaning.hpp"
#include "types/texts.hpp"

namespace rois::simulation {
namespace {

constexpr std::size_t most_attributes = 32;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

bool is_name(char c) {
    auto const u = static_cast<unsigned char>(c);
    return u >= 0x80 || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view{"-._:"}.find(c) != std::string_view::npos;
}

bool begins_name(char c) { return is_name(c) && std::string_view{"0123456789-."}.find(c) == std::string_view::npos; }

void append_utf8(std::string& text, std::uint32_t c) {
    if (c < 0x80) {
        text += static_cast<char>(c);
        return;
    }
    int const more = c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
    constexpr std::array<std::uint32_t, 4> lead{0, 0xC0, 0xE0, 0xF0};
    text += static_cast<char>(lead[static_cast<std::size_t>(more)] | (c >> (6 * more)));
    for (int i = more - 1; i >= 0; --i) text += static_cast<char>(0x80U | ((c >> (6 * i)) & 0x3FU));
}

// "&#x41;" without "&#" and ";".
std::optional<std::uint32_t> character_number(std::string_view digits) {
    bool const hexadecimal = digits.starts_with('x');
    if (hexadecimal) digits.remove_prefix(1);
    std::uint32_t number = 0;
    auto const [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), number, hexadecimal ? 16 : 10);
    if (problem != std::errc{} || end != digits.data() + digits.size()) return {};
    bool const surrogate = number >= 0xD800 && number < 0xE000;
    bool const control = number < 0x20 && number != '\t' && number != '\n' && number != '\r';
    if (surrogate || control || number > 0x10FFFF) return {};
    return number;
}

// Without its prefix.
std::string_view local(std::string_view name) { return name.substr(name.find(':') + 1); }

class Reader {
public:
    explicit Reader(std::string_view document) : document_{document} {}

    std::variant<SpokenText, BadSsml> read() {
        if (document_.starts_with("\xEF\xBB\xBF")) at_ = 3;
        if (rest().starts_with("<?xml")) past("?>", "the XML declaration is not closed");
        while (!flaw_ && at_ < document_.size()) step();
        if (!flaw_ && !open_.empty()) complain(at_, "<" + std::string{open_.back()} + "> is not closed");
        if (!flaw_ && !root_seen_) complain(at_, "there is no <speak> element");
        if (flaw_) return *flaw_;
        return SpokenText{meaning_.passages()};
    }

private:
    std::string_view rest() const { return document_.substr(at_); }

    void complain(std::size_t where, std::string const& what) {
        if (flaw_) return;
        auto const before = document_.substr(0, where);
        auto const line = 1 + std::ranges::count(before, '\n');
        auto const line_start = before.rfind('\n') + 1;  // npos + 1 is 0
        auto const is_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
        auto const column = 1 + std::ranges::count_if(before.substr(line_start), is_character);
        flaw_ = BadSsml{"line " + std::to_string(line) + ", column " + std::to_string(column) + ": " + what};
    }

    // Moves behind the next `mark`.
    void past(std::string_view mark, std::string const& otherwise) {
        auto const found = document_.find(mark, at_);
        if (found == std::string_view::npos) return complain(at_, otherwise);
        at_ = found + mark.size();
    }

    void step() {
        if (document_[at_] != '<') return text();
        if (rest().starts_with("<!--")) return past("-->", "the comment is not closed");
        if (rest().starts_with("<![CDATA[")) return cdata();
        if (rest().starts_with("<!")) return complain(at_, "document types are not read");
        if (rest().starts_with("<?")) return complain(at_, "processing instructions are not read");
        if (rest().starts_with("</")) return end_tag();
        start_tag();
    }

    void text() {
        auto const end = std::min(document_.find('<', at_), document_.size());
        auto const from = at_;
        auto const content = unescaped(end);
        if (flaw_) return;
        if (open_.empty()) {
            if (!trimmed(content).empty()) complain(from, "there is text outside of the <speak> element");
            return;
        }
        meaning_.say(content);
    }

    void cdata() {
        auto const from = at_;
        at_ += std::string_view{"<![CDATA["}.size();
        auto const content = at_;
        past("]]>", "the CDATA section is not closed");
        if (flaw_) return;
        if (open_.empty()) return complain(from, "there is text outside of the <speak> element");
        meaning_.say(document_.substr(content, at_ - content - 3));
    }

    // Reads up to `end`, entities replaced.
    std::string unescaped(std::size_t end) {
        std::string content;
        while (at_ < end && !flaw_) {
            if (document_[at_] == '&') {
                entity(content, end);
            } else {
                content += document_[at_++];
            }
        }
        return content;
    }

    void entity(std::string& content, std::size_t end) {
        constexpr std::array<std::pair<std::string_view, char>, 5> known{
            {{"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}}};
        auto const semicolon = document_.find(';', at_);
        if (semicolon == std::string_view::npos || semicolon >= end) return complain(at_, "'&' begins no entity; write &amp;");
        auto const name = document_.substr(at_ + 1, semicolon - at_ - 1);
        auto const found = std::ranges::find(known, name, &std::pair<std::string_view, char>::first);
        if (found != known.end()) {
            content += found->second;
        } else if (auto const number = name.starts_with('#') ? character_number(name.substr(1)) : std::nullopt) {
            append_utf8(content, *number);
        } else {
            return complain(at_, "the entity " + quoted(name) + " is unknown");
        }
        at_ = semicolon + 1;
    }

    std::string_view name() {
        auto const from = at_;
        if (at_ < document_.size() && begins_name(document_[at_]))
            while (at_ < document_.size() && is_name(document_[at_])) ++at_;
        return document_.substr(from, at_ - from);
    }

    void blanks() {
        while (at_ < document_.size() && is_blank(document_[at_])) ++at_;
    }

    bool take(char c) {
        if (at_ == document_.size() || document_[at_] != c) return false;
        ++at_;
        return true;
    }

    void end_tag() {
        auto const from = at_;
        at_ += 2;
        auto const closed = name();
        blanks();
        if (!take('>')) return complain(from, "the end tag is not closed");
        if (open_.empty() || open_.back() != closed)
            return complain(from, "</" + std::string{closed} + "> closes nothing; " +
                                      (open_.empty() ? "no element is open" : "<" + std::string{open_.back()} + "> is open"));
        open_.pop_back();
        meaning_.end();
    }

    void start_tag() {
        auto const from = at_++;
        auto const opened = name();
        if (opened.empty()) return complain(from, "'<' begins no tag; write &lt;");
        auto const attributes = read_attributes(from);
        if (flaw_) return;
        bool const empty = take('/');
        if (!take('>')) return complain(from, "the tag <" + std::string{opened} + " is not closed");
        if (open_.empty() && !begin_root(opened, from)) return;
        if (auto const language = meaning_.begin(local(opened), attributes))
            return complain(
                from, "the language " + quoted(*language) + " cannot be synthesized; those that can are " + names_of_languages());
        if (empty) return meaning_.end();
        open_.push_back(opened);
    }

    std::vector<SsmlAttribute> read_attributes(std::size_t tag) {
        std::vector<SsmlAttribute> attributes;
        while (!flaw_) {
            auto const before = at_;
            blanks();
            if (at_ == document_.size() || document_[at_] == '>' || document_[at_] == '/') return attributes;
            auto const from = at_;
            auto const attribute = name();
            if (attribute.empty() || before == from) complain(from, "an attribute was expected");
            if (attributes.size() == most_attributes) complain(from, "the tag has too many attributes");
            if (std::ranges::find(attributes, attribute, &SsmlAttribute::name) != attributes.end())
                complain(from, "the attribute " + quoted(attribute) + " is there twice");
            attributes.push_back({attribute, attribute_value(tag)});
        }
        return attributes;
    }

    std::string attribute_value(std::size_t tag) {
        blanks();
        if (!take('=')) complain(at_, "'=' was expected");
        blanks();
        char const quote = at_ < document_.size() ? document_[at_] : ' ';
        if (quote != '"' && quote != '\'') complain(at_, "the attribute's value is not in quotes");
        if (flaw_) return {};
        ++at_;
        auto const end = document_.find(quote, at_);
        if (end == std::string_view::npos) complain(tag, "the tag is not closed");
        if (document_.substr(at_, end - at_).find('<') != std::string_view::npos)
            complain(at_, "'<' in an attribute; write &lt;");
        if (flaw_) return {};
        auto value = unescaped(end);
        at_ = end + 1;
        return value;
    }

    bool begin_root(std::string_view opened, std::size_t from) {
        if (std::exchange(root_seen_, true)) complain(from, "there is a second root element");
        if (local(opened) != "speak") complain(from, "the root element is " + quoted(opened) + ", not 'speak'");
        return !flaw_;
    }

    std::string_view document_;
    std::size_t at_ = 0;
    std::vector<std::string_view> open_;  // names of elements
    bool root_seen_ = false;
    SsmlMeaning meaning_;
    std::optional<BadSsml> flaw_;
};

}  // namespace

std::variant<SpokenText, BadSsml> read_ssml(std::string_view document) { return Reader{document}.read(); }

}  // namespace rois::simulation
