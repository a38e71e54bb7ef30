// The rules of docs/clients.md for HTTP: status codes, faults and documents; documents that are not XML or invalid.
#include "kit/http_client.hpp"

#include <regex>
#include <set>

#include "conformance/stage.hpp"

namespace rois::conformance {

namespace {

using kit::Headers;
using kit::HttpClient;
using kit::HttpReply;

void answered(Stage& stage, HttpReply const& reply, int status, std::string const& code) {
    require(reply.status == status,
            "the status should be " + std::to_string(status) + ", and is " + std::to_string(reply.status) + ": " + reply.body);
    same("the fault", code, reply.fault());
    require(!reply.reason().empty(), "a fault has a reason: " + reply.body);
    stage.traffic().validate(reply.body);
}

void what_is_not_well_formed_is_refused(Stage& stage) {
    HttpClient client{stage.address()};
    for (auto const* const body : {"", " ", "<connect", "hello", "<connect xmlns=\"urn:x-rois:psm:xml:message:1\">", "\xC3\x28"})
        answered(stage, client.post(body), 400, "not_well_formed");
}

void document_types_and_instructions_are_refused(Stage& stage) {
    HttpClient client{stage.address()};
    answered(stage, client.post("<!DOCTYPE connect [<!ENTITY a \"b\">]>" + kit::request("connect")), 400, "forbidden_xml");
    answered(stage, client.post("<?php echo?>" + kit::request("connect")), 400, "forbidden_xml");
}

void what_is_not_valid_is_refused_with_its_place(Stage& stage) {
    HttpClient client{stage.address()};
    auto const invalid = [&](std::string const& body) {
        auto const reply = client.post(body);
        answered(stage, reply, 422, "invalid");
        require(reply.root().attribute("line").as_int() >= 1 && reply.root().attribute("column").as_int() >= 1,
                "the fault should have a line and a column: " + reply.body);
    };
    invalid(kit::request("dance"));
    invalid("<connect/>");
    invalid(kit::request("connect", "<nonsense/>"));
    invalid(kit::request("bind", "<component_ref/>"));
    invalid(kit::request("bind"));
    invalid(kit::request("connect", {}, {{"colour", "red"}}));
}

void a_fault_says_where(Stage& stage) {
    HttpClient client{stage.address()};
    auto const reply =
        client.post("<connect\n  xmlns=\"urn:x-rois:psm:xml:message:1\"\n  request_id=\"mine\">\n  <nonsense/>\n</connect>");
    answered(stage, reply, 422, "invalid");
    same("the line", "4", reply.root().attribute("line").value());
    same("the request_id", "mine", reply.root().attribute("request_id").value());
}

void other_content_types_are_refused(Stage& stage) {
    HttpClient client{stage.address()};
    for (auto const* const type : {"text/plain", "application/json", "application/x-www-form-urlencoded"})
        answered(stage, client.post(kit::request("connect"), {{"Content-Type", type}}), 415, "unsupported_media_type");
    answered(stage, client.post(kit::request("connect"), {}), 415, "unsupported_media_type");
    for (auto const* const type : {"application/xml", "text/xml", "application/soap+xml"}) {
        HttpClient other{stage.address()};
        auto const reply = other.post(kit::request("connect"), {{"Content-Type", type}});
        require(reply.status == 200, std::string{type} + " is answered with " + std::to_string(reply.status));
        other.session = reply.text("session");
    }
}

void other_methods_are_refused(Stage& stage) {
    HttpClient client{stage.address()};
    for (auto const* const method : {"PUT", "DELETE", "OPTIONS", "get"}) {
        auto const reply = client.get("/rois", {}, method);
        answered(stage, reply, 405, "method_not_allowed");
        require(reply.header("Allow").find("POST") != std::string::npos,
                "Allow should name POST, and is " + reply.header("Allow"));
    }
}

void unknown_paths_are_not_found(Stage& stage) {
    HttpClient client{stage.address()};
    for (auto const* const path : {"/nowhere", "/rois/profile/conformance_nobody", "/rois/schemas/nothing.xsd"})
        answered(stage, client.get(path), 404, "not_found");
}

void a_plain_get_is_asked_to_upgrade(Stage& stage) {
    HttpClient client{stage.address()};
    answered(stage, client.get("/rois"), 426, "upgrade_required");
}

void a_transfer_encoding_is_refused(Stage& stage) {
    HttpClient client{stage.address()};
    auto const reply = client.say("POST /rois HTTP/1.1\r\nHost: " + stage.address().authority +
                                  "\r\nTransfer-Encoding: chunked\r\nContent-Type: text/xml\r\n\r\n0\r\n\r\n");
    if (reply.status == 401) throw NotPlayed{"a token is needed"};
    answered(stage, reply, 411, "length_required");
}

void broken_http_is_refused(Stage& stage) {
    auto const host = "Host: " + stage.address().authority + "\r\n";
    for (auto const& head : {std::string{"GET /healthz HTTP/1.1\r\n"}, "GET /healthz HTTP/1.1\r\n" + host + host,
                             "POST /rois HTTP/1.1\r\n" + host + "Content-Length: 5\r\nContent-Length: 6\r\n",
                             "POST /rois HTTP/1.1\r\n" + host + "Content-Length: -1\r\n"}) {
        HttpClient client{stage.address()};
        auto const reply = client.say(head + "\r\n");
        require(reply.status == 400,
                "this should be answered with 400, and is with " + std::to_string(reply.status) + ": " + head);
    }
}

void schemas_are_served(Stage& stage) {
    HttpClient client{stage.address()};
    auto const list = client.get("/rois/schemas");
    require(list.status == 200, "/rois/schemas answers with " + std::to_string(list.status));
    static std::regex const file_name{"[A-Za-z0-9_.-]+[.]xsd"};
    std::set<std::string> const files{std::sregex_token_iterator{list.body.begin(), list.body.end(), file_name}, {}};
    require(!files.empty(), "/rois/schemas names no schema: " + list.body);
    for (auto const& file : files) {
        auto const reply = client.get("/rois/schemas/" + file);
        std::string const root = reply.root().name();
        require(reply.status == 200 && (root == "schema" || root.ends_with(":schema")), file + " is not served");
    }
}

void health_is_reported(Stage& stage) {
    HttpClient client{stage.address()};
    for (auto const* const path : {"/healthz", "/readyz"}) {
        auto const reply = client.get(path);
        require(reply.status == 200, std::string{path} + " answers with " + std::to_string(reply.status));
    }
}

void documents_are_application_xml(Stage& stage) {
    HttpClient client{stage.address()};
    auto const is_xml = [](std::string const& what, HttpReply const& reply) {
        auto const type = reply.header("Content-Type");
        require(type.substr(0, type.find(';')) == "application/xml", what + " should be application/xml, and is " + type);
    };
    is_xml("the fault no_session", client.call("search"));
    is_xml("the fault not_well_formed", client.post("<connect"));
    is_xml("the fault invalid", client.post("<connect/>"));
    is_xml("the fault not_found", client.get("/nowhere"));
    is_xml("the answer of connect", client.call("connect"));
    is_xml("a refusal", client.call("bind", kit::component_ref(nobody)));
    is_xml("the answer of search", client.call("search"));
    is_xml("a list of notifications", client.notifications(0, 0));
    is_xml("the engine's profile", client.get("/rois/profile"));
    for (auto const& component : stage.catalogue().components)
        is_xml("the profile of " + component.ref, client.get("/rois/profile/" + kit::path_segment(component.ref)));
}

void every_operation_is_answered_with_200(Stage& stage) {
    HttpClient client{stage.address()};
    require(client.call("connect").status == 200, "connect should be answered with 200");
    auto const refusal = client.call("bind", kit::component_ref(nobody));
    require(refusal.status == 200 && refusal.return_code() == "BAD_PARAMETER",
            "a refusal is an answer, too: status 200, but it is " + std::to_string(refusal.status));
    same("the content type", "application/xml", refusal.header("Content-Type").substr(0, 15));
}

}  // namespace

Clause wire_clause() {
    auto const http = Way::http;
    return {
        "The wire: HTTP",
        {{"every_operation_is_answered_with_200", "docs/clients.md", every_operation_is_answered_with_200, http},
         {"documents_are_application_xml", "docs/clients.md", documents_are_application_xml, http},
         {"what_is_not_well_formed_is_refused", "docs/clients.md", what_is_not_well_formed_is_refused, http},
         {"document_types_and_instructions_are_refused", "docs/clients.md", document_types_and_instructions_are_refused, http},
         {"what_is_not_valid_is_refused_with_its_place", "docs/clients.md; schemas", what_is_not_valid_is_refused_with_its_place,
          http},
         {"a_fault_says_where", "docs/clients.md", a_fault_says_where, http},
         {"other_content_types_are_refused", "docs/clients.md", other_content_types_are_refused, http},
         {"other_methods_are_refused", "docs/clients.md", other_methods_are_refused, http},
         {"unknown_paths_are_not_found", "docs/clients.md", unknown_paths_are_not_found, http},
         {"a_plain_get_is_asked_to_upgrade", "docs/clients.md", a_plain_get_is_asked_to_upgrade, http},
         {"a_transfer_encoding_is_refused", "docs/clients.md", a_transfer_encoding_is_refused, http},
         {"broken_http_is_refused", "docs/clients.md", broken_http_is_refused, http},
         {"schemas_are_served", "docs/clients.md", schemas_are_served, http},
         {"health_is_reported", "docs/clients.md", health_is_reported, http}}};
}

}  // namespace rois::conformance
