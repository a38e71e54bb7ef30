#include "broken/frame.hpp"

#include <cstdlib>
#include <utility>

namespace rois::broken {

namespace {

constexpr std::string_view attribute = " sequence=\"";

// Returns the offset of the sequence number in the root's start tag, or npos if it has none.
std::size_t place_of_sequence(std::string const& document) {
    auto const found = document.find(attribute);
    return found == std::string::npos || found > document.find('>') ? std::string::npos : found + attribute.size();
}

}  // namespace

std::optional<Frame> read_frame(kit::Socket& from) {
    auto bytes = from.take(2);
    if (!bytes) return {};
    auto const rest = from.take(kit::frame_head_size(*bytes) - bytes->size());
    if (!rest) return {};
    *bytes += *rest;
    auto const head = kit::frame_head(*bytes).value();
    auto payload = from.take(head.payload_size);
    if (!payload) return {};
    Frame frame{head, *bytes + *payload, std::move(*payload)};
    if (frame.is_masked()) kit::mask(frame.payload, std::string_view{*bytes}.substr(head.size - 4));
    return frame;
}

long sequence_of(std::string const& document) {
    auto const at = place_of_sequence(document);
    return at == std::string::npos ? 0 : std::strtol(document.c_str() + at, nullptr, 10);
}

std::string with_sequence(std::string const& notification, long sequence) {
    auto const at = place_of_sequence(notification);
    return notification.substr(0, at) + std::to_string(sequence) + notification.substr(notification.find('"', at));
}

}  // namespace rois::broken
