#include "main/json_file.hpp"

#include <algorithm>
#include <cctype>
#include <functional>
#include <set>

#include "main/settings.hpp"
#include "types/text/text_encoding.hpp"
#include "types/text/texts.hpp"

namespace rois {

using nlohmann::json;

namespace {

// "LINE:COLUMN", both from 1; columns count characters.
std::string place_of(std::string_view text, std::size_t position) {
    auto const before = text.substr(0, position);
    auto const line = 1 + std::ranges::count(before, '\n');
    auto const begin = before.rfind('\n') + 1;  // npos + 1 is 0
    auto const column = 1 + std::ranges::count_if(before.substr(begin), std::not_fn(continues_character));
    return std::to_string(line) + ":" + std::to_string(column);
}

// Returns where the number, word or string that ends at this position begins. The library reports only the end.
std::size_t begin_of_token(std::string_view text, std::size_t end) {
    auto const is_escaped = [&](std::size_t at) {
        auto const before = text.find_last_not_of('\\', at - 1);
        return at > 0 && (at - 1 - before) % 2 == 1;  // npos + 1 is 0
    };
    auto begin = end;
    if (end < text.size() && text[end] == '"') {
        do {
            --begin;
        } while (begin > 0 && (text[begin] != '"' || is_escaped(begin)));
        return begin;
    }
    auto const is_part = [](unsigned char c) { return std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.'; };
    while (begin > 0 && begin < text.size() && is_part(text[begin]) && is_part(text[begin - 1])) --begin;
    return begin;
}

// The part of the library's message after its name, the place and the context: "unexpected number literal; expected ':'".
std::string cause_of(json::exception const& error) {
    std::string_view words = error.what();
    for (std::string_view const end : {"] ", "column ", ": ", " - "})
        if (auto const at = words.find(end); at != std::string_view::npos) words.remove_prefix(at + end.size());
    constexpr std::size_t longest = 160;
    auto const with_quotes = rois::quoted(words, longest);
    auto cause = with_quotes.substr(1, with_quotes.size() - 2);
    for (std::string const end : {"'}'", "']'"})  // an object or a list may also continue
        if (cause.ends_with("expected " + end)) cause.insert(cause.size() - end.size(), "',' or ");
    return cause;
}

// The place of the number that is too large, which the library names.
std::string place_of_number(std::string const& text, json::out_of_range const& error) {
    std::string_view const words = error.what();
    auto const begin = std::min(words.find('\''), words.size() - 1) + 1;
    auto const number = words.substr(begin, words.find('\'', begin) - begin);
    return place_of(text, std::min(text.find(number), text.size()));
}

}  // namespace

std::string place_of_key(std::string const& text, std::string const& key, Which which, std::size_t from) {
    auto const quoted_key = json(key).dump();
    auto found = from;
    for (auto at = text.find(quoted_key, from); at != std::string::npos; at = text.find(quoted_key, at + 1)) {
        auto const begin = text.rfind('\n', at) + 1;
        bool const comment = trimmed(std::string_view{text}.substr(begin, at - begin)).starts_with("//");
        auto const next = text.find_first_not_of(" \t\r\n", at + quoted_key.size());
        if (comment || next == std::string::npos || text[next] != ':') continue;
        found = at;
        if (which == Which::first) break;
    }
    return place_of(text, found);
}

json parse_json(std::string const& file, std::string const& text) {
    std::set<std::string> seen;
    std::string twice;
    auto const note = [&](int depth, json::parse_event_t event, json const& key) {
        if (depth == 1 && event == json::parse_event_t::key && !seen.insert(key.get<std::string>()).second) twice = key;
        return true;
    };
    try {
        auto parsed = json::parse(text, note, true, true);
        if (!twice.empty())
            throw BadSettings{file + ":" + place_of_key(text, twice, Which::last) + ": " + rois::quoted(twice) +
                              " is given twice"};
        if (parsed.is_object()) return parsed;
    } catch (json::parse_error const& error) {
        auto position = std::min(error.byte - std::min<std::size_t>(error.byte, 1), text.size());
        auto const cause = cause_of(error);
        if (cause.starts_with("unexpected ") && position < text.size()) position = begin_of_token(text, position);
        throw BadSettings{file + ":" + place_of(text, position) + ": this is not JSON: " + cause};
    } catch (json::out_of_range const& error) {
        throw BadSettings{file + ":" + place_of_number(text, error) + ": the number is too large for any key"};
    }
    throw BadSettings{file + ":1:1: the file must hold one object, { ... }"};
}

}  // namespace rois
