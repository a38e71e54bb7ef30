#include "command/recording/recording.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "command/exit.hpp"
#include "command/input/input.hpp"
#include "command/output/json.hpp"

namespace rois::command {

namespace {

constexpr auto format = "rois-recording-1";

[[noreturn]] void complain(std::string const& file, std::size_t line, std::string const& reason) {
    throw Trouble{Exit::usage, file + ":" + std::to_string(line) + ": " + reason};
}

bool is_there(std::string const& file) {
    std::error_code unknown;
    return std::filesystem::exists(file, unknown);
}

RecordedDocument document_of(Json const& json) {
    RecordedDocument document;
    document.at = std::chrono::microseconds{static_cast<std::int64_t>(json.at("at").get<double>() * 1e6)};
    auto const direction = json.at("direction").get<std::string>();
    if (direction != "out" && direction != "in") throw std::out_of_range{R"(direction must be "out" or "in")"};
    document.direction = direction == "out" ? Direction::out : Direction::in;
    if (json.contains("session")) document.session = json.at("session").get<std::string>();
    document.text = json.at("document").get<std::string>();
    return document;
}

}  // namespace

RecordingWriter::RecordingWriter(std::string const& file, std::string_view url)
    : file_{file},
      begun_{std::chrono::steady_clock::now()},
      was_there_{is_there(file)},
      out_{file, std::ios::binary | std::ios::app} {
    Json const head{{"recording", format}, {"url", url}, {"begun", to_text(std::chrono::system_clock::now())}};
    held_ = line_of(head);
    check();
}

RecordingWriter::~RecordingWriter() {
    std::error_code ignored;
    if (!kept_ && !was_there_) std::filesystem::remove(file_, ignored);
}

void RecordingWriter::keep() {
    std::lock_guard const lock{mutex_};
    if (kept_ || !answered_) return;
    kept_ = true;
    std::error_code failure;
    if (std::filesystem::is_regular_file(file_, failure)) std::filesystem::resize_file(file_, 0, failure);
    if (failure) out_.setstate(std::ios::failbit);
    out_ << std::exchange(held_, {}) << std::flush;
}

void RecordingWriter::add(Direction direction, std::string_view document, std::string_view session) {
    std::lock_guard const lock{mutex_};
    auto const at = std::chrono::duration<double>{std::chrono::steady_clock::now() - begun_}.count();
    Json json{{"at", std::round(at * 1e6) / 1e6}, {"direction", direction == Direction::out ? "out" : "in"}};
    if (!session.empty()) json["session"] = session;
    json["document"] = document;
    answered_ = answered_ || direction == Direction::in;
    if (kept_) {
        out_ << line_of(json) << std::flush;
    } else {
        held_ += line_of(json);
    }
}

void RecordingWriter::check() {
    std::lock_guard const lock{mutex_};
    if (!out_) throw Trouble{Exit::usage, file_ + " cannot be written"};
}

std::vector<RecordedDocument> read_recording(std::string const& file) {
    auto in = open_file(file);
    std::vector<RecordedDocument> documents;
    std::string line;
    for (std::size_t number = 1; std::getline(in, line); ++number) {
        try {
            auto const json = Json::parse(line);
            if (number > 1) {
                documents.push_back(document_of(json));
            } else if (json.at("recording").get<std::string>() != format) {
                complain(file, number, std::string{"this is not a recording of the format "} + format);
            }
        } catch (Json::parse_error const&) {
            if (number > 1 && in.eof()) {  // the recording program was killed
                std::fprintf(stderr, "rois: %s:%zu: the last line is cut off and ignored\n", file.c_str(), number);
                break;
            }
            complain(file, number, number == 1 ? "this is not a recording: not JSON" : "this line is not JSON");
        } catch (std::exception const& error) {
            if (dynamic_cast<Trouble const*>(&error) != nullptr) throw;
            complain(file, number, number == 1 ? std::string{"this is not a recording: "} + error.what() : error.what());
        }
    }
    if (documents.empty()) complain(file, 1, "the recording is empty");
    return documents;
}

}  // namespace rois::command
