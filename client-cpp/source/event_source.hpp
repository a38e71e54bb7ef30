// What an event stream says (server-sent events, HTML 9.2.6), as it comes.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace rois::client {

class EventSource {
public:
    // Tells the data of each event that is whole with these bytes. `told` may not call `take`. False when an event is longer than
    // `longest`.
    bool take(std::string_view bytes, std::size_t longest, std::function<void(std::string_view data)> const& told);

private:
    void take_line(std::string_view line, std::function<void(std::string_view data)> const& told);

    std::string rest_;  // of a line that has no end yet
    std::string data_;
    bool has_data_ = false;
};

}  // namespace rois::client
