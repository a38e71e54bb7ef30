// Lists of media types and transports with fields, in order of preference.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace rois::basic {

// One entry: "audio/L16;rate=16000;channels=1".
struct MediaOffer {
    std::string name;                                         // in lower case
    std::vector<std::pair<std::string, std::string>> fields;  // names in lower case
};

// Reads "audio/L16;rate=16000, audio/wav". Returns the offers (none for an empty text), or why the text is invalid.
std::variant<std::vector<MediaOffer>, std::string> read_media_offers(std::string_view);

// Reads the fields of one offer. Read all known fields first, then call problem().
class MediaFields {
public:
    explicit MediaFields(MediaOffer const& offer) : offer_{offer}, known_(offer.fields.size(), false) {}

    // Returns `otherwise` if the field is missing.
    std::int32_t number(std::string_view name, std::int32_t least, std::int32_t most, std::int32_t otherwise);
    std::int32_t one_of(std::string_view name, std::vector<std::int32_t> const& allowed);  // the first if missing

    // Returns the first error, which may be an unknown field; nothing if the offer is valid.
    std::optional<std::string> problem() const;

private:
    std::optional<std::int32_t> find(std::string_view name, std::string const& allowed);

    MediaOffer const& offer_;
    std::vector<bool> known_;
    std::optional<std::string> problem_;
};

}  // namespace rois::basic
