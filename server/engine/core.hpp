// The implementation of the engine: its parts, and one `perform` for each operation, in the source file of its RoIS interface.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/agenda.hpp"
#include "engine/attempts.hpp"
#include "engine/commands/deadlines.hpp"
#include "engine/commands/executor.hpp"
#include "engine/commands/sequence_check.hpp"
#include "engine/conditions/effort.hpp"
#include "engine/conditions/filter.hpp"
#include "engine/engine.hpp"
#include "engine/frames/perspective.hpp"
#include "engine/journal/recorder.hpp"
#include "engine/notifications/details.hpp"
#include "engine/notifications/kept_events.hpp"
#include "engine/notifications/notifier.hpp"
#include "engine/notifications/subscriptions.hpp"
#include "engine/providers/inbox.hpp"
#include "engine/providers/provider.hpp"
#include "engine/questions.hpp"
#include "engine/registry.hpp"
#include "engine/session.hpp"
#include "engine/trace.hpp"

namespace rois {

class Engine::Core {
public:
    Core(EngineProfile profile, std::vector<ComponentProfile> known_profiles, EngineSettings const& settings, Outbox& outbox,
         FreshSecret fresh_secret);

    void use(EngineSettings const& settings) {
        settings_ = with_changes(settings_, settings);
        for (auto* effort : {&effort_, &delivery_effort_}) effort->limit(settings_.max_condition_steps);
        events_.keep_for(settings_.event_details);
        errors_.keep_for(settings_.error_details);
    }
    void report_to(Trace& trace) { trace_ = &trace; }
    void keep_within(MemoryBudget& memory) { memory_ = &memory; }
    void add(std::unique_ptr<Component>);
    std::vector<std::string> change(ComponentChange, Instant now);
    ~Core();
    void add(std::shared_ptr<Device>, std::string const& provider, bool returns_at_once);
    void describe(Places places) { own_places_ = places_ = std::move(places); }

    void keep_in(Journal& journal) { recorder_.keep_in(journal); }
    void restore(StoredState, RightsOf const&, Instant now);
    EarlierSession earlier_session(std::string const& provider) const;
    void session_opened_there(std::string const& provider, SessionId const&);
    void stopped_there(std::string const& provider, std::optional<std::uint64_t> stop);
    void ended_there(std::string const& provider, std::vector<CommandEnded>, Instant now);
    void stored(Instant now);
    void not_stored(Instant now);
    void when_stored(std::function<void()> then);
    void flush() noexcept;
    void published(NotificationQueue& queue) { recorder_.notify(queue); }

    void on_report(std::function<void()> wake) { inbox_->on_arrival(std::move(wake)); }
    void handle(std::shared_ptr<Asked> const&, Instant now);
    void take(std::shared_ptr<Asked> const&, Instant now);
    void work(std::unique_lock<std::mutex>&, Instant now, Provider::Runner);
    void begin(Instant now);
    void tick(Instant now);

    Session* find(SessionId const&) const;
    Session* session_of(Asked const&) const;
    void end(SessionId const&, Instant now);
    void end_withdrawn(Instant now);
    void stop_everything(Instant now);
    void clear();
    void on_stop(std::function<void(bool is_stopped)> call) { on_stop_ = std::move(call); }
    bool everything_is_stopped() const { return everything_is_stopped_; }
    std::vector<std::string> not_halted() const;
    std::vector<std::string> not_ready() const;
    void shut_down(Instant now);
    void halt_everything(Instant now);
    std::shared_ptr<NotificationQueue> note_request(SessionId const&, Instant now, Rights const*);
    void note_pong(SessionId const&, Instant now);
    void link_opened(SessionId const&, LinkKind, Instant now);
    void link_closed(SessionId const&, LinkKind, Closing, Instant now);

