// Audio streaming (RoIS 2.0): a tone instead of the robot's microphone. It has 440 Hz while the robot is silent, and the pitch of
// the robot's voice while it speaks.
#include <atomic>
#include <memory>

#include "basic/components/basic_components.hpp"
#include "basic/speech/voice_characters.hpp"
#include "basic/streaming/streaming.hpp"

namespace rois::basic {
namespace {

class AudioStreaming final : public Streaming {
public:
    using Streaming::Streaming;

private:
    std::vector<std::string_view> encodings() const override { return {"audio/wav", "audio/L16"}; }
    std::vector<std::string_view> transports() const override { return {"http", "rtp"}; }

    std::optional<std::string> unreachable(MediaOffer const& transport) const override {
        return transport.name == "http" ? std::nullopt : media().rtp_refusal(transport.name);
    }

    std::variant<Opening, std::string> opening(MediaOffer const& encoding, MediaOffer const& transport) const override {
        MediaFields fields{encoding};
        media::Tone tone{.current_frequency = [pitch = pitch_] { return pitch->load(); }};
        tone.rate = static_cast<std::uint32_t>(fields.one_of("rate", {16'000, 8'000, 44'100, 48'000}));
        tone.channels = static_cast<std::uint16_t>(fields.one_of("channels", {1, 2}));
        if (auto problem = fields.problem()) return *problem;
        bool const wav = encoding.name == "audio/wav";
        auto const written = (wav ? "audio/wav" : "audio/L16") + (";rate=" + std::to_string(tone.rate)) +
                             ";channels=" + std::to_string(tone.channels);
        auto& media = this->media();
        if (transport.name == "http") {
            media::Sound const sound{tone, wav ? media::Sound::Form::wav : media::Sound::Form::l16};
            return Opening{written, [&media, sound](media::Flow flow) { return media.serve(sound, flow); }};
        }
        if (wav) return "audio/wav cannot be sent by RTP: use audio/L16";
        return Opening{written,
                       [&media, tone, target = transport.name](media::Flow flow) { return media.send(tone, target, flow); }};
    }

    void look(Instant) override {
        auto const character = body().speech().speaking();
        *pitch_ = character ? voice_character(*character).pitch : media::Tone{}.frequency;
    }

    // Written by the engine's thread, read by the media thread.
    std::shared_ptr<std::atomic<double>> pitch_ = std::make_shared<std::atomic<double>>(media::Tone{}.frequency);
};

}  // namespace

std::unique_ptr<LocalComponent> audio_streaming(Context context) { return std::make_unique<AudioStreaming>(std::move(context)); }

}  // namespace rois::basic
