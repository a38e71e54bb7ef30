// The settings of a sub engine: an entry of the engines file (docs/engines.md).
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "types/unique_descriptor.hpp"

namespace rois::remote {

// The position of the sub engine's frame in this engine's frame: mm, and roll, pitch and yaw in degrees.
struct Placement {
    std::array<double, 3> position{};
    std::array<double, 3> orientation{};
    std::vector<double> covariance;  // as Frame::covariance

    bool operator==(Placement const&) const = default;
};

constexpr std::size_t largest_document = 64'000'000;  // bytes: no link takes more

struct SubEngine {
    std::string name;                     // prefix of the names of its components, engines and frames
    std::string url;                      // its gateway; empty: the sub engine joins
    std::string joins;                    // the name by which it joins
    std::vector<std::string> command;     // the program that joins, with its arguments; empty: this gateway starts none
    std::string folder;                   // in which the program runs
    std::vector<std::string> components;  // refs, in the sub engine, of the components to use; empty: all
    // Name, in the sub engine, of the only engine to use. Its components belong to this engine itself. Empty: all engines are
    // used, as sub engines of this engine.
    std::string engine{};
    // Without a placement, positions are passed on unchanged, and the frame keeps its name.
    std::optional<Placement> placement{};

    // How long a lost link may be missing: after that, the sub engine and this engine give up the session.
    std::chrono::milliseconds window = std::chrono::seconds{3};
    // After that, its components leave.
    std::chrono::milliseconds resume_window = std::chrono::seconds{30};
    // How long its robot keeps moving without a sign of life from this engine.
    std::chrono::milliseconds motion_lease = std::chrono::seconds{1};
    std::size_t most_components = 1'000;
    std::size_t longest_document = 4'000'000;  // bytes, at most largest_document

    std::string token{};             // sent to the sub engine; empty: none
    std::string ca_file{};           // certificates that it may have, besides those of the system; empty: none
    std::string certificate_file{};  // the own certificate and its key, shown to it; empty: none

    bool operator==(SubEngine const&) const = default;
};

// Whether others could read messages to this valid URL of a gateway, or answer them: it is on another machine, and has no TLS.
bool is_in_the_clear(std::string const& url);

// Another engine, which this engine joins as a sub engine.
struct Joining {
    std::string url;
    std::string name;                // of this engine in the other one
    std::string token{};             // sent to the other engine; empty: none
    std::string ca_file{};           // certificates that it may have, besides those of the system; empty: none
    std::string certificate_file{};  // the own certificate and its key, shown to it; empty: none
    // Returns a socket that is connected to this engine's own gateway. Called on the thread of the links.
    std::function<UniqueDescriptor()> own_gateway;
};

}  // namespace rois::remote
