#include "load/application.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace rois::bench {

namespace {

constexpr std::string_view connect = R"(<connect xmlns="urn:x-rois:psm:xml:message:1"/>)";

constexpr std::string_view leave = R"(<disconnect xmlns="urn:x-rois:psm:xml:message:1"/>)";

std::string session_of(std::string const& answer) {
    constexpr std::string_view open = "<session>";
    auto const start = answer.find(open);
    auto const end = answer.find("</session>");
    if (start == answer.npos || end == answer.npos) throw std::runtime_error("the answer to connect has no session: " + answer);
    return answer.substr(start + open.size(), end - start - open.size());
}

}  // namespace

bool is_notification(std::string_view document) {
    static constexpr std::array<std::string_view, 5> names{"<receive_event", "<completed", "<receive_error", "<lost",
                                                           "<profile_changed"};
    return std::ranges::any_of(names, [&](auto name) { return document.starts_with(name); });
}

Application::Application(Options const& options, std::size_t number, std::vector<std::string> const& setup)
    : options_{options}, socket_{options.port, options.via, options.path} {
    if (options.connect) session_ = session_of(ask(connect));
    for (std::size_t i = 0; i < options.repeat; ++i) {
        for (auto const& document : setup) {
            auto const answer = ask(filled_in(document, number, number * options.repeat + i));
            if (answer.find("\"OK\"") == answer.npos)
                throw std::runtime_error("a document of --setup was not answered with OK: " + answer);
        }
    }
}

std::string Application::carried(std::string_view document) const {
    return options_.via == Via::websocket ? text_frame(document) : http_post(options_.path, session_, document);
}

std::string Application::ask(std::string_view document) {
    socket_.send(carried(document));
    while (true) {
        auto const message = socket_.wait();
        if (!is_notification(message.body)) return std::string{message.body};
    }
}

void Application::open_stream() {
    socket_.send(http_get(options_.path + "/notifications", session_, "text/event-stream"));
    socket_.drain();
}

void disconnect(Options const& options, std::span<Application const> applications) {
    if (!options.connect) return;
    Socket socket{options.port, Via::http, options.path};
    for (auto const& application : applications) {
        socket.send(http_post(options.path, application.session(), leave));
        socket.wait();
    }
}

std::vector<Application> make_applications(Options const& options) {
    std::vector<Application> all;
    all.reserve(options.connections);
    for (std::size_t i = 0; i < options.connections; ++i) all.emplace_back(options, i, options.setup);
    return all;
}

void announce(Options const& options) {
    if (!options.announce) return;
    std::puts("{}");
    std::fflush(stdout);
}

}  // namespace rois::bench
