// A recording as what it says of an engine: what is answered to what, and what comes of it.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "command/recording.hpp"
#include "types/messages.hpp"
#include "xml/codec.hpp"

namespace rois::command {

// A request, without what is different each time: ids of commands and of the request.
std::string exact_key(Operation);
// Also without conditions and arguments; empty for operations where these are what matters.
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
    std::vector<Later> later;  // in the order in which they came
};

// What one session saw. Events are those of the last command before them, or of their subscription; a completed is that of its
// command.
struct Script {
    std::vector<Exchange> exchanges;
    std::map<std::string, std::vector<std::size_t>> exactly;  // exchanges by key, in their order
    std::map<std::string, std::vector<std::size_t>> roughly;
};

// One for each session of the recording, in their order. What is no document of RoIS is passed over. Throws Trouble when nothing
// is left.
std::vector<std::shared_ptr<Script const>> scripts_of(std::vector<RecordedDocument> const&, xml::RequestReader&);

}  // namespace rois::command
