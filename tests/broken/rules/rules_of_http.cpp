// Rules that are observable over HTTP only.

#include "broken/breaking.hpp"
#include "broken/rules.hpp"

namespace rois::broken {

namespace {

void replace(std::string& text, std::string_view part, std::string_view by) {
    if (auto const at = text.find(part); at != std::string::npos) text.replace(at, part.size(), by);
}

Breaking answers_with_status(std::string const& due, std::string const& status) {
    return {
        .http_reply = [=](Message const&, Message& reply) { replace(reply.first_line, " " + due + " ", " " + status + " "); }};
}

Breaking leaves_out(std::string const& header) {
    return {.http_reply = [=](Message const&, Message& reply) {
        std::erase_if(reply.headers, [&](auto const& line) { return line.starts_with(header + ":"); });
    }};
}

Breaking says_no_place() {
    return {.http_reply = [](Message const&, Message& reply) {
        if (is(reply.body, "fault")) reply.body = edited(reply.body, [](pugi::xml_node root) { root.remove_attribute("line"); });
    }};
}

Breaking knows_no_etag() {
    return {.http_request = [](Message& request) {
        std::erase_if(request.headers, [](auto const& line) { return line.starts_with("If-None-Match"); });
    }};
}

Breaking tells_all_notifications() {
    return {.http_request = [](Message& request) { replace(request.first_line, "after=2", "after=0"); }};
}

Breaking takes_any_text() {
    return {.http_request = [](Message& request) {
        for (auto& line : request.headers) replace(line, "text/plain", "text/xml");
    }};
}

Breaking names_profiles_otherwise() {
    return {.http_reply = [](Message const& request, Message& reply) {
        if (request.first_line.starts_with("GET /rois/profile/")) replace(reply.body, "gml:id=\"profile.", "gml:id=\"a.");
    }};
}

Breaking tells_less_in_documents(std::string const& document, std::string const& element) {
    return {.http_reply = [=](Message const& request, Message& reply) {
        if (!request.first_line.starts_with("GET " + document + " ")) return;
        reply.body = edited(reply.body, [&](pugi::xml_node root) {
            auto const first = root.select_node((".//" + element).c_str()).node();
            first.parent().remove_child(first);
        });
    }};
}

Breaking reads_document_types() {
    return {.http_request = [](Message& request) {
        if (auto const end = request.body.find("]>"); request.body.starts_with("<!DOCTYPE")) request.body.erase(0, end + 2);
    }};
}

// Applies to messages with this text in the body, or in the first line of the request.
Breaking calls_it_text(std::string const& part) {
    return {.http_reply = [=](Message const& request, Message& reply) {
        if (reply.body.find(part) == std::string::npos && request.first_line.find(part) == std::string::npos) return;
        for (auto& line : reply.headers) replace(line, "application/xml", "text/plain");
    }};
}

Breaking tags_the_engine_alone() {
    return {.http_reply = [](Message const& request, Message& reply) {
        if (request.first_line.starts_with("GET /rois/profile/"))
            std::erase_if(reply.headers, [](auto const& line) { return line.starts_with("ETag:"); });
    }};
}

}  // namespace

std::vector<BrokenRule> rules_of_http() {
    auto const http = Over::http;
    return {
        {"an invalid document is answered with 400", "what_is_not_valid_is_refused_with_its_place",
         [] { return answers_with_status("422", "400"); }, http},
        {"faults have no line", "a_fault_says_where", says_no_place, http},
        {"document types are read", "document_types_and_instructions_are_refused", reads_document_types, http},
        {"any text is taken for XML", "other_content_types_are_refused", takes_any_text, http},
        {"methods are not named", "other_methods_are_refused", [] { return leaves_out("Allow"); }, http},
        {"a missing session is answered with 401", "an_unknown_session_is_refused",
         [] { return answers_with_status("403", "401"); }, http},
        {"resume works over HTTP", "resume_is_for_websockets", [] { return says("resume", "not_allowed", "OK"); }, http},
        {"a plain GET is answered with 404", "a_plain_get_is_asked_to_upgrade", [] { return answers_with_status("426", "404"); },
         http},
        {"documents are sent again", "documents_are_told_apart_by_etag", knows_no_etag, http},
        {"profiles are named otherwise", "profiles_are_served_as_documents", names_profiles_otherwise, http},
        {"the engine's document lacks a component", "profiles_are_served_as_documents",
         [] { return tells_less_in_documents("/rois/profile", "rois:HRIComponent"); }, http},
        {"a component's document lacks a message", "profiles_are_served_as_documents",
         [] { return tells_less_in_documents("/rois/profile/follow", "rois:MessageProfile"); }, http},
        {"profiles of components have no ETag", "documents_are_told_apart_by_etag", tags_the_engine_alone, http},
        {"faults are plain text", "documents_are_application_xml", [] { return calls_it_text("<fault"); }, http},
        {"answers are plain text", "documents_are_application_xml", [] { return calls_it_text("_response"); }, http},
        {"notifications are plain text", "documents_are_application_xml", [] { return calls_it_text("<notifications"); }, http},
        {"profiles are plain text", "documents_are_application_xml", [] { return calls_it_text("/rois/profile"); }, http},
        {"a long poll returns everything again", "reading_discards_nothing", tells_all_notifications, http}};
}

}  // namespace rois::broken
