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

// Returns the place after the comment that begins here.
std::size_t end_of_comment(std::string_view text, std::size_t begin) {
    bool const is_line = text.substr(begin, 2) == "//";
    auto const at = is_line ? text.find_first_of("\r\n", begin + 2) : text.find("*/", begin + 2);
    return at == text.npos ? text.size() : at + (is_line ? 1 : 2);
}

// Returns the place after the string that begins here.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
    auto at = begin + 1;
    while (at < text.size() && text[at] != '"') at += text[at] == '\\' ? 2 : 1;
    return std::min(at + 1, text.size());
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

ObjectInText::Key const* ObjectInText::repeated() const {
    std::set<std::string_view> seen;
    for (auto const& key : keys)
        if (!seen.insert(key.name).second) return &key;
    return nullptr;
}

std::vector<ObjectInText> objects_in(std::string_view text) {
    std::vector<ObjectInText> objects;
    std::vector<std::size_t> open;  // indices of the objects around the position
    ObjectInText::Key last;         // string: a key if a colon follows
    for (std::size_t at = 0; at < text.size();) {
        auto const begin = at++;
        if (text[begin] == '/') {
            at = end_of_comment(text, begin);
        } else if (text[begin] == '"') {
            at = end_of_string(text, begin);
            last = {json::parse(text.substr(begin, at - begin)).get<std::string>(), begin};
        } else if (text[begin] == ':') {
            objects[open.back()].keys.push_back(last);
        } else if (text[begin] == '{') {
            open.push_back(objects.size());
            objects.push_back({.begin = begin, .depth = open.size(), .keys = {}});
        } else if (text[begin] == '}') {
            open.pop_back();
        }
    }
    return objects;
}

std::string place_of(std::string_view text, std::size_t position) {
    auto const before = text.substr(0, position);
    auto const line = 1 + std::ranges::count(before, '\n');
    auto const begin = before.rfind('\n') + 1;  // npos + 1 is 0
    auto const column = 1 + std::ranges::count_if(before.substr(begin), std::not_fn(continues_character));
    return std::to_string(line) + ":" + std::to_string(column);
}

std::string place_of_key(std::string_view text, ObjectInText const& object, std::string_view key) {
    auto const found = std::ranges::find(object.keys, key, &ObjectInText::Key::name);
    return place_of(text, found == object.keys.end() ? object.begin : found->at);
}

std::string place_of_key(std::string_view text, std::string_view key) {
    return place_of_key(text, objects_in(text).front(), key);
}

json parse_json(std::string const& file, std::string const& text) {
    // For the library, it is the end of the text.
    if (auto const at = text.find('\0'); at != std::string::npos)
        throw BadSettings{file + ":" + place_of(text, at) + ": this is not JSON: a byte is 0"};
    try {
        auto parsed = json::parse(text, nullptr, true, true);
        if (parsed.is_object()) {
            auto const outermost = objects_in(text).front();
            if (auto const* twice = outermost.repeated())
                throw BadSettings{file + ":" + place_of(text, twice->at) + ": " + rois::quoted(twice->name) + " is given twice"};
            return parsed;
        }
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
