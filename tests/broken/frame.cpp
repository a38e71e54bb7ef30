#include "broken/frame.hpp"

#include <cstdlib>

namespace rois::broken {

namespace {

constexpr std::string_view mask = "\x12\x34\x56\x78";
constexpr std::string_view attribute = " sequence=\"";

void mask_with(std::string_view key, std::string& payload) {
    for (std::size_t i = 0; i < payload.size(); ++i) payload[i] = static_cast<char>(payload[i] ^ key[i & 3]);
}

// Where the number begins in the root's start tag.
std::size_t place_of_sequence(std::string const& document) {
    auto const found = document.find(attribute);
    return found == std::string::npos || found > document.find('>') ? std::string::npos : found + attribute.size();
}

}  // namespace

std::optional<Frame> read_frame(Socket& from) {
    auto head = from.take(2);
    if (!head) return {};
    std::size_t size = static_cast<unsigned char>((*head)[1]) & 0x7F;
    Frame frame{*head, "", (static_cast<unsigned char>((*head)[1]) & 0x80) != 0};
    if (size >= 126) {
        auto const length = from.take(size == 126 ? 2 : 8);
        if (!length) return {};
        frame.bytes += *length;
        size = 0;
        for (char const c : *length) size = size << 8 | static_cast<unsigned char>(c);
    }
    auto const key = from.take(frame.is_masked ? 4 : 0);
    auto const payload = key ? from.take(size) : key;
    if (!payload) return {};
    frame.bytes += *key + *payload;
    frame.payload = *payload;
    if (frame.is_masked) mask_with(*key, frame.payload);
    return frame;
}

std::string frame_of(std::string const& text, Masked masked) {
    std::string frame{"\x81"};
    unsigned const mask_bit = masked == Masked::yes ? 0x80 : 0;
    int length_bytes = 0;
    if (text.size() < 126) {
        frame.push_back(static_cast<char>(mask_bit | text.size()));
    } else {
        length_bytes = text.size() < 65'536 ? 2 : 8;
        frame.push_back(static_cast<char>(mask_bit | (length_bytes == 2 ? 126 : 127)));
    }
    for (int i = length_bytes - 1; i >= 0; --i) frame.push_back(static_cast<char>(text.size() >> (8 * i)));
    auto payload = text;
    if (masked == Masked::yes) {
        frame += mask;
        mask_with(mask, payload);
    }
    return frame + payload;
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
