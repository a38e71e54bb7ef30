// Rules that are observable over HTTP only.

#include "broken/breaking.hpp"
#include "broken/rules.hpp"

namespace rois::broken {

namespace {

void replace(std::string& text, std::string_view part, std::string_view by) {
    if (auto const at = text.find(part); at != std::string::npos) text.replace(at, part.size(), by);
}

Breaking answers_with_status(std::string const& expected, std::string const& status) {
    return {.http_reply = [=](Message const&, Message& reply) {
        replace(reply.first_line, " " + expected + " ", " " + status + " ");
    }};
}

Breaking omits_header(std::string const& header) {
    return {.http_reply = [=](Message const&, Message& reply) {
        std::erase_if(reply.headers, [&](auto const& line) { return line.starts_with(header + ":"); });
    }};
}

Breaking omits_the_line() {
    return {.http_reply = [](Message const&, Message& reply) {
        if (is(reply.body, "fault")) reply.body = edited(reply.body, [](pugi::xml_node root) { root.remove_attribute("line"); });
    }};
}

Breaking ignores_if_none_match() {
    return {.http_request = [](Message& request) {
        std::erase_if(request.headers, [](auto const& line) { return line.starts_with("If-None-Match"); });
    }};
}

Breaking ignores_after() {
    return {.http_request = [](Message& request) { replace(request.first_line, "after=2", "after=0"); }};
}

Breaking accepts_plain_text() {
    return {.http_request = [](Message& request) {
        for (auto& line : request.headers) replace(line, "text/plain", "text/xml");
    }};
}

Breaking changes_profile_ids() {
    return {.http_reply = [](Message const& request, Message& reply) {
        if (request.first_line.starts_with("GET /rois/profile/")) replace(reply.body, "gml:id=\"profile.", "gml:id=\"a.");
    }};
}

Breaking omits_an_element(std::string const& document, std::string const& element) {
    return {.http_reply = [=](Message const& request, Message& reply) {
        if (!request.first_line.starts_with("GET " + document + " ")) return;
        reply.body = edited(reply.body, [&](pugi::xml_node root) {
            auto const first = root.select_node((".//" + element).c_str()).node();
            first.parent().remove_child(first);
        });
    }};
}

Breaking accepts_document_types() {
    return {.http_request = [](Message& request) {
        if (auto const end = request.body.find("]>"); request.body.starts_with("<!DOCTYPE")) request.body.erase(0, end + 2);
    }};
}

// Applies to messages with this text in the body, or in the first line of the request.
Breaking declares_plain_text(std::string const& part) {
    return {.http_reply = [=](Message const& request, Message& reply) {
        if (reply.body.find(part) == std::string::npos && request.first_line.find(part) == std::string::npos) return;
        for (auto& line : reply.headers) replace(line, "application/xml", "text/plain");
    }};
}

Breaking omits_component_etags() {
    return {.http_reply = [](Message const& request, Message& reply) {
        if (request.first_line.starts_with("GET /rois/profile/"))
            std::erase_if(reply.headers, [](auto const& line) { return line.starts_with("ETag:"); });
    }};
}

}  // namespace

std::vector<BrokenRule> rules_of_http() {
    auto const http = Over::http;
    return {
        {"an invalid document is answered with 400", "an_invalid_document_is_refused_with_line_and_column",
         [] { return answers_with_status("422", "400"); }, http},
        {"faults have no line", "a_fault_has_the_line_and_the_request_id", omits_the_line, http},
        {"document types are accepted", "document_types_and_processing_instructions_are_refused", accepts_document_types, http},
        {"text/plain is accepted as XML", "unsupported_content_types_are_refused", accepts_plain_text, http},
        {"the header Allow is missing", "unsupported_methods_are_refused", [] { return omits_header("Allow"); }, http},
        {"a missing session is answered with 401", "an_unknown_session_is_refused",
         [] { return answers_with_status("403", "401"); }, http},
        {"resume works over HTTP", "resume_over_http_is_refused", [] { return answers_with("resume", "not_allowed", "OK"); },
         http},
        {"a plain GET is answered with 404", "a_plain_get_requires_an_upgrade", [] { return answers_with_status("426", "404"); },
         http},
        {"If-None-Match is ignored", "profile_documents_have_etags", ignores_if_none_match, http},
        {"profiles have another gml:id", "profiles_are_served_as_documents", changes_profile_ids, http},
        {"the engine's document lacks a component", "profiles_are_served_as_documents",
         [] { return omits_an_element("/rois/profile", "rois:HRIComponent"); }, http},
        {"a component's document lacks a message", "profiles_are_served_as_documents",
         [] { return omits_an_element("/rois/profile/follow", "rois:MessageProfile"); }, http},
        {"profiles of components have no ETag", "profile_documents_have_etags", omits_component_etags, http},
        {"faults are plain text", "documents_are_application_xml", [] { return declares_plain_text("<fault"); }, http},
        {"answers are plain text", "documents_are_application_xml", [] { return declares_plain_text("_response"); }, http},
        {"notifications are plain text", "documents_are_application_xml", [] { return declares_plain_text("<notifications"); },
         http},
        {"profiles are plain text", "documents_are_application_xml", [] { return declares_plain_text("/rois/profile"); }, http},
        {"a long poll returns everything again", "a_long_poll_discards_no_notification", ignores_after, http}};
}

}  // namespace rois::broken
