// Serves sound and pictures over HTTP and RTP, for audio and video streaming (RoIS 2.0). Knows neither RoIS messages nor robots.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace rois::media {

// A sine tone at half of full scale, 16 bit.
struct Tone {
    double frequency = 440;  // Hz
    std::uint32_t rate = 16'000;
    std::uint16_t channels = 1;
    // Returns the current frequency in Hz; if empty, `frequency` applies. Called on the media thread, once for each piece of
    // sound.
    std::function<double()> current_frequency{};
};

struct Sound {
    enum class Form : std::uint8_t { wav, l16 };

    Tone tone;
    Form form = Form::wav;
};

// One byte each for red, green and blue; row by row from the top left.
struct Picture {
    std::uint16_t width = 0;
    std::uint16_t height = 0;
    std::vector<std::uint8_t> rgb;
};

struct Film {
    enum class Form : std::uint8_t {
        motion_jpeg,  // a sequence of JPEGs in one response, multipart/x-mixed-replace
        jpeg          // one JPEG for each request
    };

    // Returns the current picture; nothing if there is none yet. Called on the media thread.
    std::function<std::optional<Picture>()> draw;
    std::uint32_t frames_per_second = 10;
    Form form = Form::motion_jpeg;
};

using Content = std::variant<Sound, Film>;

// A change of reception: the first receiver has connected, or the last one has disconnected.
enum class Reception : std::uint8_t { begun, ended };

// Whether data flows from the start.
enum class Flow : std::uint8_t { on, held };

// Owns one served medium: destroying the outlet ends it. Used by one thread only.
class Outlet {
public:
    virtual ~Outlet() = default;

    // The address that receivers connect to, or that data is sent to: "http://127.0.0.1:8081/media/...",
    // "rtp://127.0.0.1:5004;payload_type=96;ssrc=7".
    virtual std::string const& address() const = 0;

    // Stop and restart the flow. Receivers stay connected.
    virtual void hold() = 0;
    virtual void go_on() = 0;

    // Returns the changes since the last call; begun and ended alternate.
    virtual std::vector<Reception> receptions() = 0;
};

// Used by one thread.
class Media {
public:
    virtual ~Media() = default;

    // Serves the content over HTTP at a unique address that cannot be guessed.
    virtual std::unique_ptr<Outlet> serve(Content, Flow) = 0;

    // Returns why this RTP target is rejected, or nothing. A target is "rtp://HOST:PORT" with a numeric address or localhost.
    virtual std::optional<std::string> rtp_refusal(std::string_view target) const = 0;

    // Sends the tone by RTP (RFC 3550, 3551) as L16. Throws std::runtime_error if the target is rejected.
    virtual std::unique_ptr<Outlet> send(Tone const&, std::string_view rtp_target, Flow) = 0;
};

}  // namespace rois::media
