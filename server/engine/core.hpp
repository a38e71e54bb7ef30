// The engine's inside: its parts, and one `perform` for each operation, in the file of its RoIS interface.
#pragma once

#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/agenda.hpp"
#include "engine/attempts.hpp"
#include "engine/deadlines.hpp"
#include "engine/details.hpp"
#include "engine/engine.hpp"
#include "engine/executor.hpp"
#include "engine/filter.hpp"
#include "engine/journal.hpp"
#include "engine/notifier.hpp"
#include "engine/perspective.hpp"
#include "engine/registry.hpp"
#include "engine/session.hpp"
#include "engine/subscriptions.hpp"

namespace rois {

class Engine::Core {
public:
    Core(EngineProfile profile, std::vector<ComponentProfile> known_profiles, EngineSettings const& settings, Outbox& outbox,
         FreshSecret fresh_secret);

    void report_to(Journal& journal) { journal_ = &journal; }
    void keep_within(MemoryBudget& memory) { memory_ = &memory; }
    void add(std::unique_ptr<Component>);
    void change(ComponentChange, Instant now);
    void add(std::shared_ptr<Device> device) { devices_.push_back({std::move(device), false}); }
    void describe(Places places) { places_ = std::move(places); }

    std::variant<Reply, Refusal> handle(SessionId const&, Operation const&, Instant now);
    void begin(Instant now);
    void tick(Instant now);

    Session* find(SessionId const&) const;
    void end(SessionId const&, Instant now);
    void stop_everything(Instant now);
    void clear() { everything_is_stopped_ = false; }
    bool everything_is_stopped() const { return everything_is_stopped_; }
    std::vector<std::string> not_halted() const;
    std::vector<std::string> not_ready() const;
    void shut_down(Instant now);
    void heard_from(SessionId const&, Instant now);
    void heard_pong(SessionId const&, Instant now);
    void link_opened(SessionId const&, Link, Instant now);
    void link_closed(SessionId const&, Link, Closing, Instant now);

    std::shared_ptr<EngineProfile const> profile() const;
    std::vector<ComponentEntry> components() const;
    EngineStatistics statistics() const;

private:
    // Components (components.cpp)
    using SharedComponent = std::shared_ptr<RegisteredComponent>;
    SharedComponent made(std::unique_ptr<Component>, std::vector<ComponentProfile> const& known);
    void enter(SharedComponent const&);
    void leave(SharedComponent const&, Instant now);
    void check(ComponentChange const&) const;

    // System interface (system_interface.cpp)
    std::variant<Reply, Refusal> connect(SessionId const&, Connect const&, Instant now);
    Reply perform(Session&, Connect const&, Instant now);
    Reply perform(Session&, Resume const&, Instant now);
    Reply perform(Session&, Disconnect const&, Instant now);
    Reply perform(Session&, GetProfile const&, Instant now);
    Reply perform(Session&, GetErrorDetail const&, Instant now);

    // Command interface (command_interface.cpp)
    Reply perform(Session&, Search const&, Instant now);
    Reply perform(Session&, Bind const&, Instant now);
    Reply perform(Session&, BindAny const&, Instant now);
    Reply perform(Session&, Release const&, Instant now);
    Reply perform(Session&, GetParameter const&, Instant now);
    Reply perform(Session&, SetParameter const&, Instant now);
    Reply perform(Session&, Execute const&, Instant now);
    Reply perform(Session&, GetCommandResult const&, Instant now);

    // Query interface (query_interface.cpp)
    Reply perform(Session&, Query const&, Instant now);
    Reply answer_of_whole_engine(Session const&, std::string const& query_type, Instant now);
    static std::vector<Results> answers(Session const&, RegisteredComponent&, std::string const& query_type, Instant now);

    // Event interface (event_interface.cpp)
    Reply perform(Session&, Subscribe const&, Instant now);
    std::optional<std::string> no_room_for(Session const&, Filter const&, bool shared);
    Reply perform(Session&, Unsubscribe const&, Instant now);
    Reply perform(Session&, GetEventDetail const&, Instant now);
    // `deliveries` keeps the failure of a delivery. The other deliveries are made nevertheless.
    void publish(EventOccurred const&, Instant now, Attempts& deliveries);
    void publish(ErrorOccurred const&, Instant now, Attempts& deliveries);
    ReceiveError noted(ErrorOccurred const&, Instant now);

