// The command line of the load generator.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "load/socket.hpp"

namespace rois::bench {

struct Options {
    enum class Mode : std::uint8_t { requests, hold, fanout } mode = Mode::requests;
    std::uint16_t port = 0;
    std::string path = "/rois";
    Via via = Via::http;
    bool stream = false;   // hold: event streams
    bool connect = false;  // each connection begins with the RoIS operation `connect`
    std::size_t connections = 1;
    double warm_up = 0.2;             // seconds, not measured
    double seconds = 1;               // measured
    double rate = 0;                  // requests or bursts a second; 0: each request follows the answer to the one before
    std::vector<std::string> setup;   // documents that each connection sends first
    std::size_t repeat = 1;           // how often it sends them
    std::vector<std::string> bodies;  // requests: requests: the documents to send after the setup, in turn
    std::size_t variants = 1;         // variants of each document, which differ in {number}
    bool other_heads = false;         // over HTTP, consecutive requests have different heads
    std::string await;                // a request is over when a notification contains this text
    std::string expect;               // each answer must contain this text
    std::vector<std::string> fire_setup;
    std::string fire;       // fanout: the document that fires events
    std::size_t burst = 1;  // fanout: events that one document fires
    bool announce = false;  // prints a line when it begins
    bool spin = false;      // never sleeps while it measures
    int pid = 0;            // the process id of the server whose CPU time is measured
};

// Throws std::runtime_error for an unknown mode or option. Documents are read from files. In them, {connection} is the number of
// the connection, and {number} counts the documents.
Options read_options(int argc, char const* const* argv);

std::string filled_in(std::string text, std::size_t connection, std::size_t number);

}  // namespace rois::bench
