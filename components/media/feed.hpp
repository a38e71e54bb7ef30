// The body of an endless HTTP response, produced piece by piece.
#pragma once

#include <memory>
#include <string>

#include "media/asio.hpp"
#include "media/channel.hpp"

namespace rois::media {

// Feeds one receiver. A feed advances only when next() is called.
class Feed {
public:
    virtual ~Feed() = default;

    virtual std::string content_type() const = 0;
    virtual Clock::duration interval() const = 0;  // between two pieces

    // Returns the next piece; empty if there is none yet.
    virtual std::string next(Clock::time_point now) = 0;
};

// The channel must outlive the feed.
std::unique_ptr<Feed> feed_of(Channel&);

}  // namespace rois::media
