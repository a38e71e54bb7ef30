#include "load/options.hpp"

#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <stdexcept>

namespace rois::bench {

namespace {

std::string text_of(std::string const& file) {
    std::ifstream in{file, std::ios::binary};
    if (!in) throw std::runtime_error("cannot read the file " + file);
    return {std::istreambuf_iterator<char>{in}, {}};
}

void replace(std::string& text, std::string_view name, std::size_t number) {
    for (auto at = text.find(name); at != text.npos; at = text.find(name, at))
        text.replace(at, name.size(), std::to_string(number));
}

Options::Mode mode_of(std::string const& name) {
    if (name == "requests") return Options::Mode::requests;
    if (name == "hold") return Options::Mode::hold;
    if (name == "fanout") return Options::Mode::fanout;
    throw std::runtime_error("unknown mode '" + name + "': expected requests, hold or fanout");
}

}  // namespace

std::string filled_in(std::string text, std::size_t connection, std::size_t number) {
    replace(text, "{connection}", connection);
    replace(text, "{number}", number);
    return text;
}

Options read_options(int argc, char const* const* argv) {
    if (argc < 2) throw std::runtime_error("the mode is missing: expected requests, hold or fanout");
    Options options;
    options.mode = mode_of(argv[1]);
    auto const whole = [](std::string const& text) { return static_cast<std::size_t>(std::stoull(text)); };
    std::map<std::string, std::function<void(std::string const&)>> const known{
        {"--port", [&](auto const& text) { options.port = static_cast<std::uint16_t>(whole(text)); }},
        {"--path", [&](auto const& text) { options.path = text; }},
        {"--via",
         [&](auto const& text) {
             options.via = text == "websocket" ? Via::websocket : Via::http;
             options.stream = text == "stream";
         }},
        {"--connect", [&](auto const& text) { options.connect = text == "yes"; }},
        {"--connections", [&](auto const& text) { options.connections = whole(text); }},
        {"--warm-up", [&](auto const& text) { options.warm_up = std::stod(text); }},
        {"--seconds", [&](auto const& text) { options.seconds = std::stod(text); }},
        {"--rate", [&](auto const& text) { options.rate = std::stod(text); }},
        {"--setup", [&](auto const& text) { options.setup.push_back(text_of(text)); }},
        {"--repeat", [&](auto const& text) { options.repeat = whole(text); }},
        {"--body", [&](auto const& text) { options.bodies.push_back(text_of(text)); }},
        {"--variants", [&](auto const& text) { options.variants = whole(text); }},
        {"--other-heads", [&](auto const& text) { options.other_heads = text == "yes"; }},
        {"--await", [&](auto const& text) { options.await = text; }},
        {"--expect", [&](auto const& text) { options.expect = text; }},
        {"--fire-setup", [&](auto const& text) { options.fire_setup.push_back(text_of(text)); }},
        {"--fire", [&](auto const& text) { options.fire = text_of(text); }},
        {"--burst", [&](auto const& text) { options.burst = whole(text); }},
        {"--announce", [&](auto const& text) { options.announce = text == "yes"; }},
        {"--spin", [&](auto const& text) { options.spin = text == "yes"; }},
        {"--pid", [&](auto const& text) { options.pid = std::stoi(text); }},
    };
    for (int i = 2; i < argc; i += 2) {
        auto const found = known.find(argv[i]);
        if (found == known.end() || i + 1 == argc)
            throw std::runtime_error(std::string{"unknown option, or option without a value: "} + argv[i]);
        found->second(argv[i + 1]);
    }
    return options;
}

}  // namespace rois::bench
