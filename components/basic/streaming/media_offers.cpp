#include "basic/streaming/media_offers.hpp"

#include <algorithm>

#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois::basic {

namespace {

constexpr std::size_t longest_text = 1'024;
constexpr std::size_t most_offers = 16;

std::vector<std::string_view> parts_of(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    while (true) {
        auto const end = text.find(separator);
        parts.push_back(trimmed(text.substr(0, end)));
        if (end == text.npos) return parts;
        text.remove_prefix(end + 1);
    }
}

}  // namespace

std::variant<std::vector<MediaOffer>, std::string> read_media_offers(std::string_view text) {
    std::vector<MediaOffer> offers;
    if (trimmed(text).empty()) return offers;
    if (text.size() > longest_text) return "the list is longer than " + std::to_string(longest_text) + " bytes";
    auto const parts = parts_of(text, ',');
    if (parts.size() > most_offers) return "the list has more than " + std::to_string(most_offers) + " entries";
    for (auto const part : parts) {
        auto const pieces = parts_of(part, ';');
        if (pieces.front().empty()) return "the list has an empty entry";
        auto& offer = offers.emplace_back(MediaOffer{lower_case(pieces.front()), {}});
        for (auto const piece : pieces | std::views::drop(1)) {
            auto const equals = piece.find('=');
            if (equals == piece.npos || equals == 0) return "expected name=value after ';', not " + quoted(piece);
            offer.fields.emplace_back(lower_case(trimmed(piece.substr(0, equals))), trimmed(piece.substr(equals + 1)));
        }
    }
    return offers;
}

std::int32_t MediaFields::number(std::string_view name, std::int32_t least, std::int32_t most, std::int32_t otherwise) {
    auto const allowed = std::to_string(least) + " to " + std::to_string(most);
    auto const number = find(name, allowed);
    if (!number) return otherwise;
    if (*number < least || *number > most) problem_ = std::string{name} + " must be " + allowed;
    return *number;
}

std::int32_t MediaFields::one_of(std::string_view name, std::vector<std::int32_t> const& allowed) {
    auto const all = listed(allowed, [](std::int32_t each) { return std::to_string(each); });
    auto const number = find(name, all);
    if (!number) return allowed.front();
    if (std::ranges::find(allowed, *number) == allowed.end()) problem_ = std::string{name} + " must be one of " + all;
    return *number;
}

std::optional<std::int32_t> MediaFields::find(std::string_view name, std::string const& allowed) {
    std::optional<std::int32_t> found;
    for (std::size_t i = 0; i < offer_.fields.size(); ++i) {
        auto const& [field, text] = offer_.fields[i];
        if (field != name) continue;
        known_[i] = true;
        found = to_int(text);
        if (!found) problem_ = std::string{name} + " must be one of " + allowed + ", not " + quoted(text);
    }
    return found;
}

std::optional<std::string> MediaFields::problem() const {
    if (problem_) return quoted(offer_.name) + ": " + *problem_;
    auto const stranger = std::ranges::find(known_, false);
    if (stranger == known_.end()) return {};
    auto const& name = offer_.fields[static_cast<std::size_t>(stranger - known_.begin())].first;
    return quoted(offer_.name) + " has no field " + quoted(name);
}

}  // namespace rois::basic
