// The commands subscribe, watch and record.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "command/context.hpp"
#include "command/http.hpp"
#include "command/sequences.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois::command {

namespace {

bool is_event(Context& context, std::string const& type) {
    auto const known = message_names(context.components(), MessageKind::event);
    return std::ranges::find(known, type) != known.end();
}

void check_known(Context& context, std::vector<std::string> const& wanted, std::vector<std::string> const& known) {
    for (auto const& type : wanted)
        if (std::ranges::find(known, type) == known.end())
            context.refuse<Subscribe>(ReturnCode::unsupported,
                                      "no component has an event " + rois::quoted(type) + "; there are " + listed(known));
}

// Binds and starts the components of --start.
void start_components(Context& context) {
    auto const& starts = context.options().starts;
    if (starts.empty()) return;
    CommandUnitSequence sequence;
    for (auto const& ref : starts) {
        Identifier const component{ref, {}, {}, {}};
        context.bound(component);
        sequence.command_unit_list.push_back({{}, CommandMessage{component, "start", fresh_command_id(), {}}});
    }
    context.ok(Execute{std::move(sequence)});
}

// Subscribes to these event types, or to all of the engine's components if none is given, with inline results.
std::vector<SubscribeId> subscribe_to(Context& context, std::vector<std::string> const& event_types,
                                      QueryExpression const& condition) {
    auto const known = message_names(context.ok(GetProfile{}).components, MessageKind::event);
    check_known(context, event_types, known);
    bool const all = event_types.empty();
    std::vector<SubscribeId> ids;
    for (auto const& type : all ? known : event_types) {
        // The condition may name results that only some events have. Without EVENT, skips the events that do not have them.
        auto answer = context.session().request(Subscribe{type, condition, true});
        auto const* const reply = std::get_if<Reply>(&answer);
        auto const* const subscribed = reply != nullptr ? std::get_if<Subscribe::Reply>(reply) : nullptr;
        bool const ok = subscribed != nullptr && subscribed->return_code == ReturnCode::ok;
        if (ok) ids.push_back(subscribed->subscribe_id);
        if (!ok && !all) context.ok(Subscribe{type, condition, true});
    }
    if (ids.empty()) context.refuse<Subscribe>(ReturnCode::unsupported, "no event can meet the condition");
    return ids;
}

// Selects the updates of a command. In a shared session, the command also receives older notifications and events of other
// subscriptions.
struct Wanted {
    std::uint64_t after = 0;                           // only notifications after this sequence
    std::optional<std::vector<SubscribeId>> events{};  // only events of these subscriptions; empty: all

    bool operator()(Update const&) const;
};

bool Wanted::operator()(Update const& update) const {
    auto const* const news = std::get_if<News>(&update);
    if (news == nullptr) return true;
    auto const* const event = std::get_if<ReceiveEvent>(&news->notification);
    bool const is_chosen = event == nullptr || !events || std::ranges::find(*events, event->subscribe_id) != events->end();
    return news->sequence > after && is_chosen;
}

bool is_new_session(Update const& update) {
    auto const* const gap = std::get_if<Gap>(&update);
    return gap != nullptr && gap->why == Gap::Why::new_session;
}

// Starts the components of --start again in a new session. Retries if the link is lost meanwhile.
class Restarting {
public:
    explicit Restarting(Context& context) : context_{context} {}

