// An engine that keeps a journal in memory, and whose process may die.
#pragma once

#include <vector>

#include "engine/world.hpp"

namespace rois {

struct Journaled : testing::Test {
    Journaled() { world.keep_journal(); }

    // The process dies, and begins again. Returns the application, whose client has reconnected.
    Application die_and_resume(Application const& application, std::vector<Part> const& parts = {navigation, speech, detection}) {
        world.restart(parts);
        world.engine->begin(world.now);
        Application resumed{world, application.session};
        world.engine->link_opened(application.session, LinkKind::websocket, world.now);
        return resumed;
    }

    MemoryJournal& journal() { return *world.journal; }
    void store() {
        journal().settle(true);
        world.engine->and_work([&] { world.engine->stored(world.now); }, world.now);
    }
    void fail_to_store() {
        journal().settle(false);
        world.engine->and_work([&] { world.engine->not_stored(world.now); }, world.now);
    }

    World world{navigation, speech, detection};
};

}  // namespace rois
