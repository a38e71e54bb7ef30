#include "main/configuration_file.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "main/keys.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

using nlohmann::json;

// "LINE:COLUMN", both from 1; columns count characters.
std::string place_of(std::string_view text, std::size_t position) {
    auto const before = text.substr(0, position);
    auto const line = 1 + std::ranges::count(before, '\n');
    auto const begin = before.rfind('\n') + 1;  // npos + 1 is 0
    auto const column = 1 + std::ranges::count_if(before.substr(begin), [](char c) { return (c & 0xC0) != 0x80; });
    return std::to_string(line) + ":" + std::to_string(column);
}

// The place of the first or last setting of the key. Ignores comments.
enum class Which : std::uint8_t { first, last };
std::string place_of_key(std::string const& text, std::string const& key, Which which = Which::first) {
    auto const quoted_key = json(key).dump();
    std::size_t found = 0;
    for (auto at = text.find(quoted_key); at != std::string::npos; at = text.find(quoted_key, at + 1)) {
        auto const begin = text.rfind('\n', at) + 1;
        bool const comment = trimmed(std::string_view{text}.substr(begin, at - begin)).starts_with("//");
        auto const next = text.find_first_not_of(" \t\r\n", at + quoted_key.size());
        if (comment || next == std::string::npos || text[next] != ':') continue;
        found = at;
        if (which == Which::first) break;
    }
    return place_of(text, found);
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

json parse(std::string const& file, std::string const& text) {
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

void set(Settings& settings, std::string const& name, json const& value, std::string const& where) {
    auto const key = std::ranges::find(keys(), name, &Key::name);
    if (key == keys().end()) throw BadSettings{where + rois::quoted(name) + " is not a configuration key; --help lists the keys"};
    bool const fits = key->kind == Key::Kind::number ? value.is_number() : value.is_string();
    auto const text = value.is_string() ? value.get<std::string>() : value.dump();
    if (!fits || !key->set(settings, text)) {
        throw BadSettings{where + name + " must be " + key->must_be + ", not " + rois::quoted(value.dump())};
    }
}

}  // namespace

std::string text_of_file(std::string const& file) {
    if (std::filesystem::is_directory(file)) throw BadSettings{file + ": cannot be read: this is a directory"};
    std::ifstream stream{file, std::ios::binary};
    std::string text{std::istreambuf_iterator<char>{stream}, {}};
    if (!stream.is_open() || stream.bad()) throw BadSettings{file + ": cannot be read: " + std::strerror(errno)};
    return text;
}

void read_configuration_file(std::string const& file, Settings& settings) {
    auto const text = text_of_file(file);
    auto const object = parse(file, text);
    for (auto const& [name, value] : object.items()) {
        set(settings, name, value, file + ":" + place_of_key(text, name) + ": ");
    }
}

std::string commented_configuration(Settings const& settings) {
    std::string text =
        "// Configuration of rois-gateway: JSON with comments. Every key is also a flag (--sim-speed) and an environment\n"
        "// variable (ROIS_SIM_SPEED); a flag wins over a variable, a variable over this file. These are the defaults.\n{\n";
    for (auto const& key : keys()) {
        auto const value = key.show(settings);
        auto const end = &key == &keys().back() ? "\n" : ",\n";
        text += "    // " + key.name + ": " + key.help + " (" + key.must_be + ")\n";
        text += "    " + json(key.name).dump() + ": " + (key.kind == Key::Kind::number ? value : json(value).dump()) + end;
    }
    return text + "}\n";
}

}  // namespace rois
