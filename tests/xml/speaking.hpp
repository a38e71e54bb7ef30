// Helpers for the tests of this folder: make documents and read them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

#include "files/files.hpp"
#include "xml/codec/codec.hpp"
#include "xml/profiles/document.hpp"
#include "xml/profiles/profile_document.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::xml {

inline constexpr std::string_view prefixes =
    R"( xmlns="urn:x-rois:psm:xml:message:1" xmlns:rois="http://www.omg.org/spec/RoIS/20240801")"
    R"( xmlns:fes="http://www.opengis.net/fes/2.0" xmlns:unr="http://www.irc.atr.jp/std/unr/0.1")"
    R"( xmlns:gml="http://www.opengis.net/gml/3.2")"
    R"( xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance")";

// Returns the element `root` with all the prefixes that requests need, and this content.
inline std::string document(std::string_view root, std::string_view inside = {}, std::string_view attributes = {}) {
    std::ostringstream text;
    text << '<' << root << prefixes << attributes;
    if (inside.empty()) {
        text << "/>";
    } else {
        text << '>' << inside << "</" << root << '>';
    }
    return text.str();
}

inline std::shared_ptr<Schemas const> schemas() {
    static Platform const platform;
    static auto const compiled = std::make_shared<Schemas const>(files::schemas());
    return compiled;
}

inline std::variant<Request, Fault> read(std::string_view text, DocumentLimits limits = {}) {
    return RequestReader{schemas(), limits}.read(text);
}

// Returns the request of a document. The test fails if it is rejected.
inline Request request(std::string_view text) {
    auto answer = read(text);
    if (auto const* fault = std::get_if<Fault>(&answer)) {
        ADD_FAILURE() << text << "\nwas rejected: " << fault->reason;
        return {};
    }
    return std::get<Request>(std::move(answer));
}

template <class Wanted>
Wanted operation(std::string_view text) {
    auto const read_request = request(text);
    auto const* found = std::get_if<Wanted>(&read_request.operation);
    EXPECT_NE(found, nullptr) << text;
    return found == nullptr ? Wanted{} : *found;
}

// Returns why a document is rejected. The test fails if it is accepted.
inline Fault fault(std::string_view text, DocumentLimits limits = {}) {
    auto answer = read(text, limits);
    if (std::holds_alternative<Fault>(answer)) return std::get<Fault>(std::move(answer));
    ADD_FAILURE() << std::string{text.substr(0, 500)} << "\nwas accepted";
    return {};
}

// Returns the place of a fault as "2:3", or "-" if it has none.
inline std::string place(Fault const& of) {
    return of.place ? std::to_string(of.place->line) + ":" + std::to_string(of.place->column) : "-";
}

// Returns the error of a document of any kind as "name:line:column: reason"; empty if it is valid.
inline std::string problem(std::string const& name, std::string text) {
    try {
        Document::parse(schemas(), name, std::move(text));
        return {};
    } catch (BadDocument const& e) {
        return e.what();
    }
}

// Returns the first child with this name. Throws if there is none.
inline Element child(Element const& parent, std::string_view name) {
    auto const found = parent.child(name);
    if (!found) throw std::runtime_error{"there is no element " + std::string{name}};
    return *found;
}

inline std::string file(std::filesystem::path const& path) {
    std::ifstream in{path, std::ios::binary};
    EXPECT_TRUE(in) << path;
    return {std::istreambuf_iterator<char>{in}, {}};
}

inline std::filesystem::path samples() { return std::filesystem::path{ROIS_SOURCE_DIR} / "schemas" / "samples"; }

}  // namespace rois::xml
