// The limits of one request, each exactly reached and exceeded by one, over HTTP and over WebSocket (docs/safety.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "kit/vocabulary.hpp"
#include "server/websocket_client.hpp"

namespace rois::test {
namespace {

using testing::HasSubstr;

constexpr std::size_t most_bytes = 50'000, most_header = 2'048, most_fields = 16, most_target = 1'024, most_name = 64;

GatewayProcess& limited() {
    static GatewayProcess gateway{{"--max-body",      "50000", "--max-header",         "2048", "--max-header-fields", "16",
                                   "--max-target",    "1024",  "--max-depth",          "8",    "--max-attributes",    "8",
                                   "--max-elements",  "16",    "--max-name-length",    "64",   "--max-namespaces",    "12",
                                   "--max-fragments", "4",     "--max-control-frames", "10"}};
    return gateway;
}

std::string padded(std::string const& document, std::size_t size) { return document + std::string(size - document.size(), ' '); }

// The answer to a document, and its reason: "200 OK", "400 forbidden_xml"; over a WebSocket without the status.
struct Outcome {
    std::string answer;
    std::string reason;
};

Outcome over_http(std::string const& document) {
    HttpClient client{limited()};
    client.call("connect");
    auto const reply = client.post(document);
    return {std::to_string(reply.status) + " " + (reply.fault().empty() ? reply.return_code() : reply.fault()), reply.reason()};
}

Outcome over_websocket(std::string const& document) {
    WebSocketClient client{limited()};
    client.call("connect");
    client.send(document);
    auto const answer = client.next_document();
    bool const is_fault = std::string_view{answer.name()} == "fault";
    return {answer.attribute(is_fault ? "code" : "return_code").value(), answer.child("reason").text().get()};
}

// Also in long documents: another thread reads those of more than 32 KiB, with a reader of its own.
void expect_limit(std::string const& within, std::string const& beyond, std::string const& reason) {
    for (std::size_t const size : {std::size_t{0}, std::size_t{40'000}}) {
        auto const at_limit = size == 0 ? within : padded(within, size), too_much = size == 0 ? beyond : padded(beyond, size);
        EXPECT_EQ(over_http(at_limit).answer, "200 OK") << size << ": " << within;
        EXPECT_EQ(over_websocket(at_limit).answer, "OK") << size << ": " << within;
        auto const refused = over_http(too_much);
        EXPECT_EQ(refused.answer, "400 forbidden_xml") << size << ": " << beyond;
        EXPECT_THAT(refused.reason, HasSubstr(reason)) << size;
        auto const fault = over_websocket(too_much);
        EXPECT_EQ(fault.answer, "forbidden_xml") << size << ": " << beyond;
        EXPECT_THAT(fault.reason, HasSubstr(reason)) << size;
    }
}

std::string head_of_size(std::size_t size) {
    std::string const before = "GET /healthz HTTP/1.1\r\nHost: localhost\r\nX: ", after = "\r\n\r\n";
    return before + std::string(size - before.size() - after.size(), 'x') + after;
}

TEST(LimitOfARequest, IsTheSizeOfItsDocument) {
    HttpClient client{limited()};
    client.call("connect");
    EXPECT_EQ(client.post(padded(request("search"), most_bytes)).status, 200);
    auto const refused = client.post(padded(request("search"), most_bytes + 1));
    EXPECT_EQ(refused.status, 413);
    EXPECT_EQ(refused.fault(), "too_large");
    EXPECT_THAT(refused.reason(), HasSubstr("50000"));

    WebSocketClient socket{limited()};
    socket.call("connect");
    socket.send(padded(request("search"), most_bytes));
    EXPECT_STREQ(socket.next_document().attribute("return_code").value(), "OK");
    socket.send(padded(request("search"), most_bytes + 1));
    EXPECT_EQ(socket.await_close(), 1009);
}

TEST(LimitOfARequest, IsTheSizeOfItsHeader) {
    HttpClient client{limited()};
    EXPECT_EQ(client.say(head_of_size(most_header)).status, 200);
    auto const refused = client.say(head_of_size(most_header + 1));
    EXPECT_EQ(refused.status, 431);
    EXPECT_EQ(refused.fault(), "header_too_large");
    EXPECT_THAT(refused.reason(), HasSubstr("2048 bytes (max_header)"));
}

TEST(LimitOfARequest, IsTheNumberOfItsHeaderFields) {
    auto const with_fields = [](std::size_t many) {
        std::string head = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n";
        for (std::size_t i = 1; i < many; ++i) head += "X-" + std::to_string(i) + ": y\r\n";
        return head + "\r\n";
    };
    HttpClient client{limited()};
    EXPECT_EQ(client.say(with_fields(most_fields)).status, 200);
    auto const refused = client.say(with_fields(most_fields + 1));
    EXPECT_EQ(refused.status, 431);
    EXPECT_EQ(refused.reason(), "more than 16 header fields (max_header_fields)");
}

TEST(LimitOfARequest, IsTheLengthOfItsTarget) {
    auto const with_target = [](std::size_t size) {
        return "GET /" + std::string(size - 1, 'x') + " HTTP/1.1\r\nHost: localhost\r\n\r\n";
    };
    HttpClient client{limited()};
    EXPECT_EQ(client.say(with_target(most_target)).status, 404);
    auto const refused = client.say(with_target(most_target + 1));
    EXPECT_EQ(refused.status, 414);
    EXPECT_EQ(refused.fault(), "uri_too_long");
    EXPECT_THAT(refused.reason(), HasSubstr("1024 bytes (max_target)"));
}

// search, condition, Filter and PropertyIsEqualTo with its ValueReference are five levels.
TEST(LimitOfADocument, IsItsDepth) {
    auto const nested = [](int negations) {
        auto filter = equal("component_ref", "navigation");
        for (int i = 0; i < negations; ++i) filter = negation(filter);
        return request("search", where(filter));
    };
    expect_limit(nested(3), nested(4), "elements are nested too deeply: the limit is 8");
}

// A request of the kit declares two namespaces. Declarations count as attributes.
TEST(LimitOfADocument, IsTheNumberOfAttributesOfAnElement) {
    auto const with_attributes = [](int many) {
        Attributes more;
        for (int i = 2; i < many; ++i) more.emplace_back("xmlns:p" + std::to_string(i), "http://www.omg.org/spec/RoIS/20240801");
        return request("search", {}, more);
    };
    expect_limit(with_attributes(8), with_attributes(9), "too many attributes in one element: the limit is 8");
}

// search, condition, Filter and Or are four elements, each comparison has three, and Not is one.
TEST(LimitOfADocument, IsTheNumberOfItsElements) {
    auto const one = equal("component_ref", "navigation");
    auto const sixteen = request("search", where(either(one + one + one, one)));
    auto const seventeen = request("search", where(either(one + one + one, negation(one))));
    expect_limit(sixteen, seventeen, "too many elements: the limit is 16");
}

TEST(LimitOfADocument, IsTheLengthOfItsNames) {
    auto const element_with_name = [](std::size_t size) {
        std::string const name = ":search";
        auto const prefix = std::string(size - name.size(), 'p');
        return "<" + prefix + name + " xmlns:" + prefix + "=\"urn:x-rois:psm:xml:message:1\"/>";
    };
    expect_limit(element_with_name(most_name), element_with_name(most_name + 1),
                 "the name of an element is too long: the limit is 64");
    auto const attribute_with_name = [](std::size_t size) {
        std::string const name = "xmlns:";
        return request("search", {}, {{name + std::string(size - name.size(), 'p'), "http://www.omg.org/spec/RoIS/20240801"}});
    };
    expect_limit(attribute_with_name(most_name), attribute_with_name(most_name + 1),
                 "the name of an attribute is too long: the limit is 64");
}

// A request of the kit declares two, and a condition one.
TEST(LimitOfADocument, IsTheNumberOfNamespacesInScope) {
    auto const with_namespaces = [](int many) {
        constexpr auto name_space = "http://www.omg.org/spec/RoIS/20240801";
        auto condition = where(equal("component_ref", "navigation"));
        Attributes more;
        for (int i = 3; i < many; ++i) {
            auto const declaration = "xmlns:p" + std::to_string(i);
            if (i < 9)
                more.emplace_back(declaration, name_space);
            else
                condition = condition.with(declaration, name_space);
        }
        return request("search", condition, more);
    };
    expect_limit(with_namespaces(12), with_namespaces(13), "too many namespace declarations in scope: the limit is 12");
}

TEST(LimitOfAWebSocket, IsTheNumberOfItsControlFrames) {
    WebSocketClient moderate{limited()}, greedy{limited()};
    moderate.call("connect");
    for (int i = 0; i < 10; ++i) moderate.send("", Kind::pong);
    moderate.send(request("search"));
    EXPECT_STREQ(moderate.next_document().attribute("return_code").value(), "OK");
    greedy.call("connect");
    for (int i = 0; i < 11; ++i) greedy.send("", Kind::pong);
    EXPECT_EQ(greedy.await_close(), 1008);
}

TEST(LimitOfAWebSocketMessage, IsTheNumberOfItsFrames) {
    auto const document = request("search");
    auto const send_in = [&](WebSocketClient& client, int frames) {
        client.send_raw(0x01, document);
        for (int i = 2; i < frames; ++i) client.send_raw(0x00, "");
        client.send_raw(0x80, "");
    };
    WebSocketClient client{limited()};
    client.call("connect");
    send_in(client, 4);
    EXPECT_STREQ(client.next_document().attribute("return_code").value(), "OK");
    send_in(client, 5);
    EXPECT_EQ(client.await_close(), 1008);
}

}  // namespace
}  // namespace rois::test
