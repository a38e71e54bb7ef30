#include "psm/session.hpp"

#include <algorithm>
#include <cstdlib>
#include <ranges>
#include <utility>

#include "psm/documents.hpp"
#include "rois/psm/alive.hpp"
#include "rois/psm/reason.hpp"
#include "types/text/texts.hpp"

namespace rois::psm {

using RoIS_HRI::ReturnCode_t;

namespace {

thread_local std::string last_reason;

constexpr std::chrono::seconds farewell{2};  // how long disconnect waits for a gateway that does not answer

static_assert(static_cast<ReturnCode_t>(ReturnCode::timeout) == RoIS_HRI::TIMEOUT);

Settings settings_of_environment() {
    Settings settings;  // its URL comes from ROIS_URL
    if (auto const* const token = std::getenv("ROIS_TOKEN")) settings.token = token;
    return settings;
}

// Returns whether the fault is an error in the application's document.
bool is_about_the_document(FaultCode code) {
    return code == FaultCode::not_well_formed || code == FaultCode::forbidden_xml || code == FaultCode::invalid ||
           code == FaultCode::too_large;
}

bool is_connected(Client const& client) { return client.state() == State::open || client.state() == State::resumed; }

std::string last_part(std::string const& urn) {
    auto const colons = urn.rfind("::");
    return colons == urn.npos ? urn : urn.substr(colons + 2);
}

void for_each_command(std::vector<CommandUnit> const& units, auto const& function) {
    for (auto const& unit : units) {
        if (auto const* const command = std::get_if<CommandMessage>(&unit.unit)) function(*command);
        if (auto const* const inner = std::get_if<SequentialCommandUnit>(&unit.unit))
            for_each_command(inner->command_unit_list, function);
        if (auto const* const inner = std::get_if<ParallelCommandUnit>(&unit.unit))
            for_each_command(inner->command_unit_list, function);
        if (auto const* const inner = std::get_if<ConcurrentCommands>(&unit.unit))
            for (auto const& branch : inner->branches) for_each_command(branch.command_list, function);
    }
}

}  // namespace

std::string reason() { return last_reason; }

void set_reason(std::string text) { last_reason = std::move(text); }

std::string condition_on_type(std::string const& type) {
    return "<fes:Filter><fes:PropertyIsEqualTo><fes:ValueReference>component_type</fes:ValueReference>"
           "<fes:Literal>urn:x-rois:def:component:OMG::" +
           type + "</fes:Literal></fes:PropertyIsEqualTo></fes:Filter>";
}

Session& Session::instance() {
    static Session session;
    return session;
}

// Ends the connection before the members that its observers use.
Session::~Session() {
    std::shared_ptr<Client> leaving;
    {
        std::lock_guard const lock{mutex_};
        applications_.clear();
        events_.clear();
        leaving = std::exchange(client_, {});
    }
    leaving.reset();
}

// --- Connecting ---

std::shared_ptr<Client> Session::client() const {
    std::lock_guard const lock{mutex_};
    return client_;
}

std::shared_ptr<Client> Session::ready_client() {
    auto client = this->client();
    if (!client) {
        set_reason("not connected: SystemIF::connect has not been called, or has failed");
        return client;
    }
    activate(client);
    return client;
}

ReturnCode_t Session::connect() try {
    std::lock_guard const one{connecting_};
    set_reason({});
    auto const present = client();
    if (present && present->state() != State::closed) {
        activate(present);
        return RoIS_HRI::OK;
    }
    auto const fresh = std::make_shared<Client>(settings_of_environment(), observers());
    auto const problem = fresh->wait(fresh->opened());
    if (problem) {
        set_reason("connect: " + problem->reason);
        return RoIS_HRI::ERROR;
    }
    {
        std::lock_guard const lock{mutex_};
        client_ = fresh;
        bound_.clear();
        subscriptions_.clear();
        running_.clear();
        last_command_ = 0;
        application_gives_signs_ = false;
        new_.insert(events_.begin(), events_.end());
    }
    delivery_.begin_signs(
        [this] {
            if (!application_gives_signs_) give_sign_of_life();
        },
        fresh->between_signs_of_life());
    activate(fresh);
    return RoIS_HRI::OK;
} catch (std::exception const& problem) {
    set_reason("connect: " + std::string{problem.what()});
    return RoIS_HRI::ERROR;
}

ReturnCode_t Session::disconnect() try {
    std::lock_guard const one{connecting_};
    set_reason({});
    auto leaving = ready_client();
    if (!leaving) return RoIS_HRI::ERROR;
    auto const answer = leaving->wait(leaving->request({Disconnect{}, {}}, farewell));
    auto const code = failed(answer, *leaving);
    {
        std::lock_guard const lock{mutex_};
        client_.reset();
        bound_.clear();
    }
    auto const why = reason();
    leaving.reset();
    abort_commands();  // the engine can no longer report their ends
    delivery_.drain();
    set_reason(why);
    std::lock_guard const lock{mutex_};
    subscriptions_.clear();
    return code;
} catch (std::exception const& problem) {
    set_reason("disconnect: " + std::string{problem.what()});
    return RoIS_HRI::ERROR;
}

// Holds the lock, so that this thread cannot own the last reference to a client.
void Session::give_sign_of_life() const {
    std::lock_guard const lock{mutex_};
    if (client_) client_->alive();
}

void Session::alive() {
    application_gives_signs_ = true;
    give_sign_of_life();
}

void alive() { Session::instance().alive(); }

// Registers new receivers and subscribes for them. Subscriptions that fail, as without a component, are retried by connect().
void Session::activate(std::shared_ptr<Client> const& client) {
    std::vector<std::pair<std::string, std::string>> wanted;
    {
        std::lock_guard const lock{mutex_};
        if (new_.empty()) return;
        for (auto const* const event : events_) {
            if (!new_.contains(event)) continue;
            for (auto const& type : event->event_types()) wanted.emplace_back(type, condition_on_type(event->component_type()));
        }
        for (auto const receiver : std::exchange(new_, {})) delivery_.begin(receiver);
    }
    auto const before = reason();
    for (auto const& [type, condition] : wanted) {
        std::string id;
        subscribe_on(client, type, condition, &Subscription::by_receivers, id);
    }
    set_reason(before);
}

ReturnCode_t Session::failed(Answer const& answer, Client const& client) const {
    if (auto const* const reply = std::get_if<Reply>(&answer)) {
        auto const& outcome = std::visit([](auto const& each) -> Outcome const& { return each; }, *reply);
        set_reason(outcome.reason);
        return static_cast<ReturnCode_t>(outcome.return_code);
    }
    if (auto const* const fault = std::get_if<Fault>(&answer)) {
        set_reason(std::string{to_text(fault->code)} + ": " + fault->reason);
        return is_about_the_document(fault->code) ? RoIS_HRI::BAD_PARAMETER : RoIS_HRI::ERROR;
    }
    auto const& none = std::get<NoAnswer>(answer);
    set_reason(none.reason);
    return none.why == NoAnswer::Why::deadline && is_connected(client) ? RoIS_HRI::TIMEOUT : RoIS_HRI::ERROR;
}

// --- Operations with the application's XML ---

Task<Answer> Session::exchange(std::shared_ptr<Client> client, std::string document, std::string& response,
                               std::function<void(Reply const&)> note) {
    auto given = co_await client->send(std::move(document));
    if (auto* const none = std::get_if<NoAnswer>(&given)) co_return Answer{std::move(*none)};
    response = std::get<std::string>(std::move(given));
    auto received = xml::AnswerReader{}.read(response);
    if (auto* const fault = received ? std::get_if<Fault>(&*received) : nullptr) co_return Answer{std::move(*fault)};
    if (auto* const answered = received ? std::get_if<xml::Answered>(&*received) : nullptr) {
        auto const ok = std::visit([](auto const& each) { return each.return_code == rois::ReturnCode::ok; }, answered->reply);
        if (ok) note(answered->reply);
        co_return Answer{std::move(answered->reply)};
    }
    NoAnswer odd{NoAnswer::Why::not_understood, "the gateway's answer is not a RoIS message of this operation"};
    co_return Answer{std::move(odd)};
}

ReturnCode_t Session::send_on(std::shared_ptr<Client> const& client, std::string_view xml, std::string document,
                              std::string& response, std::function<void(Reply const&)> note) const {
    if (auto problem = problem_with(xml)) {
        set_reason(*std::move(problem));
        return RoIS_HRI::BAD_PARAMETER;
    }
    return failed(client->wait(exchange(client, std::move(document), response, std::move(note))), *client);
}

ReturnCode_t Session::execute(std::string_view sequence) try {
    set_reason({});
    auto const own = ready_client();
    if (!own) return RoIS_HRI::ERROR;
    std::string response;
    return send_on(own, sequence, request_with_sequence(sequence), response, [this](Reply const& reply) {
        std::lock_guard const lock{mutex_};
        for_each_command(std::get<Execute::Reply>(reply).command_unit_list.command_unit_list,
                         [&](CommandMessage const& command) { running_.insert(command.command_id.text); });
    });
} catch (std::exception const& problem) {
    set_reason(problem.what());
    return RoIS_HRI::ERROR;
}

// --- Bindings ---

// Asks for the type of a bound component, once.
void Session::note_bound(std::shared_ptr<Client> const& client, std::string const& ref) {
    auto const answer = client->wait(client->request({GetProfile{conditions::component_ref == ref}, {}}));
    std::string type;
    if (auto const* const reply = std::get_if<Reply>(&answer)) {
        for (auto const& component : std::get<GetProfile::Reply>(*reply).components)
            if (component.ref == ref) type = last_part(component.type);
    }
    std::lock_guard const lock{mutex_};
    std::erase_if(bound_, [&](Bound const& each) { return each.ref == ref; });
    bound_.push_back({ref, std::move(type)});
}

ReturnCode_t Session::bind(std::string ref) {
    auto const code = call(Bind{identifier_of(ref)});
    if (code == RoIS_HRI::OK)
        if (auto const own = client()) note_bound(own, ref);
    return code;
}

ReturnCode_t Session::bind_any(std::string_view condition, std::string& ref) {
    std::string bound;
    auto const code =
        send<BindAny::Reply>(condition, request_with_condition("bind_any", {}, condition),
                             [&](BindAny::Reply const& reply, std::string const&) { bound = reply.component_ref.code; });
    if (code != RoIS_HRI::OK) return code;
    ref = bound;
    return bind(std::move(bound));  // so that the client binds it again in a new session
}

ReturnCode_t Session::release(std::string ref) {
    auto const code = call(Release{identifier_of(ref)});
    std::lock_guard const lock{mutex_};
    if (code == RoIS_HRI::OK) std::erase_if(bound_, [&](Bound const& each) { return each.ref == ref; });
    return code;
}

std::optional<std::string> Session::bound_of(std::string const& type) const {
    for (auto const& each : std::views::reverse(bound_))
        if (type.empty() || equal_ignoring_case(each.type, type)) return each.ref;
    return std::nullopt;
}

Session::Meant Session::component_of(std::string const& type, bool bind) {
    {
        std::lock_guard const lock{mutex_};
        if (auto const ref = bound_of(type)) return {RoIS_HRI::OK, *ref};
    }
    if (type.empty()) {
        set_reason("no component is bound: call CommandIF::bind or bind_any first");
        return {RoIS_HRI::ERROR, {}};
    }
    Meant meant;
    if (bind) meant.code = bind_any(condition_on_type(type), meant.ref);
    return meant;
}

// --- Components ---

CommandUnitSequence Session::one_command(std::string const& ref, std::string const& command_type, ParameterList arguments,
                                         CommandId& id) {
    {
        std::lock_guard const lock{mutex_};
        id.text = ref + "." + command_type + "." + std::to_string(++last_command_);
        running_.insert(id.text);
    }
    CommandUnitSequence sequence;
    sequence.command_unit_list.emplace_back().unit = CommandMessage{identifier_of(ref), command_type, id, std::move(arguments)};
    return sequence;
}

ReturnCode_t Session::run(std::string const& component_type, std::string command_type, ParameterList arguments) try {
    set_reason({});
    if (!ready_client()) return RoIS_HRI::ERROR;
    auto const meant = component_of(component_type, true);
    if (meant.code != RoIS_HRI::OK) return meant.code;
    CommandId id;
    auto const code = call(Execute{one_command(meant.ref, command_type, std::move(arguments), id)});
    std::lock_guard const lock{mutex_};
    if (code != RoIS_HRI::OK) running_.erase(id.text);
    return code;
} catch (std::exception const& problem) {
    set_reason(problem.what());
    return RoIS_HRI::ERROR;
}

ReturnCode_t Session::run_to_the_end(std::string const& component_type, std::string command_type, ParameterList arguments,
                                     EventResults& results) try {
    set_reason({});
    auto const own = ready_client();
    if (!own) return RoIS_HRI::ERROR;
    auto const meant = component_of(component_type, true);
    if (meant.code != RoIS_HRI::OK) return meant.code;
    CommandId id;
    auto sequence = one_command(meant.ref, command_type, std::move(arguments), id);
    auto const commands = own->wait(own->execute(std::move(sequence)));
    auto const status = own->wait(commands.front().completed());
    if (status != CompletedStatus::ok) {
        set_reason(command_type + " of " + meant.ref + " completed with " + std::string{to_text(status)});
        if (status == CompletedStatus::out_of_resources) return RoIS_HRI::OUT_OF_RESOURCES;
        return status == CompletedStatus::timeout ? RoIS_HRI::TIMEOUT : RoIS_HRI::ERROR;
    }
    results = EventResults{own->wait(commands.front().results()).parameters};
    return RoIS_HRI::OK;
} catch (Error const& refused) {
    set_reason(refused.what());
    return static_cast<ReturnCode_t>(refused.code());
} catch (std::exception const& problem) {
    set_reason(problem.what());
    return RoIS_HRI::ERROR;
}

ReturnCode_t Session::query(std::string const& component_type, std::string query_type, std::optional<Condition> more,
                            EventResults& results) try {
    set_reason({});
    if (!ready_client()) return RoIS_HRI::ERROR;
    auto const meant = component_of(component_type, false);
    if (meant.code != RoIS_HRI::OK) return meant.code;
    auto condition = meant.ref.empty() ? conditions::type == component_type : conditions::component_ref == meant.ref;
    if (more) condition = std::move(condition) && *std::move(more);
    return call(Query{std::move(query_type), std::move(condition)},
                [&](Query::Reply const& reply) { results = EventResults{reply.results.parameters}; });
} catch (std::exception const& problem) {
    set_reason(problem.what());
    return RoIS_HRI::ERROR;
}

// --- Subscriptions ---

ReturnCode_t Session::subscribe(std::string const& event_type, std::string const& condition, std::string& id) try {
    set_reason({});
    auto const own = ready_client();
    return own ? subscribe_on(own, event_type, condition, &Subscription::by_application, id) : RoIS_HRI::ERROR;
} catch (std::exception const& problem) {
    set_reason(problem.what());
    return RoIS_HRI::ERROR;
}

// Always asks for inline results, so that the application and an Event object can share one subscription of the engine.
ReturnCode_t Session::subscribe_on(std::shared_ptr<Client> const& client, std::string const& event_type,
                                   std::string const& condition, bool Subscription::*by, std::string& id) {
    std::string response;
    auto document = request_with_condition("subscribe", {{"event_type", event_type}}, condition);
    return send_on(client, condition, std::move(document), response, [&](Reply const& reply) {
        auto const& engine_id = std::get<Subscribe::Reply>(reply).subscribe_id.text;
        std::lock_guard const lock{mutex_};
        auto const known =
            std::ranges::find_if(subscriptions_, [&](auto const& each) { return each.second.engine_id == engine_id; });
        id = known != subscriptions_.end() ? known->first : engine_id;
        auto& subscription = subscriptions_[id];
        subscription.event_type = event_type;
        subscription.condition = condition;
        subscription.engine_id = engine_id;
        subscription.*by = true;
    });
}

ReturnCode_t Session::unsubscribe(std::string const& id) {
    auto engine_id = id;
    {
        std::lock_guard const lock{mutex_};
        auto const known = subscriptions_.find(id);
        if (known != subscriptions_.end()) {
            known->second.by_application = false;
            engine_id = known->second.engine_id;
            if (known->second.by_receivers) {
                set_reason({});
                return RoIS_HRI::OK;
            }
        }
    }
    return call(Unsubscribe{{engine_id}}, [&](Unsubscribe::Reply const&) {
        std::lock_guard const lock{mutex_};
        subscriptions_.erase(id);
    });
}

// Repeats the subscriptions in a new session of the engine.
void Session::subscribe_again() {
    auto const own = client();
    if (!own) return;
    std::map<std::string, Subscription> old;
    {
        std::lock_guard const lock{mutex_};
        old = subscriptions_;
    }
    for (auto const& [id, subscription] : old) {
        std::string response;
        auto document = request_with_condition("subscribe", {{"event_type", subscription.event_type}}, subscription.condition);
        auto const note_id = [&](std::string engine_id) {
            std::lock_guard const lock{mutex_};
            auto const known = subscriptions_.find(id);
            if (known != subscriptions_.end()) known->second.engine_id = std::move(engine_id);
        };
        auto const code = send_on(own, subscription.condition, std::move(document), response,
                                  [&](Reply const& reply) { note_id(std::get<Subscribe::Reply>(reply).subscribe_id.text); });
        if (code != RoIS_HRI::OK) note_id({});
    }
}

}  // namespace rois::psm
