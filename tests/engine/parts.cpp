#include "engine/parts.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace rois {

namespace {

std::string urn(std::string const& name) { return "urn:x-rois:def:component:OMG::" + name; }

ParameterProfile parameter(std::string name, std::string type, std::optional<std::string> default_value = {}) {
    return {.name = std::move(name),
            .data_type_ref = {.code = std::move(type), .authority = {}, .codebook_ref = {}, .version = {}},
            .default_value = std::move(default_value),
            .description = {}};
}

using Parameters = std::vector<ParameterProfile>;

MessageProfile command(std::string name, Parameters arguments = {}, Parameters results = {},
                       std::optional<std::chrono::milliseconds> timeout = {}) {
    return {.kind = MessageKind::command,
            .name = std::move(name),
            .results = std::move(results),
            .arguments = std::move(arguments),
            .timeout = timeout};
}

MessageProfile query(std::string name, Parameters results) {
    return {.kind = MessageKind::query, .name = std::move(name), .results = std::move(results), .arguments = {}, .timeout = {}};
}

MessageProfile event(std::string name, Parameters results) {
    return {.kind = MessageKind::event, .name = std::move(name), .results = std::move(results), .arguments = {}, .timeout = {}};
}

ComponentProfile profile(std::string const& name, std::vector<MessageProfile> messages, Parameters parameters = {}) {
    return {
        .object = {.identifier = urn(name), .code_space = "urn:ietf:rfc:2141", .name = name, .description = {}, .meta_data = {}},
        .sub_components = {urn("RoISCommon")},
        .messages = std::move(messages),
        .parameters = std::move(parameters)};
}

ComponentProfile common_profile() {
    auto whole = profile("RoISCommon", {command("start"), command("stop"), command("suspend"), command("resume"),
                                        query("component_status", {parameter("status", "Component_Status")})});
    whole.sub_components.clear();
    return whole;
}

ComponentProfile navigation_profile() {
    Parameters const parameters{parameter("target_position", "string[]"), parameter("time_limit", "int", "0"),
                                parameter("routing_policy", "string", "time")};
    return profile("Navigation",
                   {command("set_parameter", {parameter("target_position", "string[]"), parameter("time_limit", "int"),
                                              parameter("routing_policy", "string")}),
                    command("dock", {parameter("side", "string", "left"), parameter("times", "int", "1")},
                            {parameter("charge", "int")}, std::chrono::milliseconds{500}),
                    query("route", {parameter("length", "double"), parameter("to", "string")}),
                    event("reached_target", {parameter("target", "string"), parameter("is_final_target", "bool")})},
                   parameters);
}

ComponentProfile speech_profile() {
    return profile("SpeechSynthesis",
                   {command("start", {}, {}, std::chrono::seconds{2}),
                    query("get_parameter", {parameter("synthesizable_languages", "string[]"), parameter("volume", "int"),
                                            parameter("language", "string")})},
                   {parameter("speech_text", "string"), parameter("SSML_text", "string"), parameter("volume", "int", "50"),
                    parameter("language", "string", "en")});
}

ComponentProfile detection_profile() {
    return profile("PersonDetection",
                   {event("person_detected", {parameter("timestamp", "DateTime"), parameter("number", "int")})});
}

ComponentProfile localization_profile() {
    return profile("PersonLocalization",
                   {event("person_localized", {parameter("timestamp", "DateTime"), parameter("person_ref", "RoISIdentifier[]"),
                                               parameter("position_data", "string[]")})});
}

ComponentProfile lamp_profile() {
    return profile("Lamp", {},
                   {parameter("count", "int"), parameter("ratio", "urn:x-rois:def:DataType:ATR::Real"), parameter("lit", "bool"),
                    parameter("label", "string"), parameter("since", "DateTime"), parameter("owner", "RoISIdentifier"),
                    parameter("counts", "int[]", "1 2"), parameter("labels", "string[]", "red green"),
                    parameter("owners", "RoISIdentifier[]"), parameter("grammar", "string"), parameter("shade", "Shade")});
}

}  // namespace

ComponentProfile const common = common_profile();
Part const navigation{"navigation", navigation_profile(), OnStart::acts, {{"target_position"}}, CompletedStatus::abort, {}};
Part const speech{"speech", speech_profile(), OnStart::acts, {{"speech_text", "SSML_text"}}, CompletedStatus::abort, {}};
Part const detection{"detection", detection_profile(), OnStart::becomes_active, {}, CompletedStatus::abort, {}};
Part const localization{"localization", localization_profile(), OnStart::becomes_active, {}, CompletedStatus::abort, {}};
Part const desk_lamp{.ref = "lamp",
                     .profile = lamp_profile(),
                     .on_start = OnStart::is_done,
                     .mandatory = {},
                     .engine = {},
                     .codebooks = {{"owner", {"urn:x-test:visitors", "urn:x-test:robots"}}}};

Part named(std::string ref, Part part) {
    part.ref = std::move(ref);
    return part;
}

Part in_engine(std::string engine, Part part) {
    part.ref = engine + "." + part.ref;
    part.engine = std::move(engine);
    return part;
}

void Stage::advance(Instant) {
    for (auto const& what : std::exchange(waiting_, {})) what();
}

