// The commands replay and record --listen: this program serves as an engine.
#include <nlohmann/json.hpp>

#include "command/context.hpp"
#include "command/http.hpp"
#include "command/output/terminal.hpp"
#include "command/recording/front.hpp"
#include "command/recording/player.hpp"
#include "command/recording/relay.hpp"

namespace rois::command {

namespace {

constexpr auto default_listen = "127.0.0.1:8080";

void serve(Context& context, Host& host, std::string const& what) {
    auto const& listen = context.options().listen;
    Front front{host, context.schemas(), listen.empty() ? default_listen : listen};
    context.signals().on_first([&] { front.stop(); });
    auto& printer = context.printer();
    printer.line(what + " at " + painted(front.url(), Colour::value, printer.coloured()), "listening",
                 Json{{"listening", front.url()}});
    front.run();
    context.signals().on_first({});
}

}  // namespace

void replay(Context& context) {
    auto const& options = context.options();
    xml::RequestReader reader{context.schemas()};
    auto const scripts = scripts_of(read_recording(options.file), reader);
    asio::io_context io{1};
    std::size_t sessions = 0;
    Host host{io, [&](HostedSession& session, Connect const&) {
                  auto const script = scripts[std::min(sessions++, scripts.size() - 1)];
                  return std::make_unique<Player>(io, session, script, options.speed);
              }};
    serve(context, host, "replaying " + options.file);
}

void record_others(Context& context) {
    auto const& options = context.options();
    check(server_of(options));
    asio::io_context io{1};
    std::size_t sessions = 0;
    Host host{io, [&](HostedSession& session, Connect const& connect) {
                  auto settings = settings_of(options);
                  settings.switches = connect.switches;
                  return std::make_unique<Relay>(io, session, std::move(settings), context.recorded(),
                                                 std::to_string(++sessions));
              }};
    serve(context, host, "recording documents between applications and " + options.url);
    context.recorded()->check();
}

}  // namespace rois::command
