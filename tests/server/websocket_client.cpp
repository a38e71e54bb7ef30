#include "server/websocket_client.hpp"

#include <gtest/gtest.h>

namespace rois::test {

void bind_and_complete(WebSocketClient& client, int count) {
    client.call("connect");
    client.call("bind", component_ref("navigation"));
    for (int i = 0; i < count; ++i) {
        client.call("set_parameter", component_ref("navigation") + parameters("time_limit", 1'000 + i));
        EXPECT_STREQ(client.next_document().name(), "completed");
    }
}

}  // namespace rois::test
