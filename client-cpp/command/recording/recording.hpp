// Recordings: all documents of a session, one JSON object per line (format: docs/rois-command.md).
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
    std::string session;                   // of a recorded application; else empty
    std::string text;
};

// Writes each document at once, so that the file is always complete. Thread-safe. Keeps the old content of the file until the
// first call of `keep` after an answer of the engine.
class RecordingWriter {
public:
    // Throws Trouble if the file cannot be written.
    RecordingWriter(std::string const& file, std::string_view url);
    ~RecordingWriter();  // removes a new file if nothing was recorded
    RecordingWriter(RecordingWriter const&) = delete;
    RecordingWriter& operator=(RecordingWriter const&) = delete;

    // Replaces the old content of the file by the recording. Does nothing before the engine has sent a document.
    void keep();

    void add(Direction, std::string_view document, std::string_view session = {});

    // Throws Trouble if writing has failed.
    void check();

private:
    std::string file_;
    std::chrono::steady_clock::time_point begun_;
    std::mutex mutex_;
    bool const was_there_;
    std::ofstream out_;
    std::string held_;  // documents before `keep`
    bool answered_ = false;
    bool kept_ = false;
};

// Throws Trouble, "file:line: reason".
std::vector<RecordedDocument> read_recording(std::string const& file);

}  // namespace rois::command
