// The implementation of the engine: its parts, and one `perform` for each operation, in the source file of its RoIS interface.
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
#include "engine/commands/deadlines.hpp"
#include "engine/commands/executor.hpp"
#include "engine/conditions/filter.hpp"
#include "engine/engine.hpp"
#include "engine/frames/perspective.hpp"
#include "engine/journal.hpp"
#include "engine/notifications/details.hpp"
#include "engine/notifications/notifier.hpp"
#include "engine/notifications/subscriptions.hpp"
#include "engine/registry.hpp"
#include "engine/session.hpp"

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
    // Delivers to every receiver, even if one delivery throws. `deliveries` keeps the first exception.
    void publish(EventOccurred const&, Instant now, Attempts& deliveries);
    void publish(ErrorOccurred const&, Instant now, Attempts& deliveries);
    ReceiveError noted(ErrorOccurred const&, Instant now);

    // Conditions (conditions.cpp)
    Vocabulary vocabulary(Declarations const* results = nullptr) const {
        return {
            .places = &places_, .parameters = &registry_.parameters(), .results = results, .main_engine = profile_.object.name};
    }
    // Returns whether one of these components may ever match, now or after a change of its state.
    bool may_ever_match(Filter const&, ComponentsInOrder possible, Session const& asker) const;
    // Returns the components that match, in the order of the selection, or else by ref. A group condition selects components of
    // one robot: the one that the asker would get (engine/commands/preference.hpp).
    std::vector<RegisteredComponent*> select(Selection const&, Session const& asker) const;
    struct ToBind {
        std::vector<RegisteredComponent*> components;  // in order of preference
        // Set if a robot meets a group condition but cannot be used, because another session has bound this component of it.
        RegisteredComponent const* held_of_group = nullptr;
    };
    // Returns the components that match. If the selection neither sorts nor has a group, stops at the first free component. A
    // group condition selects components of one robot, if the asker has bound or can bind all that the group asks for.
    ToBind select_to_bind(Selection const&, Session const& asker) const;
    // Removes the results that do not match (decision 19). Returns why the condition is invalid, or nullopt.
    std::optional<std::string> choose(Results&, QueryExpression const&, Declarations const& known, std::string_view id) const;
    // Sets the results that get_event_detail or get_error_detail returns. Returns why there are none, or nullopt. `kind` is
    // "event" or "error".
    std::optional<std::string> choose_details(Results&, Details::Answer const&, std::string_view kind, std::string const& id,
                                              QueryExpression const&) const;

    // Sessions (engine.cpp)
    void end(Session&, std::string_view why, Instant now);
    void remove(Session&, Instant now);
    void end_marked_sessions(Instant now, Attempts&);
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

    Journal no_journal_;
    Journal* journal_ = &no_journal_;               // never null
    MemoryBudget* memory_ = &MemoryBudget::none();  // never null
    EngineSettings settings_;
    FreshSecret fresh_secret_;
    std::vector<ComponentProfile> known_profiles_;
    EngineProfile profile_;
    mutable std::shared_ptr<EngineProfile const>
        shared_profile_;  // the copy that callers share; null until the first call of profile()
    Agenda agenda_;
    Places places_;
    Registry registry_;
    struct DeviceState {
        std::shared_ptr<Device> device;
        bool failed;  // at the last tick; the failure was reported
    };
    std::vector<DeviceState> devices_;
    std::unordered_map<SessionId, std::unique_ptr<Session>, IdHash> sessions_;
    Subscriptions subscriptions_;
    Deadlines deadlines_;
    Notifier notifier_;
    Executor executor_;
    Details events_;
    Details errors_;
    std::vector<SharedComponent> departed_;  // removed components; the agenda may still contain reports of them
    Steady details_checked_;
    Steady memory_saved_;
    std::vector<std::uint32_t> free_slots_;  // slots of ended sessions, to be reused (Details::Asker)
    std::optional<Steady> last_tick_;
    std::exception_ptr
        unsettled_;  // exception from `settle` after an operation; the next tick continues the work and rethrows it
    bool sessions_must_end_ = false;
    bool shutting_down_ = false;
    bool everything_is_stopped_ = false;
    std::optional<Steady> stop_reported_;  // when the sessions last received the error of a stop of everything
    bool stop_unreported_ = false;         // a later stop has not been reported yet: a tick will report it
    std::uint64_t events_published_ = 0;
    std::uint64_t errors_published_ = 0;
    std::uint64_t last_session_ = 0;
    std::uint64_t sessions_replaced_ = 0;
    // How often each limit was reached.
    struct {
        std::uint64_t sessions = 0;
        std::uint64_t commands = 0;
        std::uint64_t predicates = 0;
        std::uint64_t all_predicates = 0;
        std::uint64_t condition_bytes = 0;
    } refused_;
};

template <class R>
R refused(ReturnCode code, std::string reason) {
    R reply;
    reply.return_code = code;
    reply.reason = std::move(reason);
    return reply;
}

}  // namespace rois