    std::shared_ptr<EngineProfile const> profile() const;
    EngineProfile without_members() const;
    std::shared_ptr<EngineProfile const> profile_without_members() const;
    std::shared_ptr<EngineProfile const> profile_for_engines(bool with_members) const;
    std::shared_ptr<EngineProfile const> profile_seen_by(Rights const*, std::shared_ptr<EngineProfile const> const&) const;
    std::vector<ComponentEntry> components(Rights const*) const;
    EngineStatistics statistics() const;

private:
    // Components (components.cpp)
    using SharedComponent = std::shared_ptr<RegisteredComponent>;
    SharedComponent made(std::unique_ptr<Component>, std::vector<ComponentProfile> const& known);
    std::shared_ptr<Provider> provider(std::string const& name, Provider::Runs);
    void expect_providers(std::size_t most) {
        to_run_.expect(most);
        left_for_clock_.expect(most);
    }
    void enter(SharedComponent const&);
    void leave(SharedComponent const&, Instant now);
    void check(ComponentChange const&) const;
    using BelongingsOf = std::map<std::string, Belongings>;  // by provider
    static std::vector<ComponentProfile> profiles_of(BelongingsOf const&);
    Places places_of(BelongingsOf const&) const;
    static std::vector<std::string> add_space(Places&, BelongingsOf const&, std::string const& provider);
    // Frames and places without those of sub engines of which the client sees no component. Valid until the next change.
    Places const& places_seen_by(Rights const*) const;
    Space space(Rights const*) const;
    void note_profile_change(std::vector<std::shared_ptr<RegisteredComponent>> const& going,
                             std::vector<std::shared_ptr<RegisteredComponent>> const& coming, std::string const* whole_provider);
    void report_profile_change(Instant now);

    // Sessions of other engines (engine_sessions.cpp)
    void serve_engines(Instant now);
    void notify_of_states(Session&, Instant now);
    void notify_of_state(Session&, RegisteredComponent const&, Instant now);
    void forget_in_sessions_of_engines(RegisteredComponent const& gone, Instant now);

    // Sessions of logical components (own_sessions.cpp)
    Session& own_session(RegisteredComponent&, Instant now);
    void free_members(RegisteredComponent const&, Instant now);
    void notify_owners(RegisteredComponent const& member, Instant now);
    void perform(RegisteredComponent&, OperationAsked&&, Instant now);
    void call_owners(Instant now);
    void publish(RegisteredComponent const&, MemberSwitched&&);

    // System interface (system_interface.cpp)
    using SharedAsked = std::shared_ptr<Asked>;
    void connect(SharedAsked const&, Connect const&, Instant now);
    Session& open(std::unique_ptr<Session>, Instant now);
    Session& enter(std::unique_ptr<Session>);
    Reply perform(Session&, Connect const&, Instant now);
    Reply perform(Session&, Resume const&, Instant now);
    Reply perform(Session&, Disconnect const&, Instant now);
    Reply perform(Session&, GetProfile const&, Instant now);
    Reply perform(Session&, GetErrorDetail const&, Instant now);
    bool owns_present_stop(Session const&) const;
    bool present_stop_has_owners() const;
    static std::string owner_of(Session const&);
    bool follow_ended_owner(Session const&);
    Reply perform(Session&, StopEverything const&, Instant now);
    Reply perform(Session&, ClearStop const&, Instant now);

    // Command interface (command_interface.cpp)
    Reply perform(Session&, Search const&, Instant now);
    Reply perform(Session&, Release const&, Instant now);
    Reply perform(Session&, GetParameter const&, Instant now);
    Reply perform(Session&, GetCommandResult const&, Instant now);
    // These may have to ask components: nullopt means that the answer comes later.
    using Later = std::optional<Reply>;
    Later perform(Session&, Bind const&, SharedAsked const&, Instant now);
    Later perform(Session&, BindAny const&, SharedAsked const&, Instant now);
    Later perform(Session&, SetParameter const&, SharedAsked const&, Instant now);
    Later perform(Session&, Execute const&, SharedAsked const&, Instant now);
    struct ToBindNow {
        SharedComponent component;
        Binding as;
        std::shared_ptr<QueryExpression const> condition = {};  // of bind_any
    };
    Reply bind(Session&, ToBindNow const&, Instant now);
    void order_members(RegisteredComponent const& logical, Session const&);
    std::optional<std::string> take_over(Session const&, RegisteredComponent&, Instant now);
    Later bind_one(Session&, SharedAsked const&, ToBindNow const&, Steady until, Instant now);
    Later bind_first(Session&, SharedAsked const&, std::vector<ToBindNow> candidates, Steady until, Instant now);
    std::optional<Objection> why_not_now(Session const&, bool begins, bool lasts, std::size_t commands);
    template <class Op, class Then>
    Later prepare(Session&, SharedAsked const&, std::vector<Preparation>, Then, Instant now);

