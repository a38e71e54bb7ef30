// Video streaming (RoIS 2.0): the pictures of the robot's camera.
#include "basic/components/basic_components.hpp"
#include "basic/streaming/streaming.hpp"

namespace rois::basic {
namespace {

constexpr auto between_views = std::chrono::milliseconds{40};

class VideoStreaming final : public Streaming {
public:
    explicit VideoStreaming(Context context) : Streaming{std::move(context)}, camera_{body().camera()} {}

private:
    std::vector<std::string_view> encodings() const override { return {"multipart/x-mixed-replace", "image/jpeg"}; }
    std::vector<std::string_view> transports() const override { return {"http"}; }

    std::variant<Opening, std::string> opening(MediaOffer const& encoding, MediaOffer const&) const override {
        MediaFields fields{encoding};
        bool const single = encoding.name == "image/jpeg";
        auto const longest = static_cast<std::uint16_t>(fields.number("size", 64, 1'280, 640));
        auto const rate = static_cast<std::uint32_t>(single ? 10 : fields.number("framerate", 1, 25, 10));
        if (auto problem = fields.problem()) return *problem;
        media::Film film{.draw = [camera = camera_, longest] { return camera->picture(longest); },
                         .frames_per_second = rate,
                         .form = single ? media::Film::Form::jpeg : media::Film::Form::motion_jpeg};
        auto written = encoding.name + ";size=" + std::to_string(longest);
        if (!single) written += ";framerate=" + std::to_string(rate);
        return Opening{std::move(written),
                       [&media = media(), film = std::move(film)](media::Flow flow) { return media.serve(film, flow); }};
    }

    void look(Instant when) override {
        if (seen_ && when.steady - *seen_ < between_views) return;
        seen_ = when.steady;
        camera_->capture();
    }

    std::shared_ptr<Camera> camera_;
    std::optional<Steady> seen_;
};

}  // namespace

std::unique_ptr<LocalComponent> video_streaming(Context context) { return std::make_unique<VideoStreaming>(std::move(context)); }

}  // namespace rois::basic
