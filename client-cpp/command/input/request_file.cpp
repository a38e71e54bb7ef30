#include "command/input/request_file.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <variant>

#include "command/exit.hpp"
#include "xml/codec/codec.hpp"
#include "xml/codec/names.hpp"

namespace rois::command {

namespace {

// Returns the position of the root's start tag; the end of the text if there is none.
std::size_t root_of(std::string_view text) {
    for (std::size_t at = text.find('<'); at != text.npos; at = text.find('<', at + 1)) {
        if (text.substr(at, 4) == "<!--") {
            auto const end = text.find("-->", at + 4);
            if (end == text.npos) break;
            at = end;
        } else if (text.substr(at, 2) != "<?" && text.substr(at, 2) != "<!") {
            return at;
        }
    }
    return text.size();
}

// Returns the local name of the start tag at this position.
std::string_view name_at(std::string_view text, std::size_t at) {
    auto const name = text.substr(std::min(at + 1, text.size()));
    return xml::local_part(name.substr(0, name.find_first_of(" \t\r\n/>")));
}

// The texts that make a request of a part of one.
struct Around {
    std::string before;
    std::string after;
};

Around around(std::string_view root) {
    auto const opened = [](std::string const& request) {
        return "<" + request + " xmlns=\"" + std::string{xml::message_namespace} + "\">";
    };
    if (root == "CommandUnitSequence") return {opened("execute"), "</execute>"};
    if (root == "condition") return {opened("search"), "</search>"};
    if (root == "Filter" || root == "SearchCondition" || root == "SortBy")
        return {opened("search") + "<condition>", "</condition></search>"};
    return {};
}

// Reads the request in a file, or completes a part of one. The text put before the part is in the first line; corrects the
// columns of errors there.
Operation read_request(std::shared_ptr<xml::Schemas const> const& schemas, std::string const& name, std::string text) {
    auto const root = root_of(text);
    auto const put = around(name_at(text, root));
    if (!put.before.empty())
        for (std::size_t i = 0; i < root; ++i)
            if (text[i] != '\n') text[i] = ' ';
    auto const document = put.before + text + put.after;
    auto read = xml::RequestReader{schemas}.read(document);
    if (auto* const request = std::get_if<Request>(&read)) return std::move(request->operation);
    auto const& fault = std::get<Fault>(read);
    auto place = fault.place.value_or(Place{});
    if (place.line == 1) place.column -= std::min<std::uint64_t>(put.before.size(), place.column - 1);
    throw Trouble{Exit::usage,
                  name + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) + ": " + fault.reason};
}

}  // namespace

QueryExpression read_condition_file(std::shared_ptr<xml::Schemas const> const& schemas, std::string const& name,
                                    std::string const& text) {
    auto operation = read_request(schemas, name, text);
    auto* const condition = std::visit(
        [](auto& one) -> QueryExpression* {
            if constexpr (requires { one.condition; }) return &one.condition;
            return nullptr;
        },
        operation);
    if (condition == nullptr) throw Trouble{Exit::usage, name + ": this request has no condition"};
    return std::move(*condition);
}

CommandUnitSequence read_sequence_file(std::shared_ptr<xml::Schemas const> const& schemas, std::string const& name,
                                       std::string const& text) {
    auto operation = read_request(schemas, name, text);
    auto* const execute = std::get_if<Execute>(&operation);
    if (execute == nullptr) throw Trouble{Exit::usage, name + ": this is not a CommandUnitSequence"};
    return std::move(execute->command_unit_list);
}

}  // namespace rois::command
