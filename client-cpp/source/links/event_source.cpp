#include "links/event_source.hpp"

namespace rois::client {

bool EventSource::take(std::string_view bytes, std::size_t longest, std::function<void(std::string_view data)> const& handler) {
    rest_ += bytes;
    std::size_t begin = 0;
    for (auto end = rest_.find('\n'); end != rest_.npos; end = rest_.find('\n', begin)) {
        auto line = std::string_view{rest_}.substr(begin, end - begin);
        if (line.ends_with('\r')) line.remove_suffix(1);
        begin = end + 1;
        take_line(line, handler);
    }
    rest_.erase(0, begin);
    return rest_.size() + data_.size() <= longest;
}

// Ignores all fields except `data`: the document contains the sequence, too.
void EventSource::take_line(std::string_view line, std::function<void(std::string_view data)> const& handler) {
    if (line.empty()) {
        if (has_data_) handler(data_);
        data_.clear();
        has_data_ = false;
        return;
    }
    constexpr std::string_view field = "data:";
    if (!line.starts_with(field)) return;
    line.remove_prefix(field.size());
    if (line.starts_with(' ')) line.remove_prefix(1);
    if (has_data_) data_ += '\n';
    data_ += line;
    has_data_ = true;
}

}  // namespace rois::client
