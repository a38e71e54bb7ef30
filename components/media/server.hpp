// Serves media: over HTTP on a port of its own, by RTP to whoever is named.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "media/media.hpp"
#include "media/settings.hpp"

namespace rois::media {

class Server final : public Media {
public:
    // Serves from now on, on a thread of its own. `fresh_id`: a text of letters, digits, '-' and '_' that nobody can guess and
    // that was never given before; called within `serve`. Throws std::runtime_error with one clear line when it cannot listen.
    Server(Settings, std::function<std::string()> fresh_id);
    ~Server() override;  // outlets may live on; nobody receives from them any more
    Server(Server const&) = delete;
    Server& operator=(Server const&) = delete;

    // How the addresses of what HTTP serves begin: "http://127.0.0.1:8081".
    std::string const& url() const;

    std::unique_ptr<Outlet> serve(Content, Flow) override;
    std::optional<std::string> rtp_refusal(std::string_view target) const override;
    std::unique_ptr<Outlet> send(Tone const&, std::string_view rtp_target, Flow) override;

private:
    class Running;
    std::unique_ptr<Running> running_;
};

}  // namespace rois::media
