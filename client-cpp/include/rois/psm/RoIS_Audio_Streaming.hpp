// Audio Streaming in the C++ PSM (version 2.0; docs/streaming.md).
//
// The published header does not compile: get_parameter ends with a comma, and Stream_Status is not declared. This header has
// neither error; Stream_Status is that of RoIS_Common.
#pragma once

#include <string>

#include "RoIS_Common.hpp"

namespace Audio_Streaming {

class Command : public RoIS_Common::Command {
public:
    Command() : RoIS_Common::Command("AudioStreaming") {}

    // Encodings and transports for the next stream: the component uses the first pair that it supports. Empty arguments leave
    // their parameters unchanged.
    RoIS_HRI::ReturnCode_t set_parameter(std::string encoding_parameters, std::string transport_parameters);

    // These wait until the command has completed, for at most 10 s. If it fails, they return its Completed_Status: ERROR,
    // OUT_OF_RESOURCES or TIMEOUT.
    RoIS_HRI::ReturnCode_t connect_stream(std::string& stream_id);
    RoIS_HRI::ReturnCode_t disconnect_stream(std::string stream_id);
    RoIS_HRI::ReturnCode_t suspend_stream(std::string stream_id);
    RoIS_HRI::ReturnCode_t resume_stream(std::string stream_id);
};

class Query : public RoIS_Common::Query {
public:
    Query() : RoIS_Common::Query("AudioStreaming") {}

    RoIS_HRI::ReturnCode_t get_parameter(std::string& available_encodings, std::string& available_transports);

    // An empty stream_id means the latest stream. UNSUPPORTED if there was no such stream.
    RoIS_HRI::ReturnCode_t get_stream_status(std::string stream_id, RoIS_Common::Stream_Status& status);
};

class Event : public RoIS_Common::Event {
public:
    Event() : RoIS_Common::Event("AudioStreaming", {"notify_stream_status"}) {}

    virtual void notify_stream_status(std::string stream_id, RoIS_HRI::DateTime timestamp, RoIS_Common::Stream_Status status);

    void deliver(std::string const& event_type, rois::psm::EventResults const& results) override;
};

}  // namespace Audio_Streaming
