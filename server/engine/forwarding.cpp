// The public functions of the engine, which its implementation performs.
#include <utility>

#include "engine/core.hpp"

namespace rois {

Engine::Engine(EngineProfile profile, std::vector<ComponentProfile> known_profiles, EngineSettings settings, Outbox& outbox,
               FreshSecret fresh_secret)
    : core_{std::make_unique<Core>(std::move(profile), std::move(known_profiles), settings, outbox, std::move(fresh_secret))} {}

Engine::~Engine() = default;

void Engine::keep_in(Journal& journal) { core_->keep_in(journal); }
void Engine::restore(StoredState state, RightsOf const& rights_of, Instant now) {
    core_->restore(std::move(state), rights_of, now);
}
Engine::EarlierSession Engine::earlier_session(std::string const& provider) const { return core_->earlier_session(provider); }
void Engine::session_opened_there(std::string const& provider, SessionId const& id) { core_->session_opened_there(provider, id); }
void Engine::stopped_there(std::string const& provider, std::optional<std::uint64_t> stop) {
    core_->stopped_there(provider, stop);
}
void Engine::ended_there(std::string const& provider, std::vector<CommandEnded> ended, Instant now) {
    core_->ended_there(provider, std::move(ended), now);
}
void Engine::stored(Instant now) { core_->stored(now); }
void Engine::not_stored(Instant now) { core_->not_stored(now); }
void Engine::when_stored(std::function<void()> then) { core_->when_stored(std::move(then)); }
void Engine::flush() noexcept { core_->flush(); }
void Engine::published(NotificationQueue& queue) { core_->published(queue); }
void Engine::use(EngineSettings const& settings) { core_->use(settings); }
void Engine::report_to(Trace& trace) { core_->report_to(trace); }
void Engine::keep_within(MemoryBudget& memory) { core_->keep_within(memory); }
void Engine::add(std::unique_ptr<Component> component) { core_->add(std::move(component)); }
std::vector<std::string> Engine::change(ComponentChange change, Instant now) { return core_->change(std::move(change), now); }
void Engine::add(std::shared_ptr<Device> device, std::string const& provider, bool returns_at_once) {
    core_->add(std::move(device), provider, returns_at_once);
}
void Engine::on_report(std::function<void()> wake) { core_->on_report(std::move(wake)); }
void Engine::describe(Places places) { core_->describe(std::move(places)); }

void Engine::handle(std::shared_ptr<Asked> const& asked, Instant now) { core_->handle(asked, now); }
void Engine::begin(Instant now) { core_->begin(now); }
void Engine::tick(Instant now) { core_->tick(now); }
void Engine::work(std::unique_lock<std::mutex>& lock, Instant now, Provider::Runner runner) { core_->work(lock, now, runner); }

std::shared_ptr<NotificationQueue> Engine::notifications(SessionId const& id, Rights const* rights) const {
    auto const* session = core_->find(id);
    return session == nullptr || session->rights.get() != rights ? nullptr : session->notifications;
}

bool Engine::is_of_another(SessionId const& id, Rights const* rights) const {
    auto const* session = core_->find(id);
    return session != nullptr && session->rights.get() != rights;
}

bool Engine::is_engine(SessionId const& id) const {
    auto const* session = core_->find(id);
    return session != nullptr && session->is_engine;
}

std::shared_ptr<NotificationQueue> Engine::note_request(SessionId const& id, Instant now, Rights const* rights) {
    return core_->note_request(id, now, rights);
}
void Engine::note_pong(SessionId const& id, Instant now) { core_->note_pong(id, now); }
void Engine::link_opened(SessionId const& id, LinkKind link, Instant now) { core_->link_opened(id, link, now); }
void Engine::link_closed(SessionId const& id, LinkKind link, Closing closing, Instant now) {
    core_->link_closed(id, link, closing, now);
}
void Engine::end(SessionId const& id, Instant now) { core_->end(id, now); }
void Engine::end_withdrawn(Instant now) { core_->end_withdrawn(now); }
void Engine::shut_down(Instant now) { core_->shut_down(now); }
void Engine::halt_everything(Instant now) { core_->halt_everything(now); }

void Engine::stop_everything(Instant now) { core_->stop_everything(now); }
void Engine::clear() { core_->clear(); }
void Engine::on_stop(std::function<void(bool is_stopped)> call) { core_->on_stop(std::move(call)); }
bool Engine::everything_is_stopped() const { return core_->everything_is_stopped(); }
std::vector<std::string> Engine::not_halted() const { return core_->not_halted(); }
std::vector<std::string> Engine::not_ready() const { return core_->not_ready(); }

std::shared_ptr<EngineProfile const> Engine::profile(Rights const* rights) const {
    return core_->profile_seen_by(rights, core_->profile_without_members());
}
std::vector<ComponentEntry> Engine::components(Rights const* rights) const { return core_->components(rights); }
EngineStatistics Engine::statistics() const { return core_->statistics(); }

}  // namespace rois
