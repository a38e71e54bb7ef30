#include "net/http/event_stream.hpp"

#include "net/loop.hpp"
#include "net/wake_up.hpp"
#include "types/text/texts.hpp"
#include "types/text/to_number.hpp"

namespace rois::net {

namespace {

constexpr std::size_t most_at_once = 64;    // notifications of one write
constexpr std::size_t most_a_poll = 1'024;  // and of one answer

Fault bad_number(std::string_view name, std::string_view value, std::string const& limit = {}) {
    return {FaultCode::not_well_formed, std::string{name} + " must be a whole number" + limit + ", not " + quoted(value)};
}

// Appends a server-sent event: its id is the sequence, its data the document line by line.
void append_event(std::string& out, Numbered const& numbered) {
    std::string document;
    NotificationDocument{numbered}.append_to(document);
    out.append("id: ").append(std::to_string(numbered.sequence)).append("\n");
    for (std::size_t begin = 0; begin <= document.size();) {
        auto const end = std::min(document.find_first_of("\r\n", begin), document.size());
        out.append("data: ").append(document, begin, end - begin).append("\n");
        begin = end + (document.compare(end, 2, "\r\n") == 0 ? 2 : 1);
    }
    out.append("\n");
}

}  // namespace

std::variant<NotificationsWanted, Fault> read_wanted(RequestHead const& head, std::chrono::milliseconds longest_wait) {
    NotificationsWanted wanted;
    if (head.lists("Accept", "text/event-stream")) {
        wanted.as = NotificationsWanted::As::stream;
        if (head.message.count("Last-Event-ID") == 0) return wanted;
        auto const text = head.field("Last-Event-ID").value_or("");
        auto const last = to_number<std::uint64_t>(text);
        if (!last) return bad_number("Last-Event-ID", text);
        wanted.after = *last;
        return wanted;
    }
    if (auto const after = head.parameter("after")) {
        auto const number = to_number<std::uint64_t>(*after);
        if (!number) return bad_number("after", *after);
        wanted.after = *number;
    }
    if (auto const wait = head.parameter("wait")) {
        auto const number = to_number<std::uint64_t>(*wait);
        auto const most = static_cast<std::uint64_t>(std::chrono::floor<std::chrono::seconds>(longest_wait).count());
        if (!number || *number > most)
            return bad_number("wait", *wait, " of seconds, " + std::to_string(most) + " at most (max_poll_wait)");
        wanted.wait = std::chrono::seconds{*number};
    }
    return wanted;
}

Task<HttpAnswer> poll(Wire& wire, Loop& loop, SessionId const& session, Rights const* rights, NotificationsWanted const& wanted) {
    auto const until = std::chrono::steady_clock::now() + wanted.wait;
    auto const wake_up = std::make_shared<WakeUp>(wire.executor(), loop.wakes());
    auto read = loop.shared().gateway.read(session, rights, LinkKind::stream, wanted.after, *wake_up, Readers::Until::answered);
    if (auto const* fault = std::get_if<Fault>(&read)) co_return answer_of(*fault);
    auto const reading = std::get<std::unique_ptr<Reading>>(std::move(read));
    auto taken = reading->take(most_a_poll);
    auto const watch =
        wire.watch([wake_up] { wake_up->raise(); }, [&reading](Steady now) { return reading->wants_signs_of_life(now); });
    while (taken.notifications.empty() && taken.then == Reading::Then::wait && wanted.wait.count() > 0 && !watch.gone()) {
        auto const woken = co_await wake_up->wait_until(until);
        if (woken == WakeUp::Woken::time_passed) break;
        taken = reading->take(most_a_poll);
    }
    std::string document{xml::notifications_begin()};
    for (auto const& numbered : taken.notifications) NotificationDocument{numbered}.append_to(document);
    document.append(xml::notifications_end());
    loop.shared().telemetry.delivered(taken.notifications.size());
    if (!watch.gone()) reading->answered();
    co_return HttpAnswer{.body = std::move(document)};
}

Task<std::optional<HttpAnswer>> stream(Wire& wire, Loop& loop, SessionId const& session, Rights const* rights,
                                       NotificationsWanted const& wanted) {
    auto const& shared = loop.shared();
    auto const wake_up = std::make_shared<WakeUp>(wire.executor(), loop.wakes());
    auto read = shared.gateway.read(session, rights, LinkKind::stream, wanted.after, *wake_up);
    if (auto const* fault = std::get_if<Fault>(&read)) co_return answer_of(*fault);
    auto const reading = std::get<std::unique_ptr<Reading>>(std::move(read));
    std::string out;
    append(out, HttpAnswer{.content_type = "text/event-stream"}, {Framing::Body::endless, true});
    auto const watch =
        wire.watch([wake_up] { wake_up->raise(); }, [&reading](Steady now) { return reading->wants_signs_of_life(now); });
    while (!watch.gone()) {
        auto const taken = reading->take(most_at_once);
        for (auto const& numbered : taken.notifications) append_event(out, numbered);
        out.erase(0, wire.send_now(out));
        if (!out.empty()) shared.gateway.memory().took(out.size());
        if (!out.empty() && shared.gateway.memory().full() && !wire.is_secure()) break;
        auto const sent = co_await wire.send(out);
        if (sent != Wire::Outcome::done) break;
        std::string{}.swap(out);
        shared.telemetry.delivered(taken.notifications.size());
        if (taken.then == Reading::Then::more) continue;
        if (taken.then != Reading::Then::wait) break;
        auto const next_sign_of_life = std::chrono::steady_clock::now() + shared.settings().ping_interval;
        auto const woken = co_await wake_up->wait_until(next_sign_of_life);
        if (woken == WakeUp::Woken::time_passed) out = ":\n\n";
    }
    co_return std::nullopt;
}

Task<> wait_for_other_readers(Gateway& gateway, SessionId const& session, Executor const& executor, Wakes& wakes) {
    auto const until = std::chrono::steady_clock::now() + std::chrono::seconds{1};
    auto const wake_up = std::make_shared<WakeUp>(executor, wakes);
    Farewell const farewell{gateway, session, *wake_up};
    while (!farewell.alone()) {
        auto const woken = co_await wake_up->wait_until(until);
        if (woken == WakeUp::Woken::time_passed) break;
    }
}

}  // namespace rois::net
