#include "probe.hpp"

#include <chrono>
#include <optional>
#include <utility>

#include "types/text/texts.hpp"

namespace rois::bench {

namespace {

constexpr char const* label = "in the hall, between the desk and the door to the garden";

ParameterProfile parameter(std::string name, std::string type, std::optional<std::string> default_value = {}) {
    return {.name = std::move(name),
            .data_type_ref = {.code = std::move(type), .authority = {}, .codebook_ref = {}, .version = {}},
            .default_value = std::move(default_value),
            .description = {}};
}

MessageProfile message(MessageKind kind, std::string name, std::vector<ParameterProfile> results,
                       std::vector<ParameterProfile> arguments = {}) {
    return {
        .kind = kind, .name = std::move(name), .results = std::move(results), .arguments = std::move(arguments), .timeout = {}};
}

std::string urn(std::string const& name) { return "urn:x-rois:def:component:bench::" + name; }

ComponentProfile profile(std::string const& name, std::string query, std::string event) {
    ComponentProfile made;
    made.object = {.identifier = urn(name), .code_space = "urn:ietf:rfc:2141", .name = name, .description = {}, .meta_data = {}};
    made.sub_components = {urn("Common")};
    made.messages = {message(MessageKind::query, std::move(query), {parameter("value", "int"), parameter("label", "string")}),
                     message(MessageKind::event, std::move(event), {parameter("stamp", "string"), parameter("value", "int")}),
                     message(MessageKind::command, "fire", {}, {parameter("burst", "int", "1")}),
                     message(MessageKind::command, "set_parameter", {}, {parameter("label", "string")})};
    made.parameters = {parameter("label", "string", label)};
    return made;
}

ComponentProfile common_profile() {
    ComponentProfile made;
    made.object = {.identifier = urn("Common"), .code_space = {}, .name = "Common", .description = {}, .meta_data = {}};
    made.messages = {message(MessageKind::command, "start", {}), message(MessageKind::command, "stop", {}),
                     message(MessageKind::query, "component_status", {parameter("status", "Component_Status")})};
    return made;
}

std::string stamp() {
    using namespace std::chrono;
    return "t" + std::to_string(duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count());
}

class Probe final : public LocalComponent {
public:
    Probe(std::string ref, std::shared_ptr<ComponentProfile const> profile, std::string engine)
        : event_{profile->messages[1].name} {
        description_.ref = {.code = std::move(ref), .authority = {}, .codebook_ref = profile->object.identifier, .version = {}};
        description_.profile = std::move(profile);
        description_.engine = std::move(engine);
        description_.returns_at_once = true;
    }

private:
    ComponentDescription const& description() const override { return description_; }
    ComponentStatus status() const override { return ComponentStatus::ready; }
    Prepared prepare(std::string_view command_type, ParameterList const& arguments) override {
        if (command_type == "set_parameter") return [](CommandHandle, Instant) {};
        auto const* burst = command_type == "fire" ? find(arguments, "burst") : nullptr;
        auto const count = command_type != "fire" ? 0 : burst == nullptr ? 1 : to_double(burst->values.front()).value_or(1);
        return [this, count](CommandHandle command, Instant) {
            for (int i = 0; i < count; ++i) port().event(event_, {{rois::text("stamp", stamp()), integer("value", 42)}, {}});
            port().completed(command, CompletedStatus::ok);
        };
    }
    Halted halt(Instant) override { return Halted::confirmed; }
    void suspend(Instant) override {}
    void resume(Instant) override {}

    std::vector<Results> query(std::string_view, Instant) override {
        return {{{integer("value", 42), rois::text("label", label)}, {}}};
    }

    std::string event_;
    ComponentDescription description_;
};

}  // namespace

ComponentProfile probe_profile() { return profile("Probe", "reading", "probed"); }

ComponentProfile bystander_profile() { return profile("Bystander", "other_reading", "other_probed"); }

std::vector<ComponentProfile> known_profiles() { return {common_profile(), probe_profile(), bystander_profile()}; }

std::unique_ptr<Component> probe(std::string ref, std::shared_ptr<ComponentProfile const> profile, std::string engine) {
    return std::make_unique<Probe>(std::move(ref), std::move(profile), std::move(engine));
}

}  // namespace rois::bench
