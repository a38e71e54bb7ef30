// The requests of a recording with their answers and the notifications that followed.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "command/recording/recording.hpp"
#include "types/messages.hpp"
#include "xml/codec/codec.hpp"

namespace rois::command {

// Returns a key of a request without its request_id and command ids, which differ each time.
std::string exact_key(Operation);
// Returns a key also without conditions and arguments; empty for bind_any and search, where the condition matters.
std::string rough_key(Operation);

struct Later {
    std::chrono::microseconds at{};     // in the recording
    std::chrono::microseconds delay{};  // after the answer
    Notification notification;
};

struct Exchange {
    std::chrono::microseconds asked_at{};  // in the recording
    Operation request;
    std::variant<Reply, Fault> answer;
    std::vector<Later> later;  // in the order of the recording
};

// One recorded session. A notification follows one exchange: `completed` that of its command; any other notification the last
// command before it or, if there is none, its subscription or `connect`.
struct Script {
    std::vector<Exchange> exchanges;
    std::map<std::string, std::vector<std::size_t>> exactly;  // exchanges by key, in their order
    std::map<std::string, std::vector<std::size_t>> roughly;
};

// Returns a script for each session of the recording, in order. Ignores documents that are not of RoIS. Throws Trouble if no
// exchange is left.
std::vector<std::shared_ptr<Script const>> scripts_of(std::vector<RecordedDocument> const&, xml::RequestReader&);

}  // namespace rois::command
