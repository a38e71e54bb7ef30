// Parser of an event stream (server-sent events, HTML 9.2.6).
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace rois::client {

class EventSource {
public:
    // Calls `handler` with the data of each event that these bytes complete; it must not call `take`. Returns false if an event
    // is longer than `longest` bytes.
    bool take(std::string_view bytes, std::size_t longest, std::function<void(std::string_view data)> const& handler);

private:
    void take_line(std::string_view line, std::function<void(std::string_view data)> const& handler);

    std::string rest_;  // the beginning of an incomplete line
    std::string data_;
    bool has_data_ = false;
};

}  // namespace rois::client
