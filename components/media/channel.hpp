// Something that is served, as the thread that offers it and the media thread see it.
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

namespace rois::media {

class Channel {
public:
    explicit Channel(Content content) : content_{std::move(content)} {}

    // --- Any thread ---
    Content const& content() const { return content_; }
    void hold() { held_ = true; }
    void go_on() { held_ = false; }
    bool held() const { return held_; }
    void end() { ended_ = true; }
    bool ended() const { return ended_; }

    // What happened since this was last asked: none, one, or two when it is now as it was then.
    std::vector<Reception> receptions();

    // --- The media thread ---
    void come();
    void go();

    // The film's picture, as JPEG: the last one while it is fresh. Null as long as there is nothing to be seen.
    std::shared_ptr<std::string const> picture(Clock::time_point now);

    Clock::time_point interest_until;  // of those who ask for single pictures
    bool interest_watched = false;

private:
    Content const content_;
    std::atomic<bool> held_ = false;
    std::atomic<bool> ended_ = false;
    std::mutex mutex_;
    std::size_t receivers_ = 0;
    bool told_ = false;     // that there are receivers
    bool changed_ = false;  // since then
    std::shared_ptr<std::string const> picture_;
    Clock::time_point drawn_;
};

// Counts as one who receives, as long as it lives.
class Receiver {
public:
    explicit Receiver(Channel& channel) : channel_{channel} { channel_.come(); }
    ~Receiver() { channel_.go(); }
    Receiver(Receiver const&) = delete;
    Receiver& operator=(Receiver const&) = delete;

private:
    Channel& channel_;
};

// The channels that HTTP serves, by the last part of their path. Any thread.
class Directory {
public:
    void add(std::string id, std::shared_ptr<Channel>);
    void remove(std::string const& id);
    std::shared_ptr<Channel> find(std::string_view id) const;  // null when there is none

private:
    mutable std::mutex mutex_;
    std::map<std::string, std::shared_ptr<Channel>, std::less<>> channels_;
};

}  // namespace rois::media