ScriptedComponent::ScriptedComponent(Part const& part, std::function<void(std::function<void()>)> happen)
    : on_start{part.on_start},
      part_{part},
      happen_{std::move(happen)},
      seen_{{.status = status_now, .location = {}, .parameters = {}}} {
    description_.ref = {.code = part.ref, .authority = "OMG", .codebook_ref = {}, .version = {}};
    description_.engine = part.engine;
    description_.crs = part.crs;
    description_.positions = part.positions;
    description_.codebooks = part.codebooks;
    description_.moves = part.moves;
    description_.provider = "stage";
    description_.returns_at_once = true;
    description_.alternatives = part.mandatory;
    description_.status_when_stopped = part.status_when_stopped;
    description_.profile = std::make_shared<ComponentProfile const>(part.profile);
}

void ScriptedComponent::called(std::string const& name) const {
    if (watch) watch(name);
    if (!throws_in.contains(name)) return;
    if (throws_no_exception) throw 42;
    throw std::runtime_error(name + " went wrong");
}

void ScriptedComponent::begins() {
    happen_([this] { port().started(latest_); });
}

void ScriptedComponent::stands_still() {
    happen_([this] { confirm_halt(); });
}

void ScriptedComponent::finishes(CompletedStatus status, Results results, Afterwards afterwards) {
    happen_([this, status, results, afterwards] { port().completed(latest_, status, results, afterwards); });
}

void ScriptedComponent::answers(CommandHandle command, CompletedStatus status) {
    happen_([this, command, status] { port().completed(command, status); });
}

void ScriptedComponent::fires(std::string const& event_type, ParameterList results, std::vector<Located> located) {
    happen_([this, event_type, results, located] { port().event(event_type, {results, located}); });
}

void ScriptedComponent::reports(ErrorType type, std::string const& text) {
    happen_([this, type, text] { port().error(type, text); });
}

ComponentDescription const& ScriptedComponent::description() const {
    called("description");
    return description_;
}

ComponentStatus ScriptedComponent::status() const {
    called("status");
    return status_now;
}

Prepared ScriptedComponent::prepare(std::string_view command_type, ParameterList const& parameters) {
    called("prepare");
    if (accepts && (*accepts)-- <= 0) return Refused{"it accepts no more commands"};
    if (command_type == "set_parameter")
        return [this, parameters](CommandHandle, Instant now) { parameters_changed(parameters, now); };
    if (command_type != "start")
        return [this, type = std::string{command_type}, parameters](CommandHandle command, Instant) {
            perform(command, type, parameters);
        };
    for (auto const& group : part_.mandatory)
        if (std::ranges::none_of(group, [&](auto const& name) { return find(parameters, name) != nullptr; }))
            return Refused{"the parameter " + group.front() + " is mandatory"};
    return [this, parameters](CommandHandle command, Instant) { start(command, parameters); };
}

void ScriptedComponent::start(CommandHandle command, ParameterList const& parameters) {
    calls.emplace_back("start");
    latest_ = command;
    started_with = parameters;
    called("start");
    if (on_start == OnStart::stays_silent) return;
    port().started(command);
    if (on_start == OnStart::becomes_active) port().completed(command, CompletedStatus::ok, {}, Afterwards::active);
    if (on_start == OnStart::is_done) port().completed(command, CompletedStatus::ok);
}

Halted ScriptedComponent::halt(Instant) {
    calls.emplace_back("halt");
    called("halt");
    return halts_later ? Halted::not_yet : Halted::confirmed;
}

void ScriptedComponent::suspend(Instant) {
    calls.emplace_back("suspend");
    called("suspend");
}

void ScriptedComponent::resume(Instant) {
    calls.emplace_back("resume");
    called("resume");
}

void ScriptedComponent::parameters_changed(ParameterList const& parameters, Instant) {
    calls.emplace_back("parameters_changed");
    changed_to = parameters;
    called("parameters_changed");
}

void ScriptedComponent::perform(CommandHandle command, std::string_view command_type, ParameterList const& arguments) {
    calls.emplace_back(command_type);
    latest_ = command;
    started_with = arguments;
    called("perform");
}

bool ScriptedComponent::has_changed() const {
    ComponentState now{status_now, where, reads.value_or(ParameterList{})};
    bool const throws =
        throws_in.contains("status") || throws_in.contains("location") || throws_in.contains("readable_parameters");
    return throws || throws_in.contains("more than is known") || std::exchange(seen_, now) != now;
}

std::optional<Located> ScriptedComponent::location() const {
    called("location");
    return where;
}

ParameterList ScriptedComponent::readable_parameters() const {
    called("readable_parameters");
    if (throws_in.contains("more than is known")) return {texts("mood", {"good"})};
    if (reads) return *reads;
    if (part_.ref != speech.ref) return {};
    return {texts("synthesizable_languages", {"en", "ja"})};
}

std::vector<Results> ScriptedComponent::query(std::string_view query_type, Instant now) {
    called("query");
    if (throws_in.contains("nothing known")) return LocalComponent::query(query_type, now);
    if (!knows.empty()) return knows;
    if (query_type != "route") return LocalComponent::query(query_type, now);
    return {{{Parameter{"length", {"double", {}, {}, {}}, {throws_in.contains("nothing right") ? "far" : "2.5"}}}, {}}};
}

}  // namespace rois
