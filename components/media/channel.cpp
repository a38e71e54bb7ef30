#include "media/channel.hpp"

#include <utility>

#include "media/jpeg.hpp"

namespace rois::media {

std::vector<Reception> Channel::receptions() {
    std::lock_guard const lock{mutex_};
    if (!std::exchange(changed_, false)) return {};
    auto const named = [](bool received) { return received ? Reception::begun : Reception::ended; };
    bool const received = receivers_ > 0;
    if (std::exchange(reported_receiving_, received) != received) return {named(received)};
    return {named(!received), named(received)};
}

void Channel::receiver_joined() {
    std::lock_guard const lock{mutex_};
    if (receivers_++ == 0) changed_ = true;
}

void Channel::receiver_left() {
    std::lock_guard const lock{mutex_};
    if (--receivers_ == 0) changed_ = true;
}

std::shared_ptr<std::string const> Channel::picture(Clock::time_point now) {
    auto const& film = std::get<Film>(content_);
    auto const fresh = std::chrono::milliseconds{500} / film.frames_per_second;  // half a frame
    if (picture_ && now - drawn_ < fresh) return picture_;
    auto const drawn = film.draw();
    if (!drawn) return nullptr;
    picture_ = std::make_shared<std::string const>(jpeg_of(*drawn));
    drawn_ = now;
    return picture_;
}

void Directory::add(std::string id, std::shared_ptr<Channel> channel) {
    std::lock_guard const lock{mutex_};
    channels_.emplace(std::move(id), std::move(channel));
}

void Directory::remove(std::string const& id) {
    std::lock_guard const lock{mutex_};
    channels_.erase(id);
}

std::shared_ptr<Channel> Directory::find(std::string_view id) const {
    std::lock_guard const lock{mutex_};
    auto const found = channels_.find(id);
    return found == channels_.end() ? nullptr : found->second;
}

}  // namespace rois::media
