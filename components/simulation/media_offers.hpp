// What may be asked of a stream: media types and transports with fields, in the order in which they are wanted.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace rois::simulation {

// "audio/L16;rate=16000;channels=1"
struct MediaOffer {
    std::string name;                                         // in small letters
    std::vector<std::pair<std::string, std::string>> fields;  // their names in small letters
};

// Reads "audio/L16;rate=16000, audio/wav"; none of an empty text. Or why not.
std::variant<std::vector<MediaOffer>, std::string> read_media_offers(std::string_view);

// The numbers of an offer, each one of those allowed: asked for one after the other, and at the end for what is wrong.
class MediaFields {
public:
    explicit MediaFields(MediaOffer const& offer) : offer_{offer}, known_(offer.fields.size(), false) {}

    // `otherwise` when it is not there.
    std::int32_t number(std::string_view name, std::int32_t least, std::int32_t most, std::int32_t otherwise);
    std::int32_t one_of(std::string_view name, std::vector<std::int32_t> const& allowed);  // the first when it is not there

    // The first thing that is wrong, also a field that was not asked for; nothing when all is well.
    std::optional<std::string> problem() const;

private:
    std::optional<std::int32_t> find(std::string_view name, std::string const& allowed);

    MediaOffer const& offer_;
    std::vector<bool> known_;
    std::optional<std::string> problem_;
};

}  // namespace rois::simulation
