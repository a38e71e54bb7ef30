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

void stuff(Line& line, std::string const& request) {
    std::string bytes;
    while (bytes.size() < 1 << 20) bytes += request;
    std::size_t sent = 0;
    for (int refused = 0; refused < 20;) {
        auto const now = line.send_now(std::string_view{bytes}.substr(sent));
        sent = (sent + now) % bytes.size();
        refused = now == 0 ? refused + 1 : 0;
    }
}

}  // namespace rois::test
