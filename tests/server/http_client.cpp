#include "server/http_client.hpp"

namespace rois::test {

void bind_and_complete(HttpClient& client, int count) {
    client.call("connect");
    client.call("bind", component_ref("navigation"));
    complete(client, count);
}

void complete(HttpClient& client, int count) {
    for (int i = 0; i < count; ++i)
        client.call("set_parameter", component_ref("navigation") + parameters("time_limit", 1'000 + i));
}

}  // namespace rois::test
