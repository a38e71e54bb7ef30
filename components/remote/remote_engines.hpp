// All sub engines of this engine, and the thread of their links.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/component.hpp"
#include "engine/engine.hpp"
#include "remote/sub_engine.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::remote {

// Thread-safe.
class RemoteEngines {
public:
    // Both functions are called on the thread of the links. `change` changes this engine's components, and may throw. `report`
    // receives lines for the log about another engine.
    struct Host {
        std::string instance;  // of this engine
        std::shared_ptr<xml::Schemas const> schemas;
        std::function<void(ComponentChange)> change;
        std::function<void(std::string const& engine, std::string const& what)> report;
    };

    explicit RemoteEngines(Host);
    // Ends all sessions there.
    ~RemoteEngines();
    RemoteEngines(RemoteEngines const&) = delete;
    RemoteEngines& operator=(RemoteEngines const&) = delete;

    // Sets the sub engines. A sub engine with the same settings as before stays connected.
    void set(std::vector<SubEngine>);

    // Takes a WebSocket of an engine that joins. `socket` and `head` as in client::accepted_link.
    void accept(int socket, std::string head);

    // Makes this engine a sub engine of another one. Throws std::invalid_argument for a URL that is none.
    void join(Joining);

    // A device by which the engine's clock shows that it runs. Add it to the engine.
    std::shared_ptr<Device> pulse() const;

private:
    class Links;
    std::shared_ptr<Links> links_;
};

}  // namespace rois::remote
