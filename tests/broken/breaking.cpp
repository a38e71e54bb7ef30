#include "broken/breaking.hpp"

#include <sstream>

namespace rois::broken {

bool is(std::string const& document, std::string const& name) {
    auto const after = name.size() + 1;
    return document.starts_with("<" + name) && document.size() > after &&
           std::string{" />"}.find(document[after]) != std::string::npos;
}

void replace_all(std::string& text, std::string_view part, std::string_view by) {
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + by.size()))
        text.replace(at, part.size(), by);
}

std::string edited(std::string const& document, Edit const& edit) {
    pugi::xml_document parsed;
    if (!parsed.load_buffer(document.data(), document.size(), pugi::parse_default | pugi::parse_ws_pcdata)) return document;
    edit(parsed.document_element());
    std::ostringstream text;
    parsed.save(text, "", pugi::format_raw | pugi::format_no_declaration);
    return text.str();
}

std::string response(std::string const& request, std::string const& return_code, std::string const& children) {
    pugi::xml_document parsed;
    parsed.load_buffer(request.data(), request.size());
    auto const root = parsed.document_element();
    std::string const name = std::string{root.name()} + "_response";
    std::string const id = root.attribute("request_id").value();
    return "<" + name +
           " xmlns=\"urn:x-rois:psm:xml:message:1\" xmlns:rois=\"http://www.omg.org/spec/RoIS/20240801\" return_code=\"" +
           return_code + "\"" + (id.empty() ? "" : " request_id=\"" + id + "\"") + ">" + children + "</" + name + ">";
}

Breaking answers_with(std::string const& operation, std::string const& expected, std::string const& return_code,
                      std::string const& children) {
    return {.answer = [=](std::string const& request, std::string const& answer, ProxiedConnection&) -> Documents {
        bool const is_expected = answer.find("return_code=\"" + expected + "\"") != std::string::npos ||
                                 answer.find("code=\"" + expected + "\"") != std::string::npos;
        if (!is(request, operation) || !is_expected) return {answer};
        return {response(request, return_code, children)};
    }};
}

Breaking ignores_operation(std::string const& operation) {
    return {.instead = [=](std::string const& request) -> Documents {
        if (!is(request, operation)) return {};
        return {response(request, "OK")};
    }};
}

Breaking edits_answers(std::string const& operation, Edit const& edit) {
    return {.answer = [=](std::string const& request, std::string const& answer, ProxiedConnection&) -> Documents {
        if (!operation.empty() && !is(request, operation)) return {answer};
        return {edited(answer, edit)};
    }};
}

Breaking edits_requests(std::string const& operation, Edit const& edit) {
    return {.request = [=](std::string const& request) { return is(request, operation) ? edited(request, edit) : request; }};
}

Breaking edits_notifications(std::string const& name, Edit const& edit) {
    return {.notification = [=](std::string const& notification) -> Documents {
        if (!is(notification, name)) return {notification};
        return {edited(notification, edit)};
    }};
}

Breaking repeats(std::string const& name) {
    return {.notification = [=](std::string const& notification) -> Documents {
        if (!is(notification, name)) return {notification};
        return {notification, notification};
    }};
}

void remove_condition(pugi::xml_node root) { root.remove_child("condition"); }

void for_each_below(pugi::xml_node root, Edit const& edit) {
    for (auto child = root.first_child(); child;) {
        auto const next = child.next_sibling();
        for_each_below(child, edit);
        edit(child);
        child = next;
    }
}

}  // namespace rois::broken