    // Conditions (conditions.cpp)
    Vocabulary vocabulary(Declarations const* results = nullptr) const {
        return {
            .places = &places_, .parameters = &registry_.parameters(), .results = results, .main_engine = profile_.object.name};
    }
    // Whether one of these may meet it, whatever becomes of them.
    bool may_ever_match(Filter const&, ComponentsInOrder possible, Session const& asker) const;
    // The components that match, in the order of the selection, else by ref. A group condition selects components of one robot:
    // the one that the asker would get (engine/preference.hpp).
    std::vector<RegisteredComponent*> select(Selection const&, Session const& asker) const;
    struct ToBind {
        std::vector<RegisteredComponent*> components;  // in the order in which one is taken
        // Set if a robot met a group condition, but another session holds this component, which the asker lacks.
        RegisteredComponent const* held_of_group = nullptr;
    };
    // The components that match. Unless the selection sorts or has a group, stops behind the first free one. A group condition
    // selects components of one robot, if the asker has bound or can bind all that the group looks for.
    ToBind select_to_bind(Selection const&, Session const& asker) const;
    // Leaves the results that match (decision 19). Returns why the condition cannot be used, or nothing.
    std::optional<std::string> choose(Results&, QueryExpression const&, Declarations const& known, std::string_view id) const;

    // Sessions (engine.cpp)
    void end(Session&, std::string_view why, Instant now);
    void part_with(Session&, Instant now);
    void end_those_that_must(Instant now, Attempts&);
    void mark_overflowed();
    static SessionStatistics statistics(Session const&);
    Session* longest_idle() const;
    void await_end_of_window(Session&, Steady not_before = Steady::min());
    void end_if_lost(SessionId const&, Instant now);
    void settle(Instant now);
    void save_memory(Instant now);
    void advance_devices(Instant now);
    void hold_unproven_motion(Instant now);
    void report_stop_of_everything(Instant now);
    void carry_out_what_is_due(Instant now, Attempts&);
    void forget_what_is_old(Instant now);
    void unbind(Session&, RegisteredComponent&, Instant now);

    Journal nobody_;
    Journal* journal_ = &nobody_;                   // never null
    MemoryBudget* memory_ = &MemoryBudget::none();  // never null
    EngineSettings settings_;
    FreshSecret fresh_secret_;
    std::vector<ComponentProfile> known_profiles_;
    EngineProfile profile_;
    mutable std::shared_ptr<EngineProfile const> told_profile_;  // the same for those who read it; null until somebody does
    Agenda agenda_;
    Places places_;
    Registry registry_;
    struct Moved {
        std::shared_ptr<Device> device;
        bool failed;  // at the last tick; the failure was reported
    };
    std::vector<Moved> devices_;
    std::unordered_map<SessionId, std::unique_ptr<Session>, IdHash> sessions_;
    Subscriptions subscriptions_;
    Deadlines deadlines_;
    Notifier notifier_;
    Executor executor_;
    Details events_;
    Details errors_;
    std::vector<SharedComponent> departed_;  // what they said may still be on the agenda
    Steady details_checked_;
    Steady memory_saved_;
    std::vector<std::uint32_t> free_slots_;  // slots of ended sessions, to be used again (Details::Asker)
    std::optional<Steady> last_tick_;
    std::exception_ptr unsettled_;  // thrown while settling a performed operation; the next tick continues and rethrows it
    bool sessions_must_end_ = false;
    bool shutting_down_ = false;
    bool everything_is_stopped_ = false;
    std::optional<Steady> stop_reported_;  // to the sessions, for the last time
    std::uint64_t events_published_ = 0;
    std::uint64_t errors_published_ = 0;
    std::uint64_t last_session_ = 0;
    std::uint64_t sessions_replaced_ = 0;
    // How often there would have been too many.
    struct {
        std::uint64_t sessions = 0;
        std::uint64_t commands = 0;
        std::uint64_t predicates = 0;
        std::uint64_t all_predicates = 0;
        std::uint64_t condition_bytes = 0;
    } refused_;
};

// A reply that says no.
template <class R>
R refused(ReturnCode code, std::string reason) {
    R reply;
    reply.return_code = code;
    reply.reason = std::move(reason);
    return reply;
}

}  // namespace rois
