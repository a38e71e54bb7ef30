// The media server: HTTP on its own port, and RTP to targets that applications name.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "media/media.hpp"
#include "media/settings.hpp"

namespace rois::media {

class Server final : public Media {
public:
    // Starts the server on its own thread. `fresh_id` returns a unique, unguessable text of letters, digits, '-' and '_'; serve()
    // calls it. Throws std::runtime_error if the server cannot listen.
    Server(Settings, std::function<std::string()> fresh_id);
    ~Server() override;  // outlets may outlive the server, but then serve nothing
    Server(Server const&) = delete;
    Server& operator=(Server const&) = delete;

    // The start of all HTTP addresses: "http://127.0.0.1:8081".
    std::string const& url() const;

    // Other limits from now on. Thread-safe.
    void use(Limits const&);

    std::unique_ptr<Outlet> serve(Content, Flow) override;
    std::optional<std::string> rtp_refusal(std::string_view target) const override;
    std::unique_ptr<Outlet> send(Tone const&, std::string_view rtp_target, Flow) override;

private:
    class Running;
    std::unique_ptr<Running> running_;
};

}  // namespace rois::media
