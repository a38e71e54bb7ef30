// Recordings: all that a session saw, a JSON object a line (docs/rois-command.md has the format).
#pragma once

#include <chrono>
#include <fstream>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "rois/connection.hpp"

namespace rois::command {

struct RecordedDocument {
    std::chrono::microseconds at{};        // since the recording began
    Direction direction = Direction::out;  // seen from the application
    std::string session;                   // of which one, where applications were recorded; else empty
    std::string text;
};

// Writes as it happens: after each document, the file is whole. From any thread.
class RecordingWriter {
public:
    // Throws Trouble when the file cannot be written.
    RecordingWriter(std::string const& file, std::string_view url);

    void add(Direction, std::string_view document, std::string_view session = {});

    // Throws Trouble when something could not be written.
    void check();

private:
    std::string file_;
    std::chrono::steady_clock::time_point begun_;
    std::mutex mutex_;
    std::ofstream out_;
};

// Throws Trouble, "file:line: reason".
std::vector<RecordedDocument> read_recording(std::string const& file);

}  // namespace rois::command