    void take(Update const& update) {
        auto const* const change = std::get_if<StateChange>(&update);
        bool const there = change != nullptr && (change->state == State::open || change->state == State::resumed);
        due_ = due_ || is_new_session(update);
        if (!due_ || (!there && !is_new_session(update))) return;
        try {
            start_components(context_);
            due_ = false;
        } catch (Trouble const& trouble) {
            if (trouble.exit() != Exit::no_answer && trouble.exit() != Exit::interrupted) throw;
        }
    }

private:
    Context& context_;
    bool due_ = false;
};

void show(Printer& printer, Update const& update) {
    if (auto const* const news = std::get_if<News>(&update)) return printer.notification(news->notification, news->sequence);
    if (auto const* const change = std::get_if<StateChange>(&update)) return printer.state(*change);
    printer.gap(std::get<Gap>(update));
}

// Ends the time of --for: throws Trouble if --count asked for more events, and remarks if none arrived.
void end_in_time(Options const& options, std::size_t events) {
    if (options.count)
        throw Trouble{Exit::timeout, "only " + std::to_string(events) + " of " + std::to_string(*options.count) +
                                         " events arrived within the time of --for"};
    if (events == 0) remark("no event arrived within the time of --for");
}

// Returns the sequence of the last notification of the shared session; 0 if there is none.
std::uint64_t last_sequence(Context& context) {
    auto const& options = context.options();
    for (std::uint64_t last = 0;;) {
        auto const answer = http_get(server_of(options), "/rois/notifications?after=" + std::to_string(last) + "&wait=0",
                                     options.deadline, options.session);
        pugi::xml_document notifications;
        if (answer.status != 200 || !notifications.load_string(answer.body.c_str()))
            throw Trouble{Exit::no_answer, options.url + ": the notifications of the session cannot be read (HTTP status " +
                                               std::to_string(answer.status) + ")"};
        auto const newest = notifications.document_element().last_child().attribute("sequence").as_ullong();
        if (newest <= last) return last;
        last = newest;
    }
}

// Calls `subscribe`. In a shared session, selects later notifications, and only events of these subscriptions.
Wanted wanted_by(Context& context, std::function<std::vector<SubscribeId>()> const& subscribe) {
    if (!context.session().is_joined()) return subscribe(), Wanted{};
    Wanted wanted{.after = last_sequence(context)};
    wanted.events = subscribe();
    return wanted;
}

// Whether --count counts this notification.
bool counts(Options const& options, Notification const& notification) {
    return std::holds_alternative<ReceiveEvent>(notification) ||
           (std::holds_alternative<Switched>(notification) && watches_switches(options));
}

// Calls `handle` with each wanted update until --count events have arrived, --for is over, or a signal arrives. Throws Trouble if
// the connection closes.
void listen(Context& context, std::function<void(Update const&)> const& handle, Wanted const& wanted = {}) {
    auto& session = context.session();
    auto const& options = context.options();
    auto const until = end_of(options);
    std::size_t events = 0;
    Restarting restarting{context};
    context.keep_recording();
    while (!options.count || events < *options.count) {
        auto const update = session.next_update(until);
        if (session.interrupted()) return;
        if (!update && until && std::chrono::steady_clock::now() >= *until) return end_in_time(options, events);
        if (!update) throw Trouble{Exit::no_answer, "the connection has closed"};
        if (!wanted(*update)) continue;
        auto const* const news = std::get_if<News>(&*update);
        if (news != nullptr && counts(options, news->notification)) ++events;
        handle(*update);
        if (news != nullptr && std::holds_alternative<ReceiveError>(news->notification))
            explain(context, std::get<ReceiveError>(news->notification));
        restarting.take(*update);
    }
}

}  // namespace

void subscribe(Context& context) {
    auto const& options = context.options();
    auto const wanted = wanted_by(context, [&] {
        auto const reply = context.ok(Subscribe{options.name, context.condition(), true}, [&]() -> std::string {
            auto const known = message_names(context.components(), MessageKind::event);
            return std::ranges::find(known, options.name) == known.end() ? "; there are the events " + listed(known) : "";
        });
        context.printer().reply(reply, "subscribe");
        return std::vector{reply.subscribe_id};
    });
    if (context.session().is_joined() && !options.count && !options.span) return;
    listen(
        context,
        [&](Update const& update) {
            auto const* const change = std::get_if<StateChange>(&update);
            bool const usual = change != nullptr && (change->state == State::open || change->state == State::connecting);
            if (!usual) show(context.printer(), update);
        },
        wanted);
}

void watch(Context& context) {
    auto const& options = context.options();
    auto event_types = options.words;
    // A component may have an event of this name, too.
    std::erase_if(event_types, [&](auto const& type) { return type == switches && !is_event(context, type); });
    bool const only_switches = event_types.empty() && !options.words.empty();
    bool const is_chosen = !options.words.empty() || !options.where.empty() || !options.condition_file.empty();
    Wanted wanted;
    if (is_chosen || !context.session().is_joined())
        wanted = wanted_by(context, [&] {
            return only_switches ? std::vector<SubscribeId>{} : subscribe_to(context, event_types, context.condition());
        });
    start_components(context);
    listen(
        context, [&](Update const& update) { show(context.printer(), update); }, wanted);
}

void record(Context& context) {
    if (!context.options().listen.empty()) return record_others(context);
    subscribe_to(context, context.options().words, {});
    start_components(context);
    listen(context, [&](Update const& update) {
        context.recorded()->check();
        show(context.printer(), update);
    });
}

}  // namespace rois::command
