#include "main/configuration_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "main/keys.hpp"
#include "types/texts.hpp"

namespace rois {

namespace {

using nlohmann::json;

std::size_t line_at(std::string const& text, std::size_t position) {
    auto const end = text.begin() + static_cast<std::ptrdiff_t>(std::min(position, text.size()));
    return 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n'));
}

// The line on which the key is set; comments do not count.
std::size_t line_of(std::string const& text, std::string const& key) {
    auto const quoted_key = json(key).dump();
    for (auto at = text.find(quoted_key); at != std::string::npos; at = text.find(quoted_key, at + 1)) {
        auto const begin = text.rfind('\n', at) + 1;  // npos + 1 is the beginning
        bool const comment = trimmed(std::string_view{text}.substr(begin, at - begin)).starts_with("//");
        auto const next = text.find_first_not_of(" \t\r\n", at + quoted_key.size());
        if (!comment && next != std::string::npos && text[next] == ':') return line_at(text, at);
    }
    return 1;
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
            throw BadSettings{file + ":" + std::to_string(line_of(text, twice)) + ": " + rois::quoted(twice) + " is there twice"};
        if (parsed.is_object()) return parsed;
    } catch (json::parse_error const& error) {
        throw BadSettings{file + ":" + std::to_string(line_at(text, error.byte)) + ": this is not JSON"};
    } catch (json::out_of_range const&) {
        throw BadSettings{file + ": a number in it is too large for any key"};
    }
    throw BadSettings{file + ":1: the file must hold one object, { ... }"};
}

void set(Settings& settings, std::string const& name, json const& value, std::string const& where) {
    auto const key = std::ranges::find(keys(), name, &Key::name);
    if (key == keys().end()) throw BadSettings{where + rois::quoted(name) + " is no configuration key"};
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
        set(settings, name, value, file + ":" + std::to_string(line_of(text, name)) + ": ");
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
