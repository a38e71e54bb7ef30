// What a receiver of an endless answer is sent, piece by piece.
#pragma once

#include <memory>
#include <string>

#include "media/asio.hpp"
#include "media/channel.hpp"

namespace rois::media {

// For one receiver. Time stands still in it while it is not asked.
class Feed {
public:
    virtual ~Feed() = default;

    virtual std::string content_type() const = 0;
    virtual Clock::duration interval() const = 0;  // from piece to piece

    // The next piece; empty when there is none yet.
    virtual std::string next(Clock::time_point now) = 0;
};

// The channel outlives it.
std::unique_ptr<Feed> feed_of(Channel&);

}  // namespace rois::media
