#include "xml/tables/interned.hpp"

#include <cstring>
#include <limits>
#include <stdexcept>

namespace rois::xml {

namespace {

// Hashes the length and up to 8 bytes at each end: names differ there, and long namespaces cost no more than short names.
std::size_t hash(std::string_view text) {
    std::uint64_t first = 0, last = 0;
    auto const ends = [&](auto number) {
        text.copy(reinterpret_cast<char*>(&number), sizeof number);
        first = number;
        text.substr(text.size() - sizeof number).copy(reinterpret_cast<char*>(&number), sizeof number);
        last = number;
    };
    if (text.size() >= 8) {
        ends(std::uint64_t{});
    } else if (text.size() >= 4) {
        ends(std::uint32_t{});
    } else if (!text.empty()) {
        ends(std::uint8_t{});
    }
    constexpr std::uint64_t odd = 0x9E3779B97F4A7C15u;
    auto const mixed = (first ^ (last * odd) ^ text.size()) * odd;
    return static_cast<std::size_t>(mixed >> 32);
}

}  // namespace

Interned::Interned() : texts_(1), slots_(256, unknown) { add({}); }

Interned::Id Interned::add(std::string_view text) {
    if (auto const known = find(text); known != unknown) return known;
    if (texts_.size() > std::numeric_limits<Id>::max()) throw std::runtime_error("the schemas have too many names");
    texts_.emplace_back(text);
    if (texts_.size() * 2 > slots_.size()) {
        slots_.assign(slots_.size() * 2, unknown);
        for (std::size_t id = 1; id + 1 < texts_.size(); ++id) place(static_cast<Id>(id));
    }
    auto const id = static_cast<Id>(texts_.size() - 1);
    place(id);
    return id;
}

void Interned::place(Id id) {
    auto at = hash(texts_[id]) & (slots_.size() - 1);
    while (slots_[at] != unknown) at = (at + 1) & (slots_.size() - 1);
    slots_[at] = id;
}

Interned::Id Interned::find(std::string_view text) const {
    for (auto at = hash(text) & (slots_.size() - 1); slots_[at] != unknown; at = (at + 1) & (slots_.size() - 1)) {
        if (texts_[slots_[at]] == text) return slots_[at];
    }
    return unknown;
}

}  // namespace rois::xml
