#include "engine/world.hpp"

#include <algorithm>
#include <cstdlib>

namespace rois {

namespace {

struct InWords {
    std::string operator()(ReceiveEvent const& event) const {
        auto const words = event.event_type + " " + event.component_ref.code;
        return event.results ? words + " " + in_words(event.results->parameters) : words;
    }
    std::string operator()(ReceiveError const& error) const {
        return std::string{to_text(error.error_type)} + (error.component_ref ? " " + error.component_ref->code : "");
    }
    std::string operator()(Completed const& completed) const {
        return "completed " + completed.command_id.text + " " + std::string{to_text(completed.status)};
    }
    std::string operator()(Lost const& lost) const { return "lost " + std::to_string(lost.count); }
    std::string operator()(ProfileChanged const&) const { return "profile_changed"; }
    std::string operator()(ComponentChanged const& changed) const {
        return "component_changed " + changed.component_ref.code + " " + std::string{to_text(changed.status)};
    }
    std::string operator()(Switched const& switched) const {
        return "switched " + switched.component_ref.code + " from " + switched.from + " to " + switched.to;
    }
};

}  // namespace

Application::Application(World& world, SessionId s, Rights const* rights)
    : session{std::move(s)}, world_{&world}, notifications_{world.engine->notifications(session, rights)} {}

std::optional<Refusal> Application::refusal_of(Operation const& operation) {
    auto const said = world_->say(session, operation);
    auto const* refusal = std::get_if<Refusal>(&said);
    return refusal == nullptr ? std::nullopt : std::optional{*refusal};
}

std::string Application::bind_any(QueryExpression condition) {
    auto const reply = ask(BindAny{std::move(condition)});
    return reply.return_code == ReturnCode::ok ? reply.component_ref.code : std::string{to_text(reply.return_code)};
}

std::vector<std::string> Application::search(QueryExpression condition) {
    auto const reply = ask(Search{std::move(condition)});
    if (reply.return_code != ReturnCode::ok) return {std::string{to_text(reply.return_code)}};
    std::vector<std::string> refs;
    for (auto const& ref : reply.component_ref_list) refs.push_back(ref.code);
    return refs;
}

SetParameter::Reply Application::set_parameter(std::string const& ref, ParameterList parameters) {
    return ask(SetParameter{identifier(ref), std::move(parameters)});
}

std::string Application::result_of(std::string const& command_id, QueryExpression condition) {
    auto const reply = ask(GetCommandResult{{command_id}, std::move(condition)});
    if (reply.return_code != ReturnCode::ok) return std::string{to_text(reply.return_code)};
    auto results = reply.results.parameters;
    std::erase_if(results, [](Parameter const& each) { return each.name == "reason"; });
    return in_words(results);
}

std::string Application::reason_of(std::string const& command_id) {
    auto const reply = ask(GetCommandResult{{command_id}, {}});
    auto const* reason = find(reply.results.parameters, "reason");
    return reason == nullptr ? "" : reason->values.at(0);
}

std::string Application::status_of(std::string const& ref) {
    auto const reply = query("component_status", equal("component_ref", ref));
    if (reply.return_code != ReturnCode::ok) return std::string{to_text(reply.return_code)};
    return reply.results.parameters.front().values.front();
}

Query::Reply Application::query(std::string const& query_type, QueryExpression condition) {
    return ask(Query{query_type, std::move(condition)});
}

Subscribe::Reply Application::subscribe(std::string const& event_type, QueryExpression condition, bool inline_results) {
    return ask(Subscribe{event_type, std::move(condition), inline_results});
}

GetEventDetail::Reply Application::detail_of(EventId const& id, QueryExpression condition) {
    return ask(GetEventDetail{id, std::move(condition)});
}

GetErrorDetail::Reply Application::detail_of(ErrorId const& id, QueryExpression condition) {
    return ask(GetErrorDetail{id, std::move(condition)});
}

std::vector<std::string> Application::received(std::size_t most) {
    std::vector<std::string> words;
    for (auto const& [sequence, notification] : notifications_->read(after_, most)) {
        words.push_back(std::to_string(sequence) + " " + std::visit(InWords{}, notification->body));
        after_ = sequence;
        last_ = notification->body;
    }
    return words;
}

void Application::answered(NotificationQueue::Hold hold) { show_published(notifications_->release(hold)); }
void Application::answer_is_late(NotificationQueue::Hold hold) { show_published(notifications_->delay(hold)); }

void Application::show_published(bool some) {
    if (some) world_->engine->and_work([&] { world_->engine->published(*notifications_); }, world_->now);
}

World::World(std::vector<Part> const& parts, EngineSettings settings) {
    if (std::getenv("ROIS_TEST_JOURNAL") != nullptr) journal = std::make_unique<MemoryJournal>();
    restart(parts, settings);
}

void World::keep_journal() {
    if (journal) return;
    journal = std::make_unique<MemoryJournal>();
    engine->keep_in(*journal);
}

void World::restart(std::vector<Part> const& parts, EngineSettings settings) {
    components_.clear();
    stage_ = std::make_shared<Stage>();
    EngineProfile profile;
    profile.object = {
        .identifier = "urn:x-rois:def:HRIEngine:test", .code_space = {}, .name = "main", .description = {}, .meta_data = {}};
    for (auto const* name : {"crs", "instance", "speed"})
        profile.parameters.push_back({.name = name,
                                      .data_type_ref = Application::identifier("string"),
                                      .default_value = std::string{name} + "1",
                                      .description = {}});
    engine = std::make_unique<WorkingEngine>(std::move(profile), std::vector<ComponentProfile>{common}, settings, *this,
                                             [this] { return "secret-" + std::to_string(++secrets_); });
    for (auto const& part : parts) {
        auto component = std::make_unique<ScriptedComponent>(part, [this](auto what) { happen(std::move(what)); });
        components_.emplace(part.ref, component.get());
        engine->add(std::move(component));
    }
    engine->add(stage_);
    if (!journal) return;
    engine->keep_in(*journal);
    engine->restore(journal->take_state(), rights_of, now);
}

void World::change(std::vector<std::string> going, std::vector<Part> const& coming) {
    ComponentChange change{std::move(going), {}, {.profiles = {common}, .frames = {}, .places = {}}};
    std::map<std::string, ScriptedComponent*> added;
    for (auto const& part : coming) {
        auto component = std::make_unique<ScriptedComponent>(part, [this](auto what) { happen(std::move(what)); });
        added.emplace(part.ref, component.get());
        change.coming.push_back(std::move(component));
    }
    auto const gone = change.going;
    between(std::move(change), [this](ComponentChange all) { return engine->change(std::move(all), now); });
    for (auto const& ref : gone) components_.erase(ref);
    components_.merge(added);
}

void World::forget(std::string const& ref) { components_.erase(ref); }

Application World::connect(Connect const& connection) {
    auto application = connect_without_link(connection);
    engine->link_opened(application.session, LinkKind::websocket, now);
    return application;
}

Application World::connect_without_link(Connect const& connection) {
    auto const said = say({}, connection);
    return {*this, std::get<Connect::Reply>(std::get<Reply>(said)).session};
}

Application World::connect_as(std::shared_ptr<Rights const> rights, Connect const& connection) {
    auto const asked = engine->begin_to_handle({}, connection, now, rights);
    Application application{*this, std::get<Connect::Reply>(std::get<Reply>(asked->said.value())).session, rights.get()};
    rights_.emplace(application.session, std::move(rights));
    engine->link_opened(application.session, LinkKind::websocket, now);
    return application;
}

void World::advance(std::chrono::milliseconds duration) {
    constexpr std::chrono::milliseconds step{50};
    while (duration.count() > 0) {
        auto const passed = std::min(duration, step);
        now = now + passed;
        duration -= passed;
        engine->tick(now);
    }
}

// The scripted components notice what the test has changed.
void World::let_look() {
    bool const changed = std::ranges::any_of(components_, [](auto const& each) { return each.second->has_changed(); });
    if (changed) happen([] {});
}

void World::happen(std::function<void()> what) {
    stage_->put(std::move(what));
    engine->tick(now);
}

CommandUnit command(std::string command_type, std::string const& ref, ParameterList arguments) {
    return {.delay_time = {},
            .unit = CommandMessage{.component_ref = Application::identifier(ref),
                                   .command_type = std::move(command_type),
                                   .command_id = {},
                                   .arguments = std::move(arguments)}};
}

CommandUnit go(std::string const& id, std::string const& ref) {
    return named(id, start(ref, {texts("target_position", {"1000, 0, 90"})}));
}

CommandUnit say(std::string const& id, std::string const& ref) { return named(id, start(ref, {text("speech_text", "hello")})); }

CommandUnit named(std::string id, CommandUnit unit) {
    std::get<CommandMessage>(unit.unit).command_id.text = std::move(id);
    return unit;
}

CommandUnit after(std::chrono::milliseconds delay, CommandUnit unit) {
    unit.delay_time = delay.count();
    return unit;
}

CommandUnit pause(std::chrono::milliseconds delay) { return {.delay_time = delay.count(), .unit = DelayOnly{}}; }
CommandUnit in_sequence(std::vector<CommandUnit> units) {
    return {.delay_time = {}, .unit = SequentialCommandUnit{std::move(units)}};
}
CommandUnit in_parallel(std::vector<CommandUnit> units) {
    return {.delay_time = {}, .unit = ParallelCommandUnit{std::move(units)}};
}

CommandUnit branches(std::vector<std::vector<CommandUnit>> lists) {
    ConcurrentCommands concurrent;
    for (auto& list : lists) concurrent.branches.push_back({std::move(list)});
    return {.delay_time = {}, .unit = std::move(concurrent)};
}

CommandUnit flat(std::vector<CommandUnit> commands) {
    ConcurrentCommands concurrent;
    concurrent.form = ConcurrentCommands::Form::command_list;
    for (auto& unit : commands) concurrent.branches.push_back({{std::move(unit)}});
    return {.delay_time = {}, .unit = std::move(concurrent)};
}

std::vector<std::string> ids_of(std::vector<CommandUnit> const& units) {
    struct Collector {
        std::vector<std::string> ids;
        void in(std::vector<CommandUnit> const& list) {
            for (auto const& unit : list) std::visit(*this, unit.unit);
        }
        void operator()(DelayOnly const&) {}
        void operator()(CommandMessage const& message) { ids.push_back(message.command_id.text); }
        void operator()(ConcurrentCommands const& concurrent) {
            for (auto const& branch : concurrent.branches) in(branch.command_list);
        }
        void operator()(SequentialCommandUnit const& unit) { in(unit.command_unit_list); }
        void operator()(ParallelCommandUnit const& unit) { in(unit.command_unit_list); }
    };
    Collector collector;
    collector.in(units);
    return collector.ids;
}

Condition equal(std::string path, std::string literal) {
    return {PropertyComparison{Comparator::equal, {ValueReference{std::move(path)}}, {Literal{std::move(literal)}}}};
}

Condition equal_reversed(std::string literal, std::string path) {
    return {PropertyComparison{Comparator::equal, {Literal{std::move(literal)}}, {ValueReference{std::move(path)}}}};
}

Condition alike(std::string path, std::string literal) {
    return {PropertyComparison{Comparator::equal, {ValueReference{std::move(path)}}, {Literal{std::move(literal)}}, false}};
}

Condition both(std::vector<Condition> operands) { return {And{std::move(operands)}}; }
Condition either(std::vector<Condition> operands) { return {Or{std::move(operands)}}; }
Condition not_understood(std::string reason) { return {NotUnderstood{std::move(reason)}}; }

Parameter value(std::string name, std::string type, std::vector<std::string> values) {
    return {.name = std::move(name),
            .data_type_ref = {.code = std::move(type), .authority = {}, .codebook_ref = {}, .version = {}},
            .values = std::move(values)};
}

std::string in_words(ParameterList const& parameters) {
    std::string words;
    for (auto const& parameter : parameters) {
        if (!words.empty()) words += " ";
        if (parameter.name != "status") words += parameter.name + "=";
        for (auto const& item : parameter.values) words += (&item == &parameter.values.front() ? "" : "|") + item;
    }
    return words;
}

}  // namespace rois
