// The rules of docs/clients.md for HTTP: status codes, faults, malformed and invalid documents.
#include "kit/http_client.hpp"

#include <regex>
#include <set>

#include "conformance/context.hpp"

namespace rois::conformance {

namespace {

using kit::Headers;
using kit::HttpClient;
using kit::HttpReply;

void answered(Context& context, HttpReply const& reply, int status, std::string const& code) {
    require(reply.status == status,
            "expected status " + std::to_string(status) + ", got " + std::to_string(reply.status) + ": " + reply.body);
    require_equal("the fault", code, reply.fault());
    require(!reply.reason().empty(), "expected a reason in the fault, got " + reply.body);
    context.traffic().validate(reply.body);
}

void malformed_xml_is_refused(Context& context) {
    HttpClient client{context.address()};
    for (auto const* const body : {"", " ", "<connect", "hello", "<connect xmlns=\"urn:x-rois:psm:xml:message:1\">", "\xC3\x28"})
        answered(context, client.post(body), 400, "not_well_formed");
}

void document_types_and_processing_instructions_are_refused(Context& context) {
    HttpClient client{context.address()};
    answered(context, client.post("<!DOCTYPE connect [<!ENTITY a \"b\">]>" + kit::request("connect")), 400, "forbidden_xml");
    answered(context, client.post("<?php echo?>" + kit::request("connect")), 400, "forbidden_xml");
}

void an_invalid_document_is_refused_with_line_and_column(Context& context) {
    HttpClient client{context.address()};
    auto const invalid = [&](std::string const& body) {
        auto const reply = client.post(body);
        answered(context, reply, 422, "invalid");
        require(reply.root().attribute("line").as_int() >= 1 && reply.root().attribute("column").as_int() >= 1,
                "expected line and column in the fault, got " + reply.body);
    };
    invalid(kit::request("dance"));
    invalid("<connect/>");
    invalid(kit::request("connect", "<nonsense/>"));
    invalid(kit::request("bind", "<component_ref/>"));
    invalid(kit::request("bind"));
    invalid(kit::request("connect", {}, {{"colour", "red"}}));
}

void a_fault_has_the_line_and_the_request_id(Context& context) {
    HttpClient client{context.address()};
    auto const reply =
        client.post("<connect\n  xmlns=\"urn:x-rois:psm:xml:message:1\"\n  request_id=\"mine\">\n  <nonsense/>\n</connect>");
    answered(context, reply, 422, "invalid");
    require_equal("the line", "4", reply.root().attribute("line").value());
    require_equal("the request_id", "mine", reply.root().attribute("request_id").value());
}

void unsupported_content_types_are_refused(Context& context) {
    HttpClient client{context.address()};
    for (auto const* const type : {"text/plain", "application/json", "application/x-www-form-urlencoded"})
        answered(context, client.post(kit::request("connect"), {{"Content-Type", type}}), 415, "unsupported_media_type");
    answered(context, client.post(kit::request("connect"), {}), 415, "unsupported_media_type");
    for (auto const* const type : {"application/xml", "text/xml", "application/soap+xml"}) {
        HttpClient other{context.address()};
        auto const reply = other.post(kit::request("connect"), {{"Content-Type", type}});
        require(reply.status == 200,
                std::string{"Content-Type "} + type + ": expected status 200, got " + std::to_string(reply.status));
        other.session = reply.text("session");
    }
}

void unsupported_methods_are_refused(Context& context) {
    HttpClient client{context.address()};
    for (auto const* const method : {"PUT", "DELETE", "OPTIONS", "get"}) {
        auto const reply = client.get("/rois", {}, method);
        answered(context, reply, 405, "method_not_allowed");
        require(reply.header("Allow").find("POST") != std::string::npos,
                std::string{method} + " /rois: expected POST in the header Allow, got '" + reply.header("Allow") + "'");
    }
}

void unknown_paths_are_not_found(Context& context) {
    HttpClient client{context.address()};
    for (auto const* const path : {"/nowhere", "/rois/profile/conformance_unknown", "/rois/schemas/nothing.xsd"})
        answered(context, client.get(path), 404, "not_found");
}

void a_plain_get_requires_an_upgrade(Context& context) {
    HttpClient client{context.address()};
    answered(context, client.get("/rois"), 426, "upgrade_required");
}

void a_transfer_encoding_is_refused(Context& context) {
    HttpClient client{context.address()};
    auto const reply = client.say("POST /rois HTTP/1.1\r\nHost: " + context.address().authority +
                                  "\r\nTransfer-Encoding: chunked\r\nContent-Type: text/xml\r\n\r\n0\r\n\r\n");
    if (reply.status == 401) throw Skipped{"the gateway requires a token"};
    answered(context, reply, 411, "length_required");
}

void malformed_http_is_refused(Context& context) {
    auto const host = "Host: " + context.address().authority + "\r\n";
    for (auto const& head : {std::string{"GET /healthz HTTP/1.1\r\n"}, "GET /healthz HTTP/1.1\r\n" + host + host,
                             "POST /rois HTTP/1.1\r\n" + host + "Content-Length: 5\r\nContent-Length: 6\r\n",
                             "POST /rois HTTP/1.1\r\n" + host + "Content-Length: -1\r\n"}) {
        HttpClient client{context.address()};
        auto const reply = client.say(head + "\r\n");
        require(reply.status == 400, "expected status 400, got " + std::to_string(reply.status) + " for " + head);
    }
}

void schemas_are_served(Context& context) {
    HttpClient client{context.address()};
    auto const list = client.get("/rois/schemas");
    require(list.status == 200, "GET /rois/schemas: expected status 200, got " + std::to_string(list.status));
    static std::regex const file_name{"[A-Za-z0-9_.-]+[.]xsd"};
    std::set<std::string> const files{std::sregex_token_iterator{list.body.begin(), list.body.end(), file_name}, {}};
    require(!files.empty(), "GET /rois/schemas: expected a list of schemas, got " + list.body);
    for (auto const& file : files) {
        auto const reply = client.get("/rois/schemas/" + file);
        std::string const root = reply.root().name();
        require(reply.status == 200 && (root == "schema" || root.ends_with(":schema")),
                "GET /rois/schemas/" + file + ": expected a schema with status 200, got status " + std::to_string(reply.status));
    }
}

void health_is_reported(Context& context) {
    HttpClient client{context.address()};
    for (auto const* const path : {"/healthz", "/readyz"}) {
        auto const reply = client.get(path);
        require(reply.status == 200, std::string{"GET "} + path + ": expected status 200, got " + std::to_string(reply.status));
    }
}

void documents_are_application_xml(Context& context) {
    HttpClient client{context.address()};
    auto const is_xml = [](std::string const& what, HttpReply const& reply) {
        auto const type = reply.header("Content-Type");
        require(type.substr(0, type.find(';')) == "application/xml",
                what + ": expected the Content-Type application/xml, got '" + type + "'");
    };
    is_xml("the fault no_session", client.call("search"));
    is_xml("the fault not_well_formed", client.post("<connect"));
    is_xml("the fault invalid", client.post("<connect/>"));
    is_xml("the fault not_found", client.get("/nowhere"));
    is_xml("the answer of connect", client.call("connect"));
    is_xml("a refusal", client.call("bind", kit::component_ref(unknown_name)));
    is_xml("the answer of search", client.call("search"));
    is_xml("a list of notifications", client.notifications(0, 0));
    is_xml("the engine's profile", client.get("/rois/profile"));
    for (auto const& component : context.catalogue().components)
        is_xml("the profile of " + component.ref, client.get("/rois/profile/" + kit::path_segment(component.ref)));
}

void every_operation_is_answered_with_200(Context& context) {
    HttpClient client{context.address()};
    require(client.call("connect").status == 200, "connect: expected status 200");
    auto const refusal = client.call("bind", kit::component_ref(unknown_name));
    require(refusal.status == 200 && refusal.return_code() == "BAD_PARAMETER",
            "bind of an unknown component: expected status 200 and BAD_PARAMETER, got status " + std::to_string(refusal.status));
    require_equal("the content type", "application/xml", refusal.header("Content-Type").substr(0, 15));
}

}  // namespace

Clause http_clause() {
    auto const http = Transport::http;
    return {"Transport: HTTP",
            {{"every_operation_is_answered_with_200", "docs/clients.md", every_operation_is_answered_with_200, http},
             {"documents_are_application_xml", "docs/clients.md", documents_are_application_xml, http},
             {"malformed_xml_is_refused", "docs/clients.md", malformed_xml_is_refused, http},
             {"document_types_and_processing_instructions_are_refused", "docs/clients.md",
              document_types_and_processing_instructions_are_refused, http},
             {"an_invalid_document_is_refused_with_line_and_column", "docs/clients.md; schemas",
              an_invalid_document_is_refused_with_line_and_column, http},
             {"a_fault_has_the_line_and_the_request_id", "docs/clients.md", a_fault_has_the_line_and_the_request_id, http},
             {"unsupported_content_types_are_refused", "docs/clients.md", unsupported_content_types_are_refused, http},
             {"unsupported_methods_are_refused", "docs/clients.md", unsupported_methods_are_refused, http},
             {"unknown_paths_are_not_found", "docs/clients.md", unknown_paths_are_not_found, http},
             {"a_plain_get_requires_an_upgrade", "docs/clients.md", a_plain_get_requires_an_upgrade, http},
             {"a_transfer_encoding_is_refused", "docs/clients.md", a_transfer_encoding_is_refused, http},
             {"malformed_http_is_refused", "docs/clients.md", malformed_http_is_refused, http},
             {"schemas_are_served", "docs/clients.md", schemas_are_served, http},
             {"health_is_reported", "docs/clients.md", health_is_reported, http}}};
}

}  // namespace rois::conformance
