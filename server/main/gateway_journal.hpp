// The gateway's journal (key `state`; docs/journal.md), and what an earlier start has left in it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "engine/engine.hpp"
#include "gateway/gateway.hpp"
#include "gateway/process/telemetry.hpp"
#include "journal/journal_file.hpp"
#include "journal/journal_writer.hpp"
#include "main/settings.hpp"
#include "xml/validation/schemas.hpp"

namespace rois {

// The journal's file, and what it holds.
struct OpenedJournal {
    std::unique_ptr<journal::JournalFile> file;
    StoredState state;
};

// Returns nothing if the gateway keeps no journal. Throws journal::BadJournal.
std::optional<OpenedJournal> opened_journal(GatewaySettings const&, std::shared_ptr<xml::Schemas const> const&);

class GatewayJournal {
public:
    // All must outlive the journal. From now on, the engine stores what it acknowledges.
    GatewayJournal(OpenedJournal, Engine&, Gateway&, Telemetry&);

    // Lets the engine continue with what an earlier start has stored. Call it once, before the first request.
    void restore(Tokens*);  // null: the gateway has none

    // Other bytes for its files (key `state_bytes`). Thread-safe.
    void limit(std::size_t bytes) { writer_.limit(bytes); }

    // Waits until everything is stored. Without an answer of the disk, logs that and ends the process with this code: a thread
    // that waits for the disk cannot be ended.
    void finish(int exit_code);

private:
    Engine& engine_;
    StoredState state_;
    journal::JournalWriter writer_;
};

}  // namespace rois
