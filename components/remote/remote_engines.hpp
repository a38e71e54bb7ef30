// All sub engines of this engine, and the thread of their links.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/component.hpp"
#include "engine/engine.hpp"
#include "remote/programs.hpp"
#include "remote/sub_engine.hpp"
#include "types/engine_state.hpp"
#include "types/unique_descriptor.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::remote {

// Thread-safe.
class RemoteEngines {
public:
    // `change` is Engine::change, and may throw. It is called on the thread of the links. `report` receives lines
    // for the log about another engine or a program, on that thread and the one of the programs.
    struct Host {
        std::string name;      // of this engine
        std::string instance;  // of this engine
        std::shared_ptr<xml::Schemas const> schemas;
        std::function<std::vector<std::string>(ComponentChange)> change;
        std::function<void(std::string const& engine, std::string const& what)> report;
        // Makes a token for a program of a sub engine that joins here (Programs::Listener). Empty: it needs none.
        std::function<std::string(std::string const& engine)> token = [](std::string const&) { return std::string{}; };
        // The session that this engine had there before it was restarted (Engine::earlier_session), and what it had begun in it.
        std::function<Engine::EarlierSession(std::string const& engine)> earlier_session = [](std::string const&) {
            return Engine::EarlierSession{};
        };
        std::function<void(std::string const& engine, SessionId const&, std::function<void()> then)> session_opened =
            [](std::string const&, SessionId const&, std::function<void()> const& then) { then(); };
        std::function<void(std::string const& engine, std::optional<std::uint64_t> stop)> stopped_there =
            [](std::string const&, std::optional<std::uint64_t>) {};
        std::function<void(std::string const& engine, std::vector<CommandEnded>)> commands_ended =
            [](std::string const&, std::vector<CommandEnded> const&) {};
    };

    explicit RemoteEngines(Host const&);
    // Ends all sessions there, and all programs.
    ~RemoteEngines();
    RemoteEngines(RemoteEngines const&) = delete;
    RemoteEngines& operator=(RemoteEngines const&) = delete;

    // Sets the sub engines. A sub engine with the same settings as before stays connected. `url_for_programs`:
    // where the programs of sub engines join.
    void set(std::vector<SubEngine>, std::string const& url_for_programs);

    // Call it when everything is stopped in this engine, and when that stop is cleared. Any thread; returns at once.
    void everything_stopped(bool is_stopped);

    // What is known of each sub engine, by their names.
    std::vector<EngineState> states() const;

    // Takes a WebSocket of an engine that joins. `socket` and `head` as in client::accepted_link. `may_join`: whether its client
    // may join as the sub engine with this name; called on the thread of the links.
    void accept(UniqueDescriptor socket, std::string head, std::function<bool(std::string const& name)> may_join);

    // Makes this engine a sub engine of another one. Throws std::invalid_argument if the URL is invalid.
    void join(Joining);

    // A device by which the engine's clock shows that it runs. Add it to the engine.
    std::shared_ptr<Device> pulse() const;

private:
    class Links;
    std::shared_ptr<Links> links_;
    Programs programs_;
};

}  // namespace rois::remote
