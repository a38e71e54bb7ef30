// The persons, faces and sounds that several units sense, as one list for each kind (docs/choosing.md).
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "choosing/fusion/fusion.hpp"
#include "engine/component.hpp"

namespace rois::choosing {

// The codebook of the names that the fusion gives.
constexpr std::string_view fused_codebook = "urn:x-rois:def:codebook:RoISGateway:fused";

// Called by Sightings::advance.
class Observer {
public:
    virtual ~Observer() = default;
    virtual void time_passed(Instant now) = 0;
};

// Shared by all logical components, and a device of their provider: the engine calls them one at a time.
class Sightings final : public Device {
public:
    void advance(Instant now) override;

    Steady now() const { return now_; }

    void add(Observer& observer) { observers_.push_back(&observer); }
    void remove(Observer const& observer) { std::erase(observers_, &observer); }

    // A logical component begins or ends to localize this kind ("person"). The fused list exists while one does.
    void begin(std::string const& kind);
    void end(std::string const& kind);
    // Null: no logical component localizes this kind.
    Fusion* fusion_of(std::string_view kind);

    // The codebook of a unit's own names.
    void note_codebook(std::string const& unit, std::string const& codebook) { codebooks_[unit] = codebook; }
    // Returns a unit's own identifier for a fused name. Nothing: the unit does not sense it now.
    std::optional<Identifier> translated(std::string const& name, std::string const& unit) const;
    // In mm.
    std::optional<std::array<double, 2>> position_of(std::string_view name) const;

private:
    struct Kind {
        Fusion fusion;
        int used = 0;  // by logical components
    };
    std::map<std::string, Kind, std::less<>> kinds_;
    std::map<std::string, std::string> codebooks_;  // by unit
    std::vector<Observer*> observers_;
    Steady now_{};
};

}  // namespace rois::choosing
