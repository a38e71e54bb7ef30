#include "model/subject.hpp"

namespace rois::model {

namespace {

constexpr std::chrono::milliseconds tick{50};  // as in World

EngineSettings settings(std::size_t kept) {
    EngineSettings settings;
    settings.max_command_results = kept;
    return settings;
}

std::string ref(int component) { return std::string{refs[static_cast<std::size_t>(component)]}; }

char const* parameter_of(int component) { return component == 0 ? "time_limit" : "volume"; }

CommandUnit unit_of(Order const& order) {
    auto const name = ref(order.component);
    auto unit = command(std::string{order.type}, name);
    auto& message = std::get<CommandMessage>(unit.unit);
    message.command_id.text = std::string(1, order.name);
    if (order.type == "start" && name == "navigation") message.arguments = {texts("target_position", {"1000, 0, 90"})};
    if (order.type == "start" && name == "speech") message.arguments = {text("speech_text", "hello")};
    if (order.delay > 0) unit.delay_time = (order.delay * tick).count();
    return unit;
}

Execute sequence_of(Plan const& plan) {
    Execute execute;
    for (auto const& unit : plan) {
        if (unit.size() == 1) {
            execute.command_unit_list.command_unit_list.push_back(unit_of(unit.front().front()));
            continue;
        }
        std::vector<std::vector<CommandUnit>> lists;
        for (auto const& branch : unit) {
            auto& list = lists.emplace_back();
            for (auto const& order : branch) list.push_back(unit_of(order));
        }
        execute.command_unit_list.command_unit_list.push_back(branches(std::move(lists)));
    }
    return execute;
}

ReturnCode code_of(Reply const& reply) {
    return std::visit([](auto const& one) { return one.return_code; }, reply);
}

// "3 completed c-17 OK" becomes "3 completed c OK": the engine's own command ids are not compared.
std::string without_own_names(std::string text) {
    auto const begin = text.find(" c-");
    if (begin == std::string::npos) return text;
    return text.erase(begin + 2, text.find(' ', begin + 1) - begin - 2);
}

}  // namespace

Subject::Subject() : world_{{navigation, speech, rois::detection}, settings(4)} {}

std::string Subject::take(Step const& step) {
    auto& seat = seats_[static_cast<std::size_t>(step.session)];
    auto const component = Application::identifier(ref(step.component));
    switch (step.kind) {
        case Kind::connect:
            if (seat.is_connected) return answer(seat, Connect{});
            seat = {world_.connect(), true, {"none"}};
            return "OK";
        case Kind::disconnect: {
            auto const text = answer(seat, Disconnect{});
            seat.is_connected = false;
            return text;
        }
        case Kind::bind:
            return answer(seat, Bind{component});
        case Kind::release:
            return answer(seat, Release{component});
        case Kind::get_parameter:
            return read_parameter(seat, step.component);
        case Kind::set_parameter: {
            auto const value = step.number < 0 ? "loud" : std::to_string(step.number);
            return answer(seat, SetParameter{component, {rois::value(parameter_of(step.component), "int", {value})}});
        }
        case Kind::query_parameters:
            return query_parameters(seat, step.component);
        case Kind::execute:
            return answer(seat, sequence_of(step.plan));
        case Kind::get_command_result:
            return result_of(seat, step.name);
        case Kind::component_status:
            return status_of(seat, step.component);
        case Kind::subscribe: {
            auto const said = say(seat, Subscribe{"person_detected", {}, false});
            if (auto const* reply = std::get_if<Reply>(&said))
                seat.subscription = std::get<Subscribe::Reply>(*reply).subscribe_id;
            return answer(seat, Subscribe{"person_detected", {}, false});  // the same subscription again
        }
        case Kind::unsubscribe:
            return answer(seat, Unsubscribe{seat.subscription});
        case Kind::finish:
            world_[ref(step.component)].finishes(step.number % 2 == 0 ? CompletedStatus::ok : CompletedStatus::error);
            break;
        case Kind::fire:
            world_["detection"].fires("person_detected", {date_time("timestamp", world_.now.utc), integer("number", 1)});
            break;
        case Kind::pass:
            world_.advance(step.number * tick);
            break;
    }
    return "happened";
}

std::optional<std::vector<std::string>> Subject::received(int session) {
    auto& seat = seats_[static_cast<std::size_t>(session)];
    if (!seat.is_connected) return {};
    auto notifications = seat.application->received();
    for (auto& one : notifications) one = without_own_names(one);
    return notifications;
}

std::variant<Reply, Refusal> Subject::say(Seat const& seat, Operation const& operation) {
    return world_.say(seat.application ? seat.application->session : SessionId{"nobody"}, operation);
}

std::string Subject::answer(Seat& seat, Operation const& operation) {
    auto const said = say(seat, operation);
    if (std::holds_alternative<Refusal>(said)) return "no_session";
    return std::string{to_text(code_of(std::get<Reply>(said)))};
}

std::string Subject::read_parameter(Seat& seat, int component) {
    auto const said = say(seat, GetParameter{Application::identifier(ref(component))});
    if (std::holds_alternative<Refusal>(said)) return "no_session";
    auto const& reply = std::get<GetParameter::Reply>(std::get<Reply>(said));
    if (reply.return_code != ReturnCode::ok) return std::string{to_text(reply.return_code)};
    auto const* const found = find(reply.parameters, parameter_of(component));
    return "OK " + (found ? found->values.front() : "");
}

std::string Subject::query_parameters(Seat& seat, int component) {
    auto const said = say(seat, Query{"get_parameter", equal("component_ref", ref(component))});
    if (std::holds_alternative<Refusal>(said)) return "no_session";
    auto const& reply = std::get<Query::Reply>(std::get<Reply>(said));
    if (reply.return_code != ReturnCode::ok) return std::string{to_text(reply.return_code)};
    auto const* const found = find(reply.results.parameters, parameter_of(component));
    return "OK " + (found ? found->values.front() : "");
}

std::string Subject::result_of(Seat& seat, char name) {
    auto const said = say(seat, GetCommandResult{{std::string(1, name)}, {}});
    if (std::holds_alternative<Refusal>(said)) return "no_session";
    auto const& reply = std::get<GetCommandResult::Reply>(std::get<Reply>(said));
    if (reply.return_code != ReturnCode::ok) return std::string{to_text(reply.return_code)};
    return find(reply.results.parameters, "status")->values.front();
}

std::string Subject::status_of(Seat& seat, int component) {
    auto const said = say(seat, Query{"component_status", equal("component_ref", ref(component))});
    if (std::holds_alternative<Refusal>(said)) return "no_session";
    auto const& reply = std::get<Query::Reply>(std::get<Reply>(said));
    if (reply.return_code != ReturnCode::ok) return std::string{to_text(reply.return_code)};
    return find(reply.results.parameters, "status")->values.front();
}

}  // namespace rois::model
