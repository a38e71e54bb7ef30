// The fixture of dialogues over HTTP and over WebSocket: an empty hall and a connected application.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/application.hpp"

namespace rois::test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// An empty hall, 20 times as fast as real time.
GatewayProcess& empty_hall();

class Conversation : public testing::TestWithParam<Transport> {
protected:
    Conversation() { desk.connect(); }

    Application desk{GetParam(), empty_hall()};
};

// Runs the tests of a suite over HTTP and over WebSocket.
#define ROIS_OVER_BOTH_WAYS(suite) \
    INSTANTIATE_TEST_SUITE_P(Over, suite, testing::ValuesIn(all_transports), testing::PrintToStringParamName())

MATCHER(IsOk, "is OK") {
    *result_listener << arg.whole();
    return arg.return_code() == "OK" && arg.reason().empty();
}

// Matches a refusal whose reason contains these words.
MATCHER_P2(IsRefused, code, words, std::string{code} + " because of " + words) {
    *result_listener << arg.whole();
    return arg.return_code() == code && arg.reason().find(words) != std::string::npos;
}

inline Command speak(std::string const& text, std::string const& id = "") {
    return {.component = "speech_synthesis", .id = id, .arguments = {speech_text(text)}};
}

// A speech that takes longer than any test.
Command speak_long(std::string const& id);

}  // namespace rois::test
