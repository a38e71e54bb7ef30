// Makes configuration keys of the usual kinds: numbers, times, files, choices. For keys.cpp.
#pragma once

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "main/keys.hpp"
#include "types/text/texts.hpp"
#include "types/text/to_number.hpp"

namespace rois {

inline std::string text_of(double number) {
    char buffer[32];
    auto const end = std::to_chars(std::begin(buffer), std::end(buffer), number, std::chars_format::fixed).ptr;
    return {buffer, end};
}

inline std::optional<double> number_within(std::string const& text, double least, double most) {
    auto const number = to_double(text);
    if (!number || std::isnan(*number) || *number < least || *number > most) return {};
    return number;
}

inline std::string range(std::string const& what, double least, double most) {
    return what + " from " + text_of(least) + " to " + text_of(most);
}

// Selects a member of the settings.
template <class T>
using Member = std::function<T&(GatewaySettings&)>;

template <class T>
T const& read(Member<T> const& member, GatewaySettings const& settings) {
    return member(const_cast<GatewaySettings&>(settings));
}

template <class T>
Key whole_number(std::string name, std::string help, Member<T> const& member, double least, double most) {
    Key key{std::move(name), std::move(help), "N", range("a whole number", least, most), Key::Kind::number, {}, {}};
    key.set = [member, least, most](GatewaySettings& settings, std::string const& text) {
        auto const number = to_number<T>(text);
        if (!number || static_cast<double>(*number) < least || static_cast<double>(*number) > most) return false;
        member(settings) = *number;
        return true;
    };
    key.show = [member](GatewaySettings const& settings) { return std::to_string(read(member, settings)); };
    return key;
}

inline Key seconds(std::string name, std::string help, Member<std::chrono::milliseconds> const& member, double least = 0.1,
                   double most = 86'400) {
    Key key{std::move(name), std::move(help), "SECONDS", range("a number of seconds", least, most), Key::Kind::number, {}, {}};
    key.set = [member, least, most](GatewaySettings& settings, std::string const& text) {
        auto const number = number_within(text, least, most);
        if (number) member(settings) = std::chrono::milliseconds{std::llround(*number * 1'000)};
        return number.has_value();
    };
    key.show = [member](GatewaySettings const& settings) {
        return text_of(static_cast<double>(read(member, settings).count()) / 1'000);
    };
    return key;
}

inline Key file(std::string name, std::string help, Member<std::string> const& member) {
    Key key{std::move(name), std::move(help), "FILE", "a text", Key::Kind::text, {}, {}};
    key.set = [member](GatewaySettings& settings, std::string const& text) { return member(settings) = text, true; };
    key.show = [member](GatewaySettings const& settings) { return read(member, settings); };
    return key;
}

template <class T>
Key choice(std::string name, std::string help, Member<T> const& member, std::vector<std::pair<std::string, T>> const& choices) {
    std::string all;
    for (auto const& [text, value] : choices) all += (all.empty() ? "" : "|") + text;
    Key key{std::move(name), std::move(help), all, "one of " + all, Key::Kind::text, {}, {}};
    key.set = [member, choices](GatewaySettings& settings, std::string const& text) {
        auto const found = std::ranges::find(choices, text, &std::pair<std::string, T>::first);
        if (found == choices.end()) return false;
        member(settings) = found->second;
        return true;
    };
    key.show = [member, choices](GatewaySettings const& settings) {
        return std::ranges::find(choices, read(member, settings), &std::pair<std::string, T>::second)->first;
    };
    return key;
}

}  // namespace rois