    // Query interface (query_interface.cpp)
    class Inquiry;
    Later perform(Session&, Query const&, SharedAsked const&, Instant now);
    static std::vector<Results> known_answer(Session const&, RegisteredComponent&, std::string const& query_type);

    // Answers an operation when the components that had to be asked have answered. `make` makes the reply, while the operation's
    // hold is in force, or asks again. Without the session, the operation is refused.
    void answer_later(SharedAsked const&, std::function<Later(Session&)> const& make);
    void answer(SharedAsked const&, Session const&, Reply&&);
    // The ref of the only component that the operation names, if the session sees it; otherwise empty.
    std::string_view component_named_by(Operation const&, Session const&) const;

    // The journal (journal/restoring.cpp)
    StoredEngine stored_engine() const;
    // Answers when the changes of the operation are stored, or cannot be stored now.
    void answer_when_stored(SharedAsked const&, Reply&&);
    void look_again(Asked const&, Reply&) const;
    // Runs the commands of a sequence when they are stored, or at once. `reply` is the answer when they are stored.
    enum class Runs : std::uint8_t { when_stored, at_once };
    Later run_when_stored(Session&, SharedAsked const&, CommandUnitSequence const&, std::vector<Preparation>, Reply, Runs,
                          Instant now);
    void restore(StoredSession&&, StoredState&, RightsOf const&, Instant now);
    void restore(Session&, StoredCommand&&, Instant now);
    bool restore(Session&, SubscribeId const&, Subscribe const&);
    void bind_absent(Session&, Instant now);
    void ask_to_bind(Session&, RegisteredComponent&, StoredBinding const&, Instant now);
    void take_answer(Session&, RegisteredComponent&, StoredBinding const&, std::optional<ComponentAnswer> const&, Instant now);
    void bind_again(Session&, RegisteredComponent&, StoredBinding const&, Instant now);
    void lose_absent(Session&, RegisteredComponent&, std::string const& why, Instant now);
    void ask_absent_again(Instant now);
    static bool forget_absent(Session&, std::string const& ref);  // returns whether a binding of this component waited
    void restore_absent(Instant now);

    // Event interface (event_interface.cpp)
    Reply perform(Session&, Subscribe const&, Instant now);
    std::optional<std::string> no_room_for(Session const&, Filter const&, bool shared);
    Reply perform(Session&, Unsubscribe const&, Instant now);
    Reply perform(Session&, GetEventDetail const&, Instant now);
    // Delivers to every receiver, even if one delivery throws. `deliveries` keeps the first exception.
    void publish(RegisteredComponent&, EventOccurred const&, Instant now, Attempts& deliveries);
    using SharedResults = std::shared_ptr<Results const>;
    // Returns whether a subscription matches the event (delivery.cpp).
    class Delivery;
    bool deliver(RegisteredComponent&, std::string const& event_type, SharedResults const&, Instant now, Attempts& deliveries);
    void deliver_or_keep(KeptEvents::Event, Instant now, Attempts& deliveries);
    void deliver_kept(std::string const& event_type, Instant now);
    // Delivers the events that only this session should have received, and has not read, to other sessions, or keeps them.
    void pass_on_unread(Session const&, Instant now);
    void publish(FoundError const&, Instant now, Attempts& deliveries);
    void tell(Session&, FoundError const&, Instant now);  // only this session
    ReceiveError noted(FoundError const&, Instant now);

