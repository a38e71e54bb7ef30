#include <memory>
#include <stdexcept>
#include <string>
#include <variant>

#include "basic/speech/grammar.hpp"
#include "basic/speech/srgs_grammar.hpp"
#include "basic/speech/ssml.hpp"
#include "engine/conditions/filter.hpp"
#include "files/files.hpp"
#include "fuzzing/targets.hpp"
#include "xml/codec/codec.hpp"
#include "xml/profiles/profile_document.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::fuzzing {

namespace {

std::shared_ptr<xml::Schemas const> const& schemas() {
    static xml::Platform const platform;
    static auto const all = std::make_shared<xml::Schemas const>(files::schemas());
    return all;
}

}  // namespace

// What the tables accept, xerces-c accepts too. What was read can be written, and reads as the same again.
void messages(std::string_view input) {
    static xml::RequestReader fast{schemas()}, full{schemas(), {}, xml::Validation::full};
    auto const read = fast.read(input);
    auto const* request = std::get_if<Request>(&read);
    if (request == nullptr) return;
    if (!std::holds_alternative<Request>(full.read(input)))
        throw std::logic_error{"xerces-c rejects a document that the tables accept"};
    auto const text = xml::encode(*request);
    auto const again = full.read(text);
    auto const* same = std::get_if<Request>(&again);
    if (same == nullptr) throw std::logic_error{"the document that was written is invalid: " + std::get<Fault>(again).reason};
    if (xml::encode(*same) != text) throw std::logic_error{"the document changes when it is read and written again: " + text};
}

// The input is the condition of a search.
void conditions(std::string_view input) {
    static xml::RequestReader reader{schemas()};
    auto const document =
        "<search xmlns=\"urn:x-rois:psm:xml:message:1\" xmlns:fes=\"http://www.opengis.net/fes/2.0\" "
        "xmlns:gml=\"http://www.opengis.net/gml/3.2\" xmlns:unr=\"http://www.irc.atr.jp/std/unr/0.1\"><condition>" +
        std::string{input} + "</condition></search>";
    auto const read = reader.read(document);
    auto const* request = std::get_if<Request>(&read);
    auto const* search = request == nullptr ? nullptr : std::get_if<Search>(&request->operation);
    if (search == nullptr) return;
    Places const places;
    Declarations parameters;
    parameters.add({.name = "speed", .data_type_ref = {"double", {}, {}, {}}, .default_value = {}, .description = {}});
    auto const compiled = Selection::compile(search->condition, {.places = &places, .parameters = &parameters});
    if (auto const* selection = std::get_if<Selection>(&compiled)) static_cast<void>(selection->filter().demand());
}

void answers(std::string_view input) {
    static xml::AnswerReader reader;
    static_cast<void>(reader.read(input));
    static_cast<void>(reader.read_stop_state(input));
    static_cast<void>(reader.read_engines(input));
}

void profiles(std::string_view input) {
    static auto const& all = schemas();
    try {
        static_cast<void>(xml::read_component_profile(all, "profile.xml", std::string{input}));
    } catch (xml::BadDocument const&) {
        // what an invalid profile gets
    }
}

void speech(std::string_view input) {
    static auto const& all = schemas();
    static_cast<void>(basic::read_ssml(input));
    static_cast<void>(basic::SrgsGrammar::read(all, input));
    static_cast<void>(basic::Grammar::read(input, ""));
}

}  // namespace rois::fuzzing
