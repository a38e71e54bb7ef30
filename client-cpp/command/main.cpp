// The `rois` command: controls an engine from the command line (docs/rois-command.md).
#include <cstdio>
#include <exception>
#include <functional>
#include <map>
#include <optional>
#include <string_view>

#include "command/context.hpp"
#include "command/options.hpp"
#include "command/output/terminal.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::command {

namespace {

std::map<std::string_view, std::function<void(Context&)>> const& commands() {
    static std::map<std::string_view, std::function<void(Context&)>> const all{
        {"profile", profile},
        {"search", search},
        {"bind", bind},
        {"release", release},
        {"get", get},
        {"set", set},
        {"start", start},
        {"stop", stop},
        {"resume", resume},
        {"execute", execute},
        {"query", query},
        {"subscribe", subscribe},
        {"watch", watch},
        {"send", send},
        {"record", record},
        {"replay", replay},
        {"scenario", scenario},
        {"engines", [](Context& context) { engines(context.options(), context.printer()); }},
        {"health", [](Context& context) { health(context.options(), context.printer()); }},
        {"stop-all", [](Context& context) { stop_all(context.options(), context.printer()); }},
        {"clear", [](Context& context) { clear(context.options(), context.printer()); }},
    };
    return all;
}

int report(Exit exit, std::string_view what) {
    if (!what.empty()) std::fprintf(stderr, "rois: %.*s\n", static_cast<int>(what.size()), what.data());
    return static_cast<int>(exit);
}

int run(int argc, char const* const* argv) {
    warn_of_unknown_variables();
    auto read = read_options(argc, argv);
    if (auto const* const printout = std::get_if<Printout>(&read)) {
        std::fputs(printout->text.c_str(), stdout);
        return 0;
    }
    auto options = std::get<Options>(std::move(read));
    Caller const caller;
    std::optional<Background> background;
    if (runs_in_background(options)) background.emplace();
    Signals signals;
    Context context{std::move(options), signals, caller, background ? &*background : nullptr};
    commands().at(context.options().command)(context);
    context.keep_recording();
    return 0;
}

}  // namespace

}  // namespace rois::command

int main(int argc, char** argv) {
    using namespace rois::command;
    try {
        rois::xml::Platform const platform;
        return run(argc, argv);
    } catch (Trouble const& trouble) {
        return report(trouble.exit(), trouble.what());
    } catch (std::exception const& error) {
        return report(Exit::error, error.what());
    }
}
