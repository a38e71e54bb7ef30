// Media that pass beside RoIS messages (RoIS 2.0, audio and video streaming): somewhere to serve sound and pictures from. Knows
// no RoIS and no robot.
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

// A sine at half of full scale, 16 bit.
struct Tone {
    double frequency = 440;  // Hz
    std::uint32_t rate = 16'000;
    std::uint16_t channels = 1;
    // The frequency of a tone that changes; empty: `frequency`. Called on a thread of its own, once for each piece of sound.
    std::function<double()> current_frequency{};
};

struct Sound {
    enum class Form : std::uint8_t { wav, l16 };

    Tone tone;
    Form form = Form::wav;
};

// Red, green, blue, a byte each; row by row from the top left.
struct Picture {
    std::uint16_t width = 0;
    std::uint16_t height = 0;
    std::vector<std::uint8_t> rgb;
};

struct Film {
    enum class Form : std::uint8_t {
        motion_jpeg,  // one JPEG after another in one answer, multipart/x-mixed-replace
        jpeg          // a JPEG for each request
    };

    // What is to be seen now; nothing as long as nobody has said. Called on a thread of its own, one call at a time.
    std::function<std::optional<Picture>()> draw;
    std::uint32_t frames_per_second = 10;
    Form form = Form::motion_jpeg;
};

using Content = std::variant<Sound, Film>;

// What became of receiving: the first receiver has come, or the last one has gone.
enum class Reception : std::uint8_t { begun, ended };

// Whether anything flows at first.
enum class Flow : std::uint8_t { on, held };

// Something that is served; it ends with its outlet. Used by one thread.
class Outlet {
public:
    virtual ~Outlet() = default;

    // Where receivers find it, or where it is sent: "http://127.0.0.1:8081/media/...",
    // "rtp://127.0.0.1:5004;payload_type=96;ssrc=7".
    virtual std::string const& address() const = 0;

    // Nothing flows until it goes on; receivers stay.
    virtual void hold() = 0;
    virtual void go_on() = 0;

    // What happened since this was last asked; begun and ended take turns.
    virtual std::vector<Reception> receptions() = 0;
};

// Used by one thread.
class Media {
public:
    virtual ~Media() = default;

    // At an address of its own that nobody can guess.
    virtual std::unique_ptr<Outlet> serve(Content, Flow) = 0;

    // Why nothing is sent to this target, or nothing. A target is "rtp://HOST:PORT" with a numeric address or localhost.
    virtual std::optional<std::string> rtp_refusal(std::string_view target) const = 0;

    // By RTP (RFC 3550, 3551) as L16, a packet each 20 ms. Throws std::runtime_error when it cannot be sent there.
    virtual std::unique_ptr<Outlet> send(Tone const&, std::string_view rtp_target, Flow) = 0;
};

}  // namespace rois::media