    // Conditions (conditions.cpp)
    // The session pays for the comparisons during this turn.
    Effort::Turn turn_of(Session& session, Instant now) { return {effort_, session.effort, sessions_.size(), now.steady}; }
    // Compares on behalf of the session. nullopt: it has no steps left.
    template <class Compare>
    std::optional<bool> paid_by(Session& session, Instant now, Compare const& compare) {
        if (!effort_.has_left(session.effort, sessions_.size(), now.steady)) return {};
        auto const turn = turn_of(session, now);
        try {
            return compare();
        } catch (TooMuchEffort const&) {
            return {};
        }
    }
    // The answer to a request whose condition needs more steps than the session has now.
    template <class R>
    R too_much_effort();
    // The components and places that this session sees; null: all.
    Perspective perspective(Session const* asker, Perspective::Of of) const {
        return {registry_, places_, asker == nullptr ? places_ : places_seen_by(asker->rights.get()), asker, of};
    }
    Frames const& frames_seen_by(Session const& asker) const { return places_seen_by(asker.rights.get()).frames; }
    // The names that the asker may use: those of components that it sees.
    Vocabulary vocabulary(Session const& asker) const {
        auto const* rights = asker.rights.get();
        return {.places = &places_,
                .seen_places = &places_seen_by(rights),
                .parameters = &registry_.parameters(rights),
                .main_engine = profile_.object.name};
    }
    // The same, and the results of this message.
    Vocabulary vocabulary(Session const& asker, MessageKind kind, std::string_view message) const {
        auto with_results = vocabulary(asker);
        with_results.results = &registry_.results(kind, message, asker.rights.get());
        return with_results;
    }
    // Returns whether one of these components may ever match, now or after a change of its state.
    bool may_ever_match(Filter const&, ComponentsInOrder possible, Session const& asker) const;
    // Returns the components that match, in the order of the selection, or else by ref. A group condition selects components of
    // one robot: the one that the asker would get (engine/commands/preference.hpp).
    std::vector<RegisteredComponent*> select(Selection const&, Session const& asker) const;
    struct ToBind {
        std::vector<RegisteredComponent*> components;  // in order of preference
        // Set if a robot meets a group condition but cannot be used, because another session has bound this component of the
        // robot.
        RegisteredComponent const* held_of_group = nullptr;
    };
    // Returns the components that match. If the selection neither sorts nor has a group, stops at the first free component. A
    // group condition selects components of one robot, if the asker has bound or can bind all that the group asks for.
    ToBind select_to_bind(Selection const&, Session const& asker) const;
    // The members of a logical component in the order of the selection.
    std::vector<std::string> members_in_order(RegisteredComponent const&, Selection const&, Session const& asker) const;
    // Removes the results that do not match (decision 19). Returns why the condition is invalid, or nullopt.
    std::optional<std::string> choose(Results&, QueryExpression const&, Declarations const& known, std::string_view id,
                                      Session const& asker) const;
    // The reply to get_event_detail or get_error_detail. `kind` is "event" or "error".
    template <class R>
    R reply_with(Details::Answer const&, std::string_view kind, std::string const& id, QueryExpression const&,
                 Session const& asker) const;
    // Whether the asker may not learn the members of this logical component, and so not the text of its errors (docs/trust.md).
    bool hides_members(Session const& asker, std::string const& ref) const;
    // Sets the results of this reply. Returns why there are none, or nullopt.
    std::optional<std::string> choose_details(Results&, Details::Answer const&, std::string_view kind, std::string const& id,
                                              QueryExpression const&, Session const& asker) const;

    // Sessions (engine.cpp)
    void end(Session&, std::string_view why, Instant now);
    void remove(Session&, Instant now);
    void end_marked_sessions(Instant now, Attempts&);
    void mark_overflowed();
    static SessionStatistics statistics(Session const&);
    Session* longest_idle() const;
    void await_end_of_window(Session&, Steady not_before = Steady::min());
    void end_if_lost(SessionId const&, Instant now);
    // Handles the errors that the engine has found, and reports of components: as many as fit into a short time.
    void settle(Instant now);
    void handle_reports(Instant now, Attempts&);
    void handle(InboxEntry&, Instant now, Attempts& deliveries);
    void handle(RegisteredComponent&, CallFailed&, Instant now);
    bool has_reports() { return agenda_.front() != nullptr || !inbox_->empty(); }
    void save_memory(Instant now);
    void leave_for_clock(std::shared_ptr<Provider>);
    void advance_devices(Instant now);
    bool devices_go_on();
    void hold_unproven_motion(Instant now);
    void begin_stop_of_everything(Instant now);
    void report_stop_of_everything(Instant now);
    void forget_what_is_old(Instant now);
    void unbind(Session&, RegisteredComponent&, Instant now);
    void notify_of_release(RegisteredComponent&, Instant now);

