// Identifiers that the engine or an application gives out, each a type of its own so that they cannot be mixed up.
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

using SessionId = Id<struct SessionTag>;      // names a session; a secret, 128 bits or more
using CommandId = Id<struct CommandTag>;      // command_id of a command message, unique within its session
using SubscribeId = Id<struct SubscribeTag>;  // subscribe_id: names an event type and a condition
using EventId = Id<struct EventTag>;          // event_id of one event
using ErrorId = Id<struct ErrorTag>;          // error_id of one error notification

// Orders and hashes an id by its text.
struct IdHash {
    template <class Tag>
    std::size_t operator()(Id<Tag> const& id) const noexcept {
        return std::hash<std::string>{}(id.text);
    }
};

}  // namespace rois
