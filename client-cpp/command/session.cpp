#include "command/session.hpp"

namespace rois::command {

std::variant<Reply, Fault> Session::request(Operation operation) {
    auto answered = answer(Request{std::move(operation), {}});
    if (auto* const reply = std::get_if<Reply>(&answered)) return std::move(*reply);
    if (auto* const fault = std::get_if<Fault>(&answered)) return std::move(*fault);
    if (interrupted()) throw Trouble{Exit::interrupted, ""};
    throw Trouble{Exit::no_answer, std::get<NoAnswer>(answered).reason};
}

void Session::interrupt() {
    interrupted_ = true;
    end_waiting();
}

std::unique_ptr<Session> open_session(Options const& options, std::shared_ptr<RecordingWriter> recorded) {
    return options.session.empty() ? own_session(options, std::move(recorded)) : joined_session(options);
}

Settings settings_of(Options const& options) {
    Settings settings;
    settings.url = options.url;
    settings.way = options.over_http ? Way::http : Way::websocket;
    settings.token = options.token;
    settings.ca_file = options.ca_file;
    settings.deadline = options.deadline;
    settings.connect_deadline = options.deadline;
    return settings;
}

}  // namespace rois::command
