// What the load generator is told on its command line.
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
    double rate = 0;                  // requests or bursts a second; 0: the next when the last has been answered
    std::vector<std::string> setup;   // documents that each connection sends first
    std::size_t repeat = 1;           // how often it sends them
    std::vector<std::string> bodies;  // documents that it sends then, one after the other
    std::size_t variants = 1;         // of each of them, with another {number} each
    bool other_heads = false;         // over HTTP no request has the head of the one before
    std::string await;                // a request is over when a notification holds this text
    std::string expect;               // each answer must hold this text
    std::vector<std::string> fire_setup;
    std::string fire;       // fanout: the document that makes events
    std::size_t burst = 1;  // fanout: how many
    bool announce = false;  // says on a line of its own when it begins
    bool spin = false;      // never sleeps while it measures
    int pid = 0;            // of the server, whose CPU time is read
};

// Throws std::runtime_error for what it does not know. Documents are read from files; {connection} in them is the connection's
// number and {number} counts what was sent.
Options read_options(int argc, char const* const* argv);

std::string filled_in(std::string text, std::size_t connection, std::size_t number);

}  // namespace rois::bench
