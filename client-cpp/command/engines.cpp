// The sub engines of the gateway: `engines`. Needs no session.
#include <array>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command/context.hpp"
#include "command/http.hpp"
#include "command/output/terminal.hpp"
#include "xml/codec/codec.hpp"

namespace rois::command {

namespace {

double milliseconds(std::chrono::nanoseconds time) { return std::chrono::duration<double, std::milli>(time).count(); }

std::vector<Table::Cell> row_of(EngineState const& engine) {
    std::string round_trip = "-";
    if (engine.round_trip) {
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%.2f ms", milliseconds(*engine.round_trip));
        round_trip = text.data();
    }
    bool const is_present = engine.is == EngineState::Is::present;
    return {{engine.name, Colour::name},
            {std::string{to_text(engine.is)}, is_present ? Colour::good : Colour::bad},
            {engine.link},
            {round_trip},
            {std::to_string(engine.components)},
            {engine.last_error.empty() ? "-" : engine.last_error, Colour::quiet}};
}

Json json_of(EngineState const& engine) {
    Json object{{"name", engine.name}, {"state", to_text(engine.is)}, {"link", engine.link}};
    if (engine.round_trip) object["round_trip"] = milliseconds(*engine.round_trip);
    object.update(Json{{"components", engine.components}, {"losses", engine.losses}});
    if (!engine.last_error.empty()) object["last_error"] = engine.last_error;
    return object;
}

}  // namespace

void engines(Options const& options, Printer& printer) {
    auto const server = server_of(options);
    auto const answer = http_get(server, "/rois/engines", options.deadline);
    auto const all = answer.status == 200 ? xml::AnswerReader{}.read_engines(answer.body) : std::nullopt;
    if (!all) throw unexpected(options.command, server, answer);
    if (printer.form() == Form::xml) return printer.text(answer.body + "\n");
    if (printer.form() == Form::json) {
        for (auto const& each : *all) printer.line({}, {}, json_of(each));
    } else if (!all->empty()) {
        Table table;
        table.add({{"name"}, {"state"}, {"link"}, {"round trip"}, {"components"}, {"last error"}});
        for (auto const& each : *all) table.add(row_of(each));
        printer.text(table.text(printer.coloured()));
    }
    if (all->empty()) remark("the gateway has no sub engines");
}

}  // namespace rois::command
