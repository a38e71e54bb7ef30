#include <algorithm>
#include <deque>
#include <pugixml.hpp>
#include <sstream>

#include "command/http.hpp"
#include "command/session.hpp"
#include "xml/codec.hpp"

namespace rois::command {

namespace {

constexpr auto longest_poll = std::chrono::seconds{10};
constexpr auto poll_takes = std::chrono::seconds{10};  // beyond what it waits

class JoinedSession : public Session {
public:
    explicit JoinedSession(Options const& options)
        : server_{options.url, options.token, options.ca_file}, id_{options.session}, deadline_{options.deadline} {}

    bool is_joined() const override { return true; }
    SessionId id() const override { return id_; }

    std::string send(std::string const& document) override { return ask(server_, {"/rois", document, id_.text}, deadline_).body; }

    std::optional<Heard> hear(Until until) override {
        while (waiting_.empty() && !interrupted()) {
            auto const left =
                until ? std::chrono::ceil<std::chrono::seconds>(*until - std::chrono::steady_clock::now()) : longest_poll;
            if (left.count() <= 0) return std::nullopt;
            poll(std::min<std::chrono::seconds>(left, longest_poll));
        }
        if (waiting_.empty()) return std::nullopt;
        auto first = std::move(waiting_.front());
        waiting_.pop_front();
        return first;
    }

protected:
    Answer answer(Request request) override {
        auto read = reader_.read(send(xml::encode(request)));
        if (read && std::holds_alternative<xml::Answered>(*read)) return std::move(std::get<xml::Answered>(*read).reply);
        if (read && std::holds_alternative<Fault>(*read)) return std::move(std::get<Fault>(*read));
        return NoAnswer{NoAnswer::Why::not_understood, "the answer is no document of RoIS"};
    }

    // Nothing waits for long, and nothing has to be told: the session goes on.
    void end_waiting() override {}

private:
    void poll(std::chrono::seconds wait) {
        auto const target = "/rois/notifications?after=" + std::to_string(after_) + "&wait=" + std::to_string(wait.count());
        auto const answer = ask(server_, {target, {}, id_.text}, wait + poll_takes);
        if (auto read = reader_.read(answer.body); read && std::holds_alternative<Fault>(*read))
            throw Trouble{Exit::fault, std::string{to_text(std::get<Fault>(*read).code)} + ": " + std::get<Fault>(*read).reason};
        pugi::xml_document document;
        document.load_buffer(answer.body.data(), answer.body.size(), pugi::parse_default | pugi::parse_ws_pcdata_single);
        for (auto const element : document.document_element().children()) {
            std::ostringstream text;
            element.print(text, "", pugi::format_raw, pugi::encoding_utf8);
            auto read = reader_.read(text.str());
            if (!read || !std::holds_alternative<xml::Told>(*read)) continue;
            auto& told = std::get<xml::Told>(*read);
            after_ = std::max(after_, told.sequence);
            waiting_.push_back(News{std::move(told.notification), told.sequence});
        }
    }

    HttpServer server_;
    SessionId id_;
    std::chrono::milliseconds deadline_;
    xml::AnswerReader reader_;
    std::uint64_t after_ = 0;
    std::deque<Heard> waiting_;
};

}  // namespace

std::unique_ptr<Session> joined_session(Options const& options) { return std::make_unique<JoinedSession>(options); }

}  // namespace rois::command
