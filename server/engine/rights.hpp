// What a client may see and command (docs/trust.md). A session has the rights of the client that opened it.
#pragma once

#include <atomic>
#include <string>
#include <utility>
#include <vector>

namespace rois {

// Thread-safe. Patterns are those of a shell, and match refs: "robot1.*", "*_detection".
class Rights {
public:
    // `holder`: whose rights they are, for the log. `id` identifies the same rights after a restart; empty: they do not return.
    Rights(std::string holder, std::vector<std::string> sees, std::vector<std::string> commands, std::string id = {})
        : holder_{std::move(holder)}, sees_{std::move(sees)}, commands_{std::move(commands)}, id_{std::move(id)} {}

    // Whether the component exists for the client: in profiles, conditions, events, errors and metrics.
    bool sees(std::string const& ref) const { return matches(sees_, ref); }
    // Whether the client may bind it.
    bool commands(std::string const& ref) const { return sees(ref) && matches(commands_, ref); }
    // Whether one of the patterns is "*".
    bool sees_everything() const;
    // Whether one of the patterns fits every ref that begins with this text.
    bool sees_all_of(std::string const& beginning) const;

    // From now on nothing is allowed. The owner then lets the engine end the sessions (Engine::end_withdrawn).
    void withdraw() const { is_withdrawn_ = true; }
    bool is_withdrawn() const { return is_withdrawn_.load(std::memory_order_relaxed); }

    std::string const& holder() const { return holder_; }
    std::vector<std::string> const& seen() const { return sees_; }
    std::vector<std::string> const& commanded() const { return commands_; }
    std::string const& id() const { return id_; }

private:
    static bool matches(std::vector<std::string> const& patterns, std::string const& ref);

    std::string holder_;
    std::vector<std::string> sees_;
    std::vector<std::string> commands_;
    std::string id_;
    mutable std::atomic<bool> is_withdrawn_ = false;
};

// Null: a client without limits.
inline bool may_see(Rights const* rights, std::string const& ref) { return rights == nullptr || rights->sees(ref); }
inline bool may_see_everything(Rights const* rights) { return rights == nullptr || rights->sees_everything(); }
inline bool may_command(Rights const* rights, std::string const& ref) { return rights == nullptr || rights->commands(ref); }

}  // namespace rois
