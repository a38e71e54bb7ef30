#include "main/gateway_journal.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <utility>

#include "gateway/shutdown.hpp"
#include "journal/records.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

constexpr std::chrono::seconds longest_wait{2};  // for the disk, at the end (docs/safety.md#the-end)

}  // namespace

std::optional<OpenedJournal> opened_journal(GatewaySettings const& settings, std::shared_ptr<xml::Schemas const> const& schemas) {
    if (settings.state.empty()) return {};
    OpenedJournal opened{std::make_unique<journal::JournalFile>(settings.state, settings.state_bytes), {}};
    try {
        opened.state = journal::state_of(opened.file->read(), schemas);
        opened.state.engine.is_stopped = opened.state.engine.is_stopped || opened.file->stop().is_stopped();
    } catch (journal::BadRecord const& problem) {
        throw journal::BadJournal{"state: " + rois::quoted(opened.file->name()) + " is damaged: " + problem.what()};
    }
    opened.file->grow();
    return opened;
}

GatewayJournal::GatewayJournal(OpenedJournal opened, Engine& engine, Gateway& gateway, Telemetry& telemetry)
    : engine_{engine},
      state_{std::move(opened.state)},
      writer_{std::move(opened.file),
              {.done = [&gateway](bool stored) { gateway.stored(stored); },
               .broken = [&gateway, &telemetry](std::string const& why) { halt_and_exit(gateway, telemetry, "journal: " + why); },
               .say = [](std::string const& line) { spdlog::warn("journal: {}", line); }}} {
    engine.keep_in(writer_);
    telemetry.show_journal([this] {
        auto const numbers = writer_.numbers();
        return Telemetry::JournalNumbers{numbers.stored, numbers.not_stored, numbers.has_room};
    });
}

// With tokens, no client could use a session that was opened without one. Links of this process have none.
void GatewayJournal::restore(Tokens* tokens) {
    auto const rights_of = [&](std::string const& id) {
        auto const holder = tokens == nullptr ? nullptr : tokens->holder_of(id);
        return holder ? holder->rights : nullptr;
    };
    for (auto& session : state_.sessions)
        if (tokens != nullptr && session.rights.empty() && !session.is_engine) session.rights = "opened without a token";
    auto const may_return = [&](StoredSession const& session) {
        return session.rights.empty() || rights_of(session.rights) != nullptr;
    };
    if (auto const sessions = std::ranges::count_if(state_.sessions, may_return); sessions > 0)
        spdlog::info("journal: {} {} of the last start can be resumed", sessions, sessions == 1 ? "session" : "sessions");
    engine_.restore(std::exchange(state_, {}), rights_of, {std::chrono::steady_clock::now(), std::chrono::system_clock::now()});
}

void GatewayJournal::finish(int exit_code) {
    if (writer_.finish(longest_wait)) return;
    spdlog::error("journal: the disk does not answer: the end of the sessions may not be stored");
    spdlog::default_logger_raw()->flush();
    std::_Exit(exit_code);
}

}  // namespace rois
