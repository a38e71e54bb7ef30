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

// Writes as it happens: after each document, the file is whole. From any thread. What the file had stays until it is sure that
// there is something to record.
class RecordingWriter {
public:
    // Throws Trouble when the file cannot be written.
    RecordingWriter(std::string const& file, std::string_view url);
    ~RecordingWriter();  // leaves no empty file that was not there
    RecordingWriter(RecordingWriter const&) = delete;
    RecordingWriter& operator=(RecordingWriter const&) = delete;

    // The recording replaces what the file had, from its beginning. Not while nothing has come from an engine.
    void keep();

    void add(Direction, std::string_view document, std::string_view session = {});

    // Throws Trouble when something could not be written.
    void check();

private:
    std::string file_;
    std::chrono::steady_clock::time_point begun_;
    std::mutex mutex_;
    bool const was_there_;
    std::ofstream out_;
    std::string held_;  // until it is kept
    bool answered_ = false;
    bool kept_ = false;
};

// Throws Trouble, "file:line: reason".
std::vector<RecordedDocument> read_recording(std::string const& file);

}  // namespace rois::command