    Trace no_trace_;
    Trace* trace_ = &no_trace_;                     // never null
    MemoryBudget* memory_ = &MemoryBudget::none();  // never null
    EngineSettings settings_;
    FreshSecret fresh_secret_;
    BelongingsOf belongings_;
    EngineProfile profile_;
    // The copies that callers share; null until the first call.
    mutable std::shared_ptr<EngineProfile const> shared_profile_;
    mutable std::shared_ptr<EngineProfile const> shared_profile_without_members_;
    void forget_shared() {
        shared_profile_.reset();
        shared_profile_without_members_.reset();
        places_seen_.clear();
    }
    Agenda agenda_;
    Places own_places_;
    Places places_;                                                   // the own ones, and those of all providers
    mutable std::map<std::vector<std::string>, Places> places_seen_;  // by the patterns of clients that do not see everything
    std::shared_ptr<Inbox> inbox_ = std::make_shared<Inbox>();
    ProvidersToRun to_run_;
    ProvidersToRun left_for_clock_;
    std::map<std::string, std::weak_ptr<Provider>> providers_;  // those with a name
    Registry registry_;
    struct DeviceState {
        std::shared_ptr<Device> device;
        std::shared_ptr<Provider> provider;
        std::atomic<bool> is_due = false;  // its advance waits, or has begun
        std::atomic<bool> goes_on = false;
        bool failed = false;  // at the last advance; only the provider reads it
    };
    std::vector<std::shared_ptr<DeviceState>> devices_;
    int turns_ = 0;  // of the devices in this tick
    Questions questions_;
    std::unordered_map<SessionId, std::unique_ptr<Session>, IdHash> sessions_;
    Recorder recorder_;
    Subscriptions subscriptions_;
    std::map<std::string, std::string> sessions_there_;  // of this engine in its sub engines, by provider
    std::map<std::string, std::uint64_t> stops_there_;   // StoredEngine::stops_there
    struct Undecided {
        std::string provider;
        std::shared_ptr<Command> command;
    };
    std::vector<Undecided> undecided_;  // commands from before a restart, whose ends the sub engines may know
    bool asks_absent_again_ = false;    // soon
    Deadlines deadlines_;
    Deadlines::Ticket last_due_ = Deadlines::first();  // of the deadlines that were carried out since the last tick
    Notifier notifier_;
    Effort effort_;
    Effort delivery_effort_;   // of events to subscriptions with a condition
    std::uint64_t event_ = 0;  // number of the event that is being delivered
    Executor executor_;
    Details events_;
    KeptEvents kept_events_;
    Details errors_;
    Steady details_checked_;
    Steady memory_saved_;
    std::vector<std::uint32_t> free_slots_;  // slots of ended sessions, to be reused (Details::Asker)
    std::optional<Steady> last_tick_;
    std::exception_ptr
        unsettled_;  // exception from `settle` after an operation; the next tick continues the work and rethrows it
    bool is_handled_again_ = false;  // the report whose handling failed in the last `settle`
    bool sessions_must_end_ = false;
    bool shutting_down_ = false;
    bool everything_is_stopped_ = false;
    bool halts_only_ = false;                // by halt_everything
    std::vector<std::string> ended_owners_;  // of the present stop (owner_of); they have not cleared it
    std::uint64_t last_stop_ = 0;            // a number that no other stop has, also not one before the engine was started
    std::function<void(bool)> on_stop_ = [](bool) {};
    std::optional<Steady> stop_reported_;    // when the sessions last received the error of a stop of everything
    bool stop_unreported_ = false;           // a later stop has not been reported yet: a tick will report it
    std::vector<Session*> engines_;          // sessions of other engines and of logical components
    std::uint64_t pushed_at_last_call_ = 0;  // of the owners: Notifier::pushed
    std::optional<Steady> profile_change_reported_;
    bool profile_change_unreported_ = false;
    std::set<std::string> changed_refs_;  // of the components that this change concerns
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

template <class R>
R Engine::Core::too_much_effort() {
    effort_.count_refusal();
    return refused<R>(ReturnCode::out_of_resources,
                      "the conditions of this session need too many comparisons; try again later, or with a simpler condition "
                      "(docs/conditions.md)");
}

template <class R>
R Engine::Core::reply_with(Details::Answer const& details, std::string_view kind, std::string const& id,
                           QueryExpression const& condition, Session const& asker) const {
    R reply;
    auto problem = choose_details(reply.results, details, kind, id, condition, asker);
    return problem ? refused<R>(ReturnCode::bad_parameter, *std::move(problem)) : reply;
}

}  // namespace rois
