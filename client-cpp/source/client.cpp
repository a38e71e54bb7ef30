#include "rois/client.hpp"

#include "core/core.hpp"
#include "rois/blocking.hpp"

namespace rois {

using detail::asked;

Task<Component> Client::bind(std::string ref, Switching switching) {
    auto const inside = core();
    Bind operation{{.code = std::move(ref), .authority = {}, .codebook_ref = {}, .version = {}}, switching};
    auto bound = operation.component_ref;
    co_await asked(inside, std::move(operation), "bind ", bound.code);
    co_return Component{inside, std::move(bound)};
}

Task<Component> Client::take_over(std::string ref, Switching switching) {
    auto const inside = core();
    Bind operation{{.code = std::move(ref), .authority = {}, .codebook_ref = {}, .version = {}}, switching, true};
    auto bound = operation.component_ref;
    co_await asked(inside, std::move(operation), "take over ", bound.code);
    co_return Component{inside, std::move(bound)};
}

Task<Component> Client::bind_any(QueryExpression condition, Switching switching) {
    auto const inside = core();
    BindAny operation{std::move(condition), switching};
    auto bound = co_await asked(inside, std::move(operation), "bind_any");
    co_return Component{inside, std::move(bound.component_ref)};
}

Component Client::component(std::string ref) const {
    return {core(), {.code = std::move(ref), .authority = {}, .codebook_ref = {}, .version = {}}};
}

Task<std::vector<Identifier>> Client::search(QueryExpression condition) {
    Search operation{std::move(condition)};
    auto found = co_await asked(core(), std::move(operation), "search");
    co_return std::move(found.component_ref_list);
}

Task<GetProfile::Reply> Client::get_profile(QueryExpression condition) {
    return asked(core(), GetProfile{std::move(condition)}, "get_profile");
}

Task<Query::Reply> Client::query(std::string query_type, QueryExpression condition) {
    auto whom = query_type;
    return asked(core(), Query{std::move(query_type), std::move(condition)}, "query ", std::move(whom));
}

Task<Results> Client::get_error_detail(ErrorId error_id) {
    GetErrorDetail operation{std::move(error_id), {}};
    auto detail = co_await asked(core(), std::move(operation), "get_error_detail");
    co_return std::move(detail.results);
}

Task<std::vector<Command>> Client::execute(CommandUnitSequence sequence) {
    auto const inside = core();
    auto const watches = co_await inside->begin(std::move(sequence), "execute");
    std::vector<Command> commands;
    commands.reserve(watches.size());
    for (auto const& watch : watches) commands.emplace_back(inside, watch);
    co_return commands;
}

Task<EventStream> Client::subscribe(std::string event_type, QueryExpression condition) {
    auto const inside = core();
    Subscribe operation{std::move(event_type), std::move(condition), true};
    auto stream = co_await inside->subscribe(std::move(operation));
    co_return EventStream{inside, std::move(stream)};
}

CommandUnit command(Component const& component, std::string command_type, ParameterList arguments, Milliseconds delay) {
    CommandUnit unit{{}, CommandMessage{component.ref(), std::move(command_type), {}, std::move(arguments)}};
    if (delay.count() != 0) unit.delay_time = delay.count();
    return unit;
}

void Blocking::open() {
    auto const problem = client_.wait(client_.opened());
    if (!problem) return;
    throw Error{problem->why == NoAnswer::Why::deadline ? ReturnCode::timeout : ReturnCode::error, "connect: " + problem->reason};
}

}  // namespace rois
