// Requests on which parsers of HTTP disagree: where one ends, and what the next one is. A proxy in front of the gateway may have
// another opinion, so the gateway refuses all that is doubtful, and closes the connection: what follows is never performed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <regex>
#include <string>
#include <vector>

#include "server/http_client.hpp"

namespace rois::test {
namespace {

using namespace std::string_literals;

struct Disputed {
    char const* name;
    std::string bytes;
    std::vector<int> answers;  // the status of each; then the gateway closes the connection
};

void PrintTo(Disputed const& disputed, std::ostream* out) { *out << disputed.name; }

// What a second parser may take for the next request.
std::string const hidden = "GET /rois/profile HTTP/1.1\r\nHost: localhost\r\n\r\n";

std::string post(std::string const& lines, std::string const& body = hidden) {
    return "POST /rois HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/xml\r\n" + lines + "\r\n" + body;
}

std::string get(std::string const& lines) { return "GET /healthz HTTP/1.1\r\nHost: localhost\r\n" + lines + "\r\n" + hidden; }

std::string with_length(std::string const& length) { return post("Content-Length: " + length + "\r\n"); }

std::vector<Disputed> disputed_requests() {
    std::string const chunked = "0\r\n\r\n" + hidden;
    auto const size = std::to_string(hidden.size());
    return {
        // The length of the body
        {"TwoLengths", post("Content-Length: 0\r\nContent-Length: " + size + "\r\n"), {400}},
        {"TheSameLengthTwice", post("Content-Length: 0\r\nContent-Length: 0\r\n"), {400}},
        {"AListOfLengths", with_length("0, " + size), {400}},
        {"ALengthWithASign", with_length("+0"), {400}},
        {"ANegativeLength", with_length("-1"), {400}},
        {"AHexadecimalLength", with_length("0x0"), {400}},
        {"ALengthWithAFraction", with_length("0.0"), {400}},
        {"AnEmptyLength", with_length(""), {400}},
        {"ALengthOfTwoWords", with_length("0 " + size), {400}},
        {"ALengthBeyondAllNumbers", with_length("18446744073709551616"), {400}},
        {"ALengthWithAnUnderscore", post("Content_Length: " + size + "\r\n", get("Connection: close\r\n")), {400, 200}},
        {"NoLength", post("", get("Connection: close\r\n")), {400, 200}},
        // Transfer-Encoding
        {"Chunks", post("Transfer-Encoding: chunked\r\n", chunked), {411}},
        {"ChunksAndALength", post("Content-Length: " + size + "\r\nTransfer-Encoding: chunked\r\n", chunked), {411}},
        {"ALengthAndChunks", post("Transfer-Encoding: chunked\r\nContent-Length: " + size + "\r\n", chunked), {400}},
        {"ChunksInCapitals", post("TRANSFER-ENCODING: CHUNKED\r\n", chunked), {411}},
        {"AnUnknownEncoding", post("Transfer-Encoding: xchunked\r\n", chunked), {411}},
        {"TwoEncodings", post("Transfer-Encoding: identity\r\nTransfer-Encoding: chunked\r\n", chunked), {411}},
        {"AListOfEncodings", post("Transfer-Encoding: gzip, chunked\r\n", chunked), {411}},
        {"ChunksInQuotes", post("Transfer-Encoding: \"chunked\"\r\n", chunked), {411}},
        {"ChunksOfAGet", get("Transfer-Encoding: chunked\r\n"), {411}},
        {"AnEncodingWithASpaceBeforeItsColon", post("Transfer-Encoding : chunked\r\nContent-Length: 0\r\n", chunked), {400}},
        {"AnEncodingAfterATab", post("Transfer-Encoding:\tchunked\r\n", chunked), {411}},
        {"AFoldedEncoding", post("X: y\r\n Transfer-Encoding: chunked\r\nContent-Length: 0\r\n", chunked), {400}},
        {"AnEncodingBehindAVerticalTab", post("\vTransfer-Encoding: chunked\r\nContent-Length: 0\r\n", chunked), {400}},
        {"AnEncodingBehindANul", post("Transfer-Encoding: \0chunked\r\n"s, chunked), {400}},
        // Lines and fields
        {"LinesWithoutCr", "GET /healthz HTTP/1.1\nHost: localhost\n\n" + hidden, {400}},
        {"OneLineWithoutCr", "GET /healthz HTTP/1.1\r\nHost: localhost\nX: y\r\n\r\n" + hidden, {400}},
        {"ACrWithoutLf", get("X: a\rContent-Length: 5\r\n"), {400}},
        {"ANulInAValue", get("X: a\0b\r\n"s), {400}},
        {"AFieldWithoutAColon", get("X\r\n"), {400}},
        {"AFieldWithoutAName", get(": y\r\n"), {400}},
        {"ANameWithASpace", get("X Y: z\r\n"), {400}},
        {"AFirstFieldWithASpace", "GET /healthz HTTP/1.1\r\n Host: localhost\r\n\r\n" + hidden, {400}},
        {"AFoldedValue", get("X: a\r\n b\r\n"), {400}},
        // Host
        {"NoHost", "GET /healthz HTTP/1.1\r\n\r\n" + hidden, {400}},
        {"TwoHosts", get("Host: localhost\r\n"), {400}},
        {"AHostWithASpace", "GET /healthz HTTP/1.1\r\nHost: local host\r\n\r\n" + hidden, {400}},
        {"AHostWithAUser", "GET /healthz HTTP/1.1\r\nHost: user@localhost\r\n\r\n" + hidden, {400}},
        // The request line
        {"NoVersion", "GET /healthz\r\n\r\n" + hidden, {400}},
        {"AnotherVersion", "GET /healthz HTTP/1.2\r\nHost: localhost\r\n\r\n" + hidden, {400}},
        {"VersionTwo", "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", {400}},
        {"AVersionInSmallLetters", "GET /healthz http/1.1\r\nHost: localhost\r\n\r\n" + hidden, {400}},
        {"TwoSpaces", "GET  /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n" + hidden, {400}},
        {"ATab", "GET\t/healthz HTTP/1.1\r\nHost: localhost\r\n\r\n" + hidden, {400}},
        {"ASpaceInTheTarget", "GET /health z HTTP/1.1\r\nHost: localhost\r\n\r\n" + hidden, {400}},
        {"AMethodInSmallLetters", "get /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n" + hidden, {405}},
        // Where all agree, the next request is one of its own.
        {"ABodyThatLooksLikeARequest", post("Content-Length: " + size + "\r\n") + get("Connection: close\r\n"), {400, 200}},
        {"AGetWithABody", get("Content-Length: " + size + "\r\n") + get("Connection: close\r\n"), {200, 200}},
        {"AnEmptyBody", post("Content-Length: 0\r\nConnection: close\r\n"), {400}},
    };
}

class Disagreement : public testing::TestWithParam<Disputed> {};

}  // namespace

TEST_P(Disagreement, HasOneVerdict) {
    HttpClient client;
    client.line().send(GetParam().bytes);
    auto const received = client.line().rest();
    std::vector<int> answers;
    static std::regex const status{"HTTP/1\\.1 ([0-9]{3}) "};
    for (std::sregex_iterator each{received.begin(), received.end(), status}, end; each != end; ++each)
        answers.push_back(std::stoi((*each)[1]));
    EXPECT_EQ(answers, GetParam().answers) << received;
}

INSTANTIATE_TEST_SUITE_P(Of, Disagreement, testing::ValuesIn(disputed_requests()),
                         [](auto const& each) { return std::string{each.param.name}; });

}  // namespace rois::test
