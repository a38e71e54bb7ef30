// Media without real receivers: tests report reception.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "media/media.hpp"

namespace rois::basic::stage {

class FakeMedia final : public media::Media {
public:
    // The current state of an outlet.
    struct Offered {
        std::string address;
        media::Content content;
        bool held = false;
        bool open = true;
        std::vector<media::Reception> news{};
    };

    std::unique_ptr<media::Outlet> serve(media::Content content, media::Flow flow) override {
        return offer("http://media.test/" + std::to_string(all.size() + 1), std::move(content), flow);
    }

    std::optional<std::string> rtp_refusal(std::string_view target) const override {
        if (target.starts_with("rtp://127.0.0.1:")) return {};
        return "this target is not allowed";
    }

    std::unique_ptr<media::Outlet> send(media::Tone const& tone, std::string_view target, media::Flow flow) override {
        return offer(std::string{target} + ";ssrc=7", media::Sound{tone, media::Sound::Form::l16}, flow);
    }

    std::vector<std::shared_ptr<Offered>> all;

private:
    class FakeOutlet final : public media::Outlet {
    public:
        explicit FakeOutlet(std::shared_ptr<Offered> offered) : offered_{std::move(offered)} {}
        ~FakeOutlet() override { offered_->open = false; }
        FakeOutlet(FakeOutlet const&) = delete;
        FakeOutlet& operator=(FakeOutlet const&) = delete;

        std::string const& address() const override { return offered_->address; }
        void hold() override { offered_->held = true; }
        void go_on() override { offered_->held = false; }
        std::vector<media::Reception> receptions() override { return std::exchange(offered_->news, {}); }

    private:
        std::shared_ptr<Offered> offered_;
    };

    std::unique_ptr<media::Outlet> offer(std::string address, media::Content content, media::Flow flow) {
        auto const offered = std::make_shared<Offered>(
            Offered{.address = std::move(address), .content = std::move(content), .held = flow == media::Flow::held});
        all.push_back(offered);
        return std::make_unique<FakeOutlet>(offered);
    }
};

}  // namespace rois::basic::stage
