#include "rois/client.hpp"

#include "core.hpp"
#include "rois/blocking.hpp"

namespace rois {

namespace {

template <class Op>
typename Op::Reply checked(typename Op::Reply reply, std::string const& what) {
    if (reply.return_code != ReturnCode::ok) throw Error{reply.return_code, what + ": " + reply.reason};
    return reply;
}

}  // namespace

Task<Component> Client::bind(std::string ref) {
    auto const inside = core();
    Bind operation{{.code = std::move(ref), .authority = {}, .codebook_ref = {}, .version = {}}};
    auto bound = operation.component_ref;
    auto reply = co_await call(std::move(operation));
    checked<Bind>(std::move(reply), "bind " + bound.code);
    co_return Component{inside, std::move(bound)};
}

Task<Component> Client::bind_any(QueryExpression condition) {
    auto const inside = core();
    BindAny operation{std::move(condition)};
    auto reply = co_await call(std::move(operation));
    auto bound = checked<BindAny>(std::move(reply), "bind_any");
    co_return Component{inside, std::move(bound.component_ref)};
}

Component Client::component(std::string ref) const {
    return {core(), {.code = std::move(ref), .authority = {}, .codebook_ref = {}, .version = {}}};
}

Task<std::vector<Identifier>> Client::search(QueryExpression condition) {
    Search operation{std::move(condition)};
    auto reply = co_await call(std::move(operation));
    auto found = checked<Search>(std::move(reply), "search");
    co_return std::move(found.component_ref_list);
}

Task<GetProfile::Reply> Client::get_profile(QueryExpression condition) {
    GetProfile operation{std::move(condition)};
    auto reply = co_await call(std::move(operation));
    co_return checked<GetProfile>(std::move(reply), "get_profile");
}

Task<Query::Reply> Client::query(std::string query_type, QueryExpression condition) {
    auto const what = "query " + query_type;
    Query operation{std::move(query_type), std::move(condition)};
    auto reply = co_await call(std::move(operation));
    co_return checked<Query>(std::move(reply), what);
}

Task<Results> Client::get_error_detail(ErrorId error_id) {
    GetErrorDetail operation{std::move(error_id), {}};
    auto reply = co_await call(std::move(operation));
    auto detail = checked<GetErrorDetail>(std::move(reply), "get_error_detail");
    co_return std::move(detail.results);
}

Task<std::vector<Command>> Client::execute(CommandUnitSequence sequence) {
    auto const inside = core();
    auto const watches = co_await inside->begin(std::move(sequence), "execute");
    std::vector<Command> commands;
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
