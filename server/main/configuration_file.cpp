#include "main/configuration_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "main/json_file.hpp"
#include "main/keys.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

using nlohmann::json;

constexpr std::uintmax_t most_bytes = 10'000'000;  // of a file, which is read while the gateway serves

void set(GatewaySettings& settings, std::string const& name, json const& value, std::string const& where) {
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
    if (std::filesystem::is_directory(file)) throw BadSettings{file + ": cannot be read: this is a directory; name a file in it"};
    std::error_code error;
    if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error))
        throw BadSettings{file + ": cannot be read: this is not a regular file"};
    if (auto const size = std::filesystem::file_size(file, error); !error && size > most_bytes)
        throw BadSettings{file + ": has " + std::to_string(size) + " bytes: expected at most " + std::to_string(most_bytes)};
    std::ifstream stream{file, std::ios::binary};
    std::string text{std::istreambuf_iterator<char>{stream}, {}};
    if (!stream.is_open() || stream.bad()) throw BadSettings{file + ": cannot be read: " + std::strerror(errno)};
    return text;
}

void read_configuration_file(std::string const& file, GatewaySettings& settings) {
    auto const text = text_of_file(file);
    auto const object = parse_json(file, text);
    for (auto const& [name, value] : object.items()) {
        set(settings, name, value, file + ":" + place_of_key(text, name) + ": ");
    }
}

std::string commented_configuration(GatewaySettings const& settings) {
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
