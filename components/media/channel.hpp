// One served medium, shared by the thread that offers it and the media thread.
#pragma once

#include <atomic>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "media/asio.hpp"
#include "media/media.hpp"
#include "media/settings.hpp"

namespace rois::media {

class Channel {
public:
    explicit Channel(Content content) : content_{std::move(content)} {}

    // --- Thread-safe ---
    Content const& content() const { return content_; }
    void hold() { held_ = true; }
    void go_on() { held_ = false; }
    bool held() const { return held_; }
    void end() { ended_ = true; }
    bool ended() const { return ended_; }

    // Returns the changes since the last call: none, one, or two if reception changed and changed back.
    std::vector<Reception> receptions();

    // --- The media thread ---
    void receiver_joined();
    void receiver_left();

    // Returns the film's current picture as JPEG; null before the first one. Reuses the last picture for half a frame.
    std::shared_ptr<std::string const> picture(Clock::time_point now);

    Clock::time_point interest_until;  // the last request for a single picture counts as a receiver until then
    bool interest_watched = false;

private:
    Content const content_;
    std::atomic<bool> held_ = false;
    std::atomic<bool> ended_ = false;
    std::mutex mutex_;
    std::size_t receivers_ = 0;
    bool reported_receiving_ = false;  // the last state that receptions() returned
    bool changed_ = false;             // reception has changed since then
    std::shared_ptr<std::string const> picture_;
    Clock::time_point drawn_;
};

// Counts as one receiver of the channel while it lives.
class Receiver {
public:
    explicit Receiver(Channel& channel) : channel_{channel} { channel_.receiver_joined(); }
    ~Receiver() { channel_.receiver_left(); }
    Receiver(Receiver const&) = delete;
    Receiver& operator=(Receiver const&) = delete;

private:
    Channel& channel_;
};

// The channels served over HTTP, keyed by the last part of their path. Thread-safe.
class Directory {
public:
    void add(std::string id, std::shared_ptr<Channel>);
    void remove(std::string const& id);
    std::shared_ptr<Channel> find(std::string_view id) const;  // null if unknown

private:
    mutable std::mutex mutex_;
    std::map<std::string, std::shared_ptr<Channel>, std::less<>> channels_;
};

// Serves one HTTP connection of a receiver, which makes a single request. Completes when the receiver leaves, the channel ends or
// the response is complete. The directory and the settings must live that long.
Task<> serve_receiver(Socket, Directory const&, Settings const&);

}  // namespace rois::media
