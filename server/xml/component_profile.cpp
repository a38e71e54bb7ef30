#include <utility>

#include "types/texts.hpp"
#include "xml/decoding.hpp"
#include "xml/document.hpp"

namespace rois::xml {

namespace {

std::string text_of_child(Element const& element, std::string_view name) {
    auto const found = element.child(name);
    return found ? std::string{trimmed(found->text())} : std::string{};
}

IdentifiedObject read_object(Element const& root) {
    auto const identifier = root.child("identifier");
    return {text_of_child(root, "identifier"), identifier ? identifier->attribute("codeSpace", "") : std::string{},
            text_of_child(root, "name"), text_of_child(root, "description")};
}

Identifier read_identifier(Element const& element) {
    return {element.attribute("code", ""), element.attribute("authority", ""), element.attribute("codebook_ref", ""),
            element.attribute("version", "")};
}

ParameterProfile read_parameter(Element const& element) {
    auto const type = element.child("data_type_ref");
    return {element.attribute("name", ""), type ? read_identifier(*type) : Identifier{}, element.attribute("default_value"),
            element.attribute("description", "")};
}

std::vector<ParameterProfile> read_parameters(Element const& parent, std::string_view name) {
    std::vector<ParameterProfile> parameters;
    for (auto const& each : parent.children(name)) parameters.push_back(read_parameter(each));
    return parameters;
}

MessageKind kind_of(Element const& message) {
    auto const type = message.type();
    if (type == "CommandMessageProfileType") return MessageKind::command;
    if (type == "QueryMessageProfileType") return MessageKind::query;
    if (type == "EventMessageProfileType") return MessageKind::event;
    throw message.complain(
        "a message needs an xsi:type: expected one of CommandMessageProfileType, QueryMessageProfileType, "
        "EventMessageProfileType");
}

// A timeout is the number of milliseconds within which a command must have started (decision 16).
std::optional<std::chrono::milliseconds> read_timeout(Element const& message) {
    auto const text = message.attribute("timeout");
    if (!text) return std::nullopt;
    auto const milliseconds = decode_integer(*text);
    constexpr std::int64_t longest = 1'000LL * 60 * 60 * 24 * 365;
    if (milliseconds < 0 || milliseconds > longest) {
        throw message.complain("the timeout is " + quoted(*text) + ": expected milliseconds from 0 to " +
                               std::to_string(longest));
    }
    return std::chrono::milliseconds{milliseconds};
}

MessageProfile read_message(Element const& element) {
    return {kind_of(element), element.attribute("name", ""), read_parameters(element, "Results"),
            read_parameters(element, "Arguments"), read_timeout(element)};
}

}  // namespace

ComponentProfile read_component_profile(std::shared_ptr<Schemas const> schemas, std::string name, std::string text) {
    auto const root = Document::parse(std::move(schemas), std::move(name), std::move(text)).root();
    if (root.name() != "HRIComponentProfile") {
        throw root.complain("the root element is " + quoted(root.name()) + ": expected 'HRIComponentProfile'");
    }
    ComponentProfile profile{read_object(root), {}, {}, read_parameters(root, "ParameterProfile")};
    for (auto const& sub : root.children("SubComponentProfile")) profile.sub_components.emplace_back(trimmed(sub.text()));
    for (auto const& message : root.children("MessageProfile")) profile.messages.push_back(read_message(message));
    return profile;
}

}  // namespace rois::xml
