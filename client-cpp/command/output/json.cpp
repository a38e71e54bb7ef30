#include "command/output/json.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <variant>

#include "types/data_type.hpp"
#include "types/text/texts.hpp"

namespace rois::command {

namespace {

Json scalar(DataType const& type, std::string const& text) {
    if (type.base == BaseType::integer)
        if (auto const number = to_int(text)) return *number;
    if (type.base == BaseType::real)
        if (auto const number = to_double(text)) return *number;
    if (type.base == BaseType::boolean) {
        auto const word = trimmed(text);
        if (word == "true" || word == "1") return true;
        if (word == "false" || word == "0") return false;
    }
    return text;
}

bool is_packed(DataType const& type) {
    return type.base == BaseType::integer || type.base == BaseType::real || type.base == BaseType::boolean;
}

Json value_of(Parameter const& parameter) {
    auto const type = DataType::of(parameter.data_type_ref);
    if (!type.list) return parameter.values.empty() ? Json{} : scalar(type, parameter.values.front());
    auto list = Json::array();
    for (auto const& value : parameter.values) {
        if (!is_packed(type)) {
            list.push_back(value);
            continue;
        }
        for (auto rest = trimmed(value); !rest.empty();) {
            auto const item = rest.substr(0, rest.find_first_of(" \t\r\n"));
            list.push_back(scalar(type, std::string{item}));
            rest = trimmed(rest.substr(item.size()));
        }
    }
    return list;
}

Json values_of(ParameterList const& parameters) {
    auto object = Json::object();
    for (auto const& parameter : parameters) object[parameter.name] = value_of(parameter);
    return object;
}

Json located_of(Located const& located) {
    Json object{{"of", located.of}, {"ref", located.ref}, {"crs", located.crs}, {"position", located.position}};
    if (!located.orientation.empty()) object["orientation"] = located.orientation;
    if (auto const* const reliability = std::get_if<Located::Reliability>(&located.certainty))
        object["reliability"] = reliability->probability;
    if (auto const* const covariance = std::get_if<Located::Covariance>(&located.certainty))
        object["covariance"] = covariance->rows;
    return object;
}

void add_results(Json& object, Results const& results) {
    object["results"] = values_of(results.parameters);
    if (results.located.empty()) return;
    auto located = Json::array();
    for (auto const& one : results.located) located.push_back(located_of(one));
    object["located"] = std::move(located);
}

Json declared(std::vector<ParameterProfile> const& parameters) {
    auto list = Json::array();
    for (auto const& parameter : parameters) {
        Json one{{"name", parameter.name}, {"type", parameter.data_type_ref.code}};
        if (parameter.default_value) one["default_value"] = *parameter.default_value;
        if (!parameter.description.empty()) one["description"] = parameter.description;
        list.push_back(std::move(one));
    }
    return list;
}

Json messages(ComponentProfile const& profile, MessageKind kind) {
    auto list = Json::array();
    for (auto const& message : profile.messages) {
        if (message.kind != kind) continue;
        Json one{{"name", message.name}};
        if (!message.arguments.empty()) one["arguments"] = declared(message.arguments);
        if (!message.results.empty()) one["results"] = declared(message.results);
        if (message.timeout) one["timeout"] = message.timeout->count();
        list.push_back(std::move(one));
    }
    return list;
}

void add_ids(Json& list, std::vector<CommandUnit> const& units) {
    for (auto const& unit : units) {
        if (auto const* const message = std::get_if<CommandMessage>(&unit.unit)) {
            list.push_back({{"component_ref", message->component_ref.code},
                            {"command_type", message->command_type},
                            {"command_id", message->command_id.text}});
        } else if (auto const* const concurrent = std::get_if<ConcurrentCommands>(&unit.unit)) {
            for (auto const& branch : concurrent->branches) add_ids(list, branch.command_list);
        } else if (auto const* const sequential = std::get_if<SequentialCommandUnit>(&unit.unit)) {
            add_ids(list, sequential->command_unit_list);
        } else if (auto const* const parallel = std::get_if<ParallelCommandUnit>(&unit.unit)) {
            add_ids(list, parallel->command_unit_list);
        }
    }
}

// The fields of a reply without its return code and reason.
struct Out {
    Json& object;

