// Identifiers that the engine or an application assigns. Each kind is a type of its own, so that they cannot be mixed up.
#pragma once

#include <compare>
#include <functional>
#include <string>

namespace rois {

template <class Tag>
struct Id {
    std::string text;

    auto operator<=>(Id const&) const = default;
};

using SessionId = Id<struct SessionTag>;      // a secret of at least 128 bits
using CommandId = Id<struct CommandTag>;      // command_id of a command message, unique within its session
using SubscribeId = Id<struct SubscribeTag>;  // subscribe_id of a subscription: an event type and a condition
using EventId = Id<struct EventTag>;          // event_id of one event
using ErrorId = Id<struct ErrorTag>;          // error_id of one error notification

struct IdHash {
    template <class Tag>
    std::size_t operator()(Id<Tag> const& id) const noexcept {
        return std::hash<std::string>{}(id.text);
    }
};

}  // namespace rois
