#include "main/engines_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <set>
#include <sstream>

#include "engine/frames/frames.hpp"
#include "gateway/access/host_names.hpp"
#include "main/configuration_file.hpp"
#include "main/json_file.hpp"
#include "main/settings.hpp"
#include "main/tokens_file.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"
#include "types/text/to_number.hpp"
#include "wire/credentials.hpp"

namespace rois {

namespace {

using nlohmann::json;
using remote::SubEngine;

constexpr std::size_t longest_name = 64;
constexpr std::array<std::string_view, 4> schemes{"ws", "wss", "http", "https"};

// Thrown for a wrong value: the expected one.
struct Expected {
    std::string what;
};

std::string name_of(json const& value) {
    auto const fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    };
    if (value.is_string()) {
        auto name = value.get<std::string>();
        if (!name.empty() && name.size() <= longest_name && std::ranges::all_of(name, fits)) return name;
    }
    throw Expected{"a name of letters, digits, '_' and '-', with at most " + std::to_string(longest_name) + " characters"};
}

std::string url_of(json const& value) {
    if (value.is_string() && is_gateway_url(value.get<std::string>())) return value.get<std::string>();
    throw Expected{"the URL of a gateway, such as ws://127.0.0.1:8081"};
}

std::vector<std::string> refs_of(json const& value) {
    auto const is_ref = [](json const& each) { return each.is_string() && !each.get_ref<std::string const&>().empty(); };
    if (value.is_array() && !value.empty() && std::ranges::all_of(value, is_ref)) {
        auto refs = value.get<std::vector<std::string>>();
        if (std::set<std::string>{refs.begin(), refs.end()}.size() == refs.size()) return refs;
    }
    throw Expected{R"(a list of different refs of components, none of them empty, such as ["navigation", "speech"])"};
}

std::string engine_of(json const& value) {
    if (value.is_string() && !value.get_ref<std::string const&>().empty()) return value.get<std::string>();
    throw Expected{"the name of an engine of the sub engine, such as \"robot1\""};
}

std::string file_of(json const& value, std::filesystem::path const& folder) {
    if (value.is_string() && !value.get_ref<std::string const&>().empty()) return folder / value.get<std::string>();
    throw Expected{"the name of a file"};
}

std::vector<std::string> command_of(json const& value) {
    auto const is_word = [](json const& each) { return each.is_string() && !each.get_ref<std::string const&>().empty(); };
    if (value.is_array() && !value.empty() && std::ranges::all_of(value, is_word)) return value.get<std::vector<std::string>>();
    throw Expected{R"(a program and its arguments, such as ["python3", "lamp.py"])"};
}

bool is_program(std::filesystem::path const& file) {
    return std::filesystem::is_regular_file(file) && ::access(file.c_str(), X_OK) == 0;
}

// Returns whether execvp(3) would find the program in this folder.
bool is_found(std::string const& program, std::filesystem::path const& folder) {
    if (program.find('/') != program.npos) return is_program(folder / program);
    auto const* const path = std::getenv("PATH");
    std::istringstream places{path == nullptr ? "/bin:/usr/bin" : path};
    for (std::string place; std::getline(places, place, ':');)
        if (is_program(folder / place / program)) return true;
    return false;
}

// Why `is_found` returned false.
std::string why_not_found(std::string const& program, std::filesystem::path const& folder) {
    auto const named = "program " + rois::quoted(program);
    if (program.find('/') == program.npos)
        return named + " not found in PATH; the name of a program in the folder of this file begins with './'";
    return named + ": " + rois::quoted((folder / program).lexically_normal().string()) + " is not an executable file";
}

std::vector<double> numbers_of(json const& value, std::vector<std::size_t> const& sizes, std::string const& expected) {
    bool const fits = value.is_array() && std::ranges::find(sizes, value.size()) != sizes.end() &&
                      std::ranges::all_of(value, [](json const& each) { return each.is_number(); });
    if (!fits) throw Expected{expected};
    return value.get<std::vector<double>>();
}

std::array<double, 3> triple_of(json const& value, std::string const& expected) {
    auto const numbers = numbers_of(value, {3}, expected);
    return {numbers[0], numbers[1], numbers[2]};
}

// "1.5 s"
std::string shown(std::chrono::milliseconds time) { return json(std::chrono::duration<double>(time).count()).dump() + " s"; }

std::chrono::milliseconds seconds_of(json const& value, double least, double most) {
    auto const seconds = value.is_number() ? value.get<double>() : -1;
    if (seconds >= least && seconds <= most) return std::chrono::milliseconds{static_cast<std::int64_t>(seconds * 1'000)};
    auto const number = [](double each) { return json(each).dump(); };
    throw Expected{"a number of seconds from " + number(least) + " to " + number(most)};
}

std::size_t number_of(json const& value, std::size_t least, std::size_t most) {
    auto const number = value.is_number_unsigned() ? value.get<std::size_t>() : 0;
    if (number >= least && number <= most) return number;
    throw Expected{"a whole number from " + std::to_string(least) + " to " + std::to_string(most)};
}

remote::Placement& placement(SubEngine& engine) { return engine.placement ? *engine.placement : engine.placement.emplace(); }

struct Property {
    std::string_view name;
    std::function<void(SubEngine&, json const&)> set;
};

std::vector<Property> const& properties() {
    static std::vector<Property> const all{
        {"name", [](SubEngine& engine, json const& value) { engine.name = name_of(value); }},
        {"url", [](SubEngine& engine, json const& value) { engine.url = url_of(value); }},
        {"joins", [](SubEngine& engine, json const& value) { engine.joins = name_of(value); }},
        {"command", [](SubEngine& engine, json const& value) { engine.command = command_of(value); }},
        {"components", [](SubEngine& engine, json const& value) { engine.components = refs_of(value); }},
        {"engine", [](SubEngine& engine, json const& value) { engine.engine = engine_of(value); }},
        {"position",
         [](SubEngine& engine, json const& value) { placement(engine).position = triple_of(value, "[x, y, z] in mm"); }},
        {"orientation",
         [](SubEngine& engine, json const& value) {
             placement(engine).orientation = triple_of(value, "[roll, pitch, yaw] in degrees");
         }},
        {"covariance",
         [](SubEngine& engine, json const& value) {
             placement(engine).covariance =
                 numbers_of(value, {9, 36}, "9 numbers (x, y, yaw) or 36 (x, y, z, roll, pitch, yaw), in mm and degrees");
         }},
        {"token_file", [](SubEngine& engine, json const& value) { engine.token = token_in(file_of(value, engine.folder)); }},
        {"ca_file", [](SubEngine& engine, json const& value) { engine.ca_file = file_of(value, engine.folder); }},
        {"certificate_file",
         [](SubEngine& engine, json const& value) { engine.certificate_file = file_of(value, engine.folder); }},
        // A gateway with default settings refuses other windows and leases.
        {"window", [](SubEngine& engine, json const& value) { engine.window = seconds_of(value, 1, 30); }},
        {"resume_window", [](SubEngine& engine, json const& value) { engine.resume_window = seconds_of(value, 1, 86'400); }},
        {"motion_lease", [](SubEngine& engine, json const& value) { engine.motion_lease = seconds_of(value, 1, 2); }},
        {"most_components", [](SubEngine& engine, json const& value) { engine.most_components = number_of(value, 1, 100'000); }},
        {"longest_document", [](SubEngine& engine, json const& value) {
             engine.longest_document = number_of(value, 100'000, remote::largest_document);
         }}};
    return all;
}

// Reads an entry. `where`: the place of a key of it.
SubEngine read(json const& entry, std::filesystem::path const& folder,
               std::function<std::string(std::string const&)> const& where) {
    SubEngine engine;
    engine.folder = folder;
    auto const named = [&] { return engine.name.empty() ? std::string{} : "sub engine " + rois::quoted(engine.name) + ": "; };
    if (!entry.contains("name")) throw BadSettings{where("") + "a sub engine has no 'name'"};
    auto const set = [&](std::string const& name, json const& value) {
        auto const property = std::ranges::find(properties(), name, &Property::name);
        if (property == properties().end()) {
            std::vector<std::string> names;
            for (auto const& each : properties()) names.emplace_back(each.name);
            throw BadSettings{where(name) + named() + rois::quoted(name) + " is not a key of a sub engine: expected one of " +
                              listed(names)};
        }
        try {
            property->set(engine, value);
        } catch (Expected const& expected) {
            throw BadSettings{where(name) + named() + name + " must be " + expected.what + ", not " +
                              rois::quoted(value.dump(), 100)};
        }
    };
    set("name", entry["name"]);
    for (auto const& [name, value] : entry.items()) set(name, value);
    for (auto const* key : {"token_file", "ca_file", "certificate_file"})
        if (engine.url.empty() && entry.contains(key))
            throw BadSettings{where(key) + named() + key + " needs 'url': an engine that joins is not asked"};
    if (!engine.token.empty() && remote::is_in_the_clear(engine.url))
        throw BadSettings{where("token_file") + named() + "others could read the token on its way to " +
                          rois::quoted(engine.url) + ": expected a URL with https:// or wss://"};
    auto const require = [&](std::string const& key, std::string const& file, auto const& what) {
        try {
            if (!file.empty()) what(key, file);
        } catch (std::runtime_error const& problem) {
            throw BadSettings{where(key) + named() + problem.what()};
        }
    };
    require("ca_file", engine.ca_file, tls::require_certificates);
    require("certificate_file", engine.certificate_file, tls::require_identity);
    if (!engine.command.empty()) {
        if (engine.url.empty() && engine.joins.empty()) engine.joins = engine.name;
        if (!is_found(engine.command.front(), folder))
            throw BadSettings{where("command") + named() + why_not_found(engine.command.front(), folder)};
        if (!engine.url.empty())
            throw BadSettings{where("command") + named() + "'command' and 'url' exclude each other: a program joins"};
    }
    if (engine.url.empty() == engine.joins.empty())
        throw BadSettings{where("name") + named() +
                          "needs either 'url' (this gateway connects) or 'joins' (the sub engine connects), and has " +
                          (engine.url.empty() ? "neither" : "both")};
    if (engine.resume_window < engine.window)
        throw BadSettings{where("resume_window") + named() + "resume_window (" + shown(engine.resume_window) +
                          ") must not be shorter than window (" + shown(engine.window) + ")"};
    if (engine.placement) {
        try {
            Frames const checked{"here",
                                 {{.crs = "there",
                                   .base = {},
                                   .position = engine.placement->position,
                                   .orientation = engine.placement->orientation,
                                   .covariance = engine.placement->covariance}}};
        } catch (std::invalid_argument const& problem) {
            throw BadSettings{where("covariance") + named() + problem.what()};
        }
    }
    return engine;
}

}  // namespace

// Follows the rules of client::read_url, which this layer may not use.
bool is_gateway_url(std::string_view text) {
    auto const mark = text.find("://");
    auto const scheme = lower_case(text.substr(0, mark));
    if (mark == text.npos || std::ranges::find(schemes, scheme) == schemes.end()) return false;
    auto const rest = text.substr(mark + 3);
    auto const authority = rest.substr(0, rest.find_first_of("/?#"));
    if (rest.substr(authority.size()).find_first_of("?# \t\r\n") != rest.npos) return false;
    auto const after_address = authority.starts_with('[') ? authority.find(']') + 1 : 0;  // npos + 1 is 0
    auto const colon = std::min(authority.find(':', after_address), authority.size());
    auto const host = authority.substr(0, colon);
    if (colon < authority.size() && to_number<std::uint16_t>(authority.substr(colon + 1)).value_or(0) == 0) return false;
    // Each IP address is an own host.
    return after_address > 0 ? is_own_host(host, {}) : host_name(host).has_value();
}

std::vector<SubEngine> read_engines_file(std::string const& file, TakenNames const& taken) {
    auto const text = text_of_file(file);
    auto const object = parse_json(file, text);
    for (auto const& [name, value] : object.items()) {
        auto const where = file + ":" + place_of_key(text, name) + ": ";
        if (name != "engines" && name != "choosing")
            throw BadSettings{where + rois::quoted(name) + R"( is not a key of this file: expected "engines" or "choosing")"};
        if (name == "engines" && !value.is_array())
            throw BadSettings{where + R"("engines" must be a list of sub engines, [ ... ], not )" +
                              rois::quoted(value.dump(), 100)};
    }
    if (!object.contains("engines")) throw BadSettings{file + ":1:1: expected \"engines\": [ ... ], a list of sub engines"};
    std::vector<SubEngine> engines;
    std::set<std::string> names, joining, urls;
    auto entries = objects_in(text);
    auto const list = std::ranges::find(entries.front().keys, "engines", &ObjectInText::Key::name)->at;
    std::erase_if(entries, [&](ObjectInText const& each) { return each.depth != 2 || each.begin < list; });
    auto const folder = std::filesystem::absolute(file).parent_path();
    for (auto const& entry : object["engines"]) {
        if (!entry.is_object())
            throw BadSettings{file + ":" + place_of_key(text, "engines") + ": each sub engine must be an object, { ... }"};
        auto const& in_text = entries[engines.size()];
        auto const where = [&](std::string const& key) { return file + ":" + place_of_key(text, in_text, key) + ": "; };
        if (auto const* twice = in_text.repeated())
            throw BadSettings{file + ":" + place_of(text, twice->at) + ": " + rois::quoted(twice->name) +
                              " is given twice in this sub engine"};
        auto& engine = engines.emplace_back(read(entry, folder, where));
        if (auto const other = taken.find(engine.name); other != taken.end())
            throw BadSettings{where("name") + "sub engine " + rois::quoted(engine.name) + ": name is already the name of " +
                              other->second};
        if (!names.insert(lower_case(engine.name)).second)  // names of frames do not distinguish letter case
            throw BadSettings{where("name") + "there are two sub engines with the name " + rois::quoted(engine.name)};
        if (!engine.joins.empty() && !joining.insert(engine.joins).second)
            throw BadSettings{where("joins") + "two sub engines join as " + rois::quoted(engine.joins)};
        if (!engine.url.empty() && !urls.insert(engine.url).second)
            throw BadSettings{where("url") + "two sub engines have the url " + rois::quoted(engine.url)};
    }
    return engines;
}

}  // namespace rois