    void operator()(Outcome const&) const {}
    void operator()(Connect::Reply const& reply) const { object["session"] = reply.session.text; }
    void operator()(GetProfile::Reply const& reply) const {
        if (!reply.profile) return;
        object["engine"] = {{"name", reply.profile->object.name}, {"identifier", reply.profile->object.identifier}};
        object["parameters"] = declared(reply.profile->parameters);
        auto list = Json::array();
        for (auto const& component : reply.components) {
            Json one{{"ref", component.ref}, {"type", component.type}, {"engine", component.engine}};
            if (component.profile) one["profile"] = to_json(*component.profile);
            list.push_back(std::move(one));
        }
        object["components"] = std::move(list);
    }
    void operator()(GetErrorDetail::Reply const& reply) const { add_results(object, reply.results); }
    void operator()(Search::Reply const& reply) const {
        auto list = Json::array();
        for (auto const& ref : reply.component_ref_list) list.push_back(ref.code);
        object["component_ref_list"] = std::move(list);
    }
    void operator()(BindAny::Reply const& reply) const { object["component_ref"] = reply.component_ref.code; }
    void operator()(GetParameter::Reply const& reply) const { object["parameters"] = values_of(reply.parameters); }
    void operator()(SetParameter::Reply const& reply) const { object["command_id"] = reply.command_id.text; }
    void operator()(Execute::Reply const& reply) const {
        auto list = Json::array();
        add_ids(list, reply.command_unit_list.command_unit_list);
        object["commands"] = std::move(list);
    }
    void operator()(GetCommandResult::Reply const& reply) const { add_results(object, reply.results); }
    void operator()(Query::Reply const& reply) const {
        object["component_ref"] = reply.component_ref.code;
        add_results(object, reply.results);
    }
    void operator()(Subscribe::Reply const& reply) const { object["subscribe_id"] = reply.subscribe_id.text; }
    void operator()(GetEventDetail::Reply const& reply) const { add_results(object, reply.results); }
};

struct NotificationFields {
    Json& object;

    void operator()(ReceiveEvent const& event) const {
        object["notification"] = "receive_event";
        object["event_type"] = event.event_type;
        object["component_ref"] = event.component_ref.code;
        object["event_id"] = event.event_id.text;
        object["subscribe_id"] = event.subscribe_id.text;
        object["expire"] = to_text(event.expire);
        if (event.results) add_results(object, *event.results);
    }
    void operator()(ReceiveError const& error) const {
        object["notification"] = "receive_error";
        object["error_id"] = error.error_id.text;
        object["error_type"] = to_text(error.error_type);
        if (error.component_ref) object["component_ref"] = error.component_ref->code;
    }
    void operator()(Completed const& completed) const {
        object["notification"] = "completed";
        object["command_id"] = completed.command_id.text;
        object["status"] = to_text(completed.status);
    }
    void operator()(Lost const& lost) const {
        object["notification"] = "lost";
        object["count"] = lost.count;
    }
    void operator()(ProfileChanged const&) const { object["notification"] = "profile_changed"; }
    void operator()(ComponentChanged const& changed) const {
        object["notification"] = "component_changed";
        object["component_ref"] = changed.component_ref.code;
        object["status"] = to_text(changed.status);
        add_results(object, changed.results);
    }
    void operator()(Switched const& switched) const {
        object["notification"] = "switched";
        object["component_ref"] = switched.component_ref.code;
        object["from"] = switched.from;
        object["to"] = switched.to;
        object["reason"] = switched.reason;
    }
};

}  // namespace

Json to_json(Reply const& reply, std::string_view operation) {
    Json object{{"operation", operation}};
    std::visit(
        [&](auto const& one) {
            object["return_code"] = to_text(one.return_code);
            if (one.return_code != ReturnCode::ok) {
                object["reason"] = one.reason;
            } else {
                Out{object}(one);
            }
        },
        reply);
    return object;
}

Json to_json(Fault const& fault) {
    Json object{{"fault", to_text(fault.code)}, {"reason", fault.reason}};
    if (fault.place) object.update(Json{{"line", fault.place->line}, {"column", fault.place->column}});
    return object;
}

Json to_json(Notification const& notification, std::uint64_t sequence) {
    Json object{{"notification", ""}, {"sequence", sequence}};
    std::visit(NotificationFields{object}, notification);
    return object;
}

Json to_json(ComponentProfile const& profile) {
    Json object{{"name", profile.object.name}, {"identifier", profile.object.identifier}};
    if (!profile.object.description.empty()) object["description"] = profile.object.description;
    if (!profile.sub_components.empty()) object["sub_components"] = profile.sub_components;
    object["commands"] = messages(profile, MessageKind::command);
    object["queries"] = messages(profile, MessageKind::query);
    object["events"] = messages(profile, MessageKind::event);
    object["parameters"] = declared(profile.parameters);
    return object;
}

Json to_json(StateChange const& change) {
    Json object{{"connection", to_text(change.state)}};
    if (!change.reason.empty()) object["reason"] = change.reason;
    return object;
}

Json to_json(Gap const& gap) {
    Json object{{"gap", gap.why == Gap::Why::dropped ? "dropped" : "new_session"}};
    if (gap.count) object["count"] = *gap.count;
    if (!gap.not_restored.empty()) object["not_restored"] = gap.not_restored;
    return object;
}

std::string line_of(Json const& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace rois::command
