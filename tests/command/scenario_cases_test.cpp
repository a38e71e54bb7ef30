// The cases of tests/scenarios, which also run in the console. The README.md there describes their format.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <future>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "command/recording/front.hpp"
#include "command/rois_process.hpp"
#include "command/scenario/scenario_file.hpp"
#include "command/sequences.hpp"
#include "files/files.hpp"
#include "types/text/listing.hpp"
#include "xml/codec/codec.hpp"
#include "xml/profiles/document.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::test {
namespace {

using json = nlohmann::ordered_json;  // results keep their order
namespace asio = boost::asio;

constexpr auto folder = ROIS_SOURCE_DIR "/tests/scenarios/";

std::string read_case_file(std::string const& name) {
    std::ifstream const file{folder + name};
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

std::string replaced(std::string text, std::string const& what, std::string const& by) {
    auto const at = text.find(what);
    return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

// Calls `run` with each case of a file and its document.
template <class Run>
void for_each_case(std::string const& file, Run const& run) {
    auto const all = json::parse(read_case_file(file));
    for (auto const& one : all["cases"]) {
        SCOPED_TRACE(one["name"].get<std::string>());
        run(one,
            one.contains("document") ? one["document"].get<std::string>() : replaced(all["document"], "{states}", one["states"]));
    }
}

std::shared_ptr<xml::Schemas const> schemas() {
    static xml::Platform const platform;
    static auto const loaded = std::make_shared<xml::Schemas const>(files::schemas());
    return loaded;
}

// "move.start(line=1 2)+500"
std::string written(CommandMessage const& message, std::optional<std::int64_t> delay) {
    auto const argument = [](Parameter const& one) {
        std::string text = one.name + "=";
        for (auto const& value : one.values) text += (&value == &one.values.front() ? "" : "|") + value;
        return text;
    };
    return message.component_ref.code + "." + message.command_type + "(" + listed(message.arguments, argument) + ")" +
           (delay ? "+" + std::to_string(*delay) : "");
}

Results results_of(json const& step) {
    Results results;
    if (step.contains("results"))
        for (auto const& [name, values] : step["results"].items())
            results.parameters.push_back({name, {"string[]", {}, {}, {}}, values.get<std::vector<std::string>>()});
    return results;
}

// What one run of a case shares between the engine's thread and the test.
struct Script {
    json steps;
    std::promise<void> stop;  // set at the step `stop`
    std::vector<std::string> problems;
    std::set<std::string> subscribed;
    std::vector<std::string> bound;  // components or their types, each with its `switching`
};

// Plays the script of a case to one session. The session after `{"session": "ends"}` has nothing left to play.
class Engine : public command::Guest {
public:
    Engine(command::Host& host, command::HostedSession& session, Script& script)
        : host_{host}, session_{session}, script_{script}, timer_{host.io()} {}

    void take(std::string const& document, std::variant<Request, Fault> const& read,
              std::function<void(std::string)> reply) override {
        auto const* const request = std::get_if<Request>(&read);
        if (request == nullptr) return reply(xml::encode(std::get<Fault>(read)));
        if (std::holds_alternative<GetProfile>(request->operation)) {
            auto const id = request->request_id.empty() ? "" : " request_id=\"" + request->request_id + "\"";
            return reply(replaced(read_case_file("engine.xml"), " return_code=\"OK\"", " return_code=\"OK\"" + id));
        }
        document_ = document;
        auto const answer = std::visit([&](auto const& operation) { return Reply{answer_to(operation)}; }, request->operation);
        reply(xml::encode(answer, request->request_id));
    }

private:
    template <class Op>
    typename Op::Reply answer_to(Op const&) {
        return {};
    }

    Bind::Reply answer_to(Bind const& bind) {
        note_bound(bind.component_ref.code, bind.switching);
        return {};
    }

    BindAny::Reply answer_to(BindAny const& bind) {
        note_bound("SpeechSynthesis", bind.switching);
        BindAny::Reply reply;
        reply.component_ref.code = "speech";
        return reply;
    }

    void note_bound(std::string const& component, Switching switching) {
        script_.bound.push_back(component + " " + std::string{to_text(switching)});
    }

    Subscribe::Reply answer_to(Subscribe const& subscribe) {
        if (!script_.subscribed.insert(subscribe.event_type).second)
            script_.problems.push_back("subscribes twice to " + subscribe.event_type);
        Subscribe::Reply reply;
        reply.subscribe_id.text = "s-" + subscribe.event_type;
        return reply;
    }

    Execute::Reply answer_to(Execute const& execute) {
        std::vector<std::string> commands;
        for (auto const& unit : execute.command_unit_list.command_unit_list) {
            auto const& message = std::get<CommandMessage>(unit.unit);
            commands.push_back(written(message, unit.delay_time));
            commands_.push_back(message.command_id);
        }
        Execute::Reply reply;
        reply.command_unit_list = execute.command_unit_list;
        refuse_or_go_on(reply, expected({{"execute", commands}}));
        return reply;
    }

    Query::Reply answer_to(Query const& query) {
        json received{{"query", query.query_type}};
        auto const step = expected(received);
        if (step.contains("component") && document_.find(">" + step["component"].get<std::string>() + "<") == std::string::npos)
            script_.problems.push_back("the query is for another component: " + document_);
        Query::Reply reply;
        reply.component_ref.code = "system";
        reply.results = results_of(step);
        refuse_or_go_on(reply, step);
        return reply;
    }

    // Returns the step that expects this request.
    json expected(json const& received) {
        auto const step = next_ < script_.steps.size() ? script_.steps[next_++] : json::object();
        for (auto const& [name, value] : received.items())
            if (step.value(name, json{}) != value)
                script_.problems.push_back("received " + received.dump() + " instead of " + step.dump());
        return step;
    }

    template <class Reply>
    void refuse_or_go_on(Reply& reply, json const& step) {
        if (step.contains("refused")) {
            reply.return_code = ReturnCode::error;
            reply.reason = step["refused"];
        }
        asio::post(host_.io(), later());  // after the answer
    }

    // Plays, unless this engine has been deleted by then.
    std::function<void()> later() {
        return [this, alive = std::weak_ptr{alive_}] {
            if (alive.lock()) play();
        };
    }

    // Plays the steps up to the next request.
    void play() {
        while (next_ < script_.steps.size()) {
            auto const& step = script_.steps[next_];
            if (step.contains("execute") || step.contains("query")) return;
            ++next_;
            if (step.contains("wait")) {
                timer_.expires_after(std::chrono::milliseconds{static_cast<int>(step["wait"].get<double>() * 1000)});
                timer_.async_wait([next = later()](auto failure) {
                    if (!failure) next();
                });
                return;
            }
            if (step.contains("stop")) script_.stop.set_value();
            if (step.contains("session")) return end_session();
            notify(step);
        }
    }

    // Closes the WebSocket, too, so that the client notices. Deletes this engine.
    void end_session() {
        session_.websocket = 0;
        host_.end(session_);
    }

    void notify(json const& step) {
        if (step.contains("event")) {
            std::string const type = step["event"];
            session_.notify(ReceiveEvent{{"e"},
                                         type,
                                         {step.value("subscription", "s-" + type)},
                                         std::chrono::system_clock::now() + std::chrono::minutes{1},
                                         {step["component"], {}, {}, {}},
                                         std::make_shared<Results const>(results_of(step))});
        }
        if (step.contains("completed")) {
            using enum CompletedStatus;
            for (auto const status : {ok, error, abort, out_of_resources, timeout})
                if (to_text(status) == step["completed"].get<std::string>())
                    session_.notify(Completed{commands_.at(step["command"].get<std::size_t>()), status});
        }
        if (step.contains("error"))
            session_.notify(ReceiveError{{"1"}, ErrorType::component_internal_error, Identifier{step["error"], {}, {}, {}}});
    }

    command::Host& host_;
    command::HostedSession& session_;
    Script& script_;
    asio::steady_timer timer_;
    std::shared_ptr<int> const alive_ = std::make_shared<int>();
    std::string document_;
    std::vector<CommandId> commands_;
    std::size_t next_ = 0;
};

constexpr std::string_view error_prefix = "error: ";

// The outcome of `rois scenario --json`.
struct RunOutcome {
    std::vector<std::string> history;
    std::string end;  // "ended", "failed", "stopped", or "error: " and the text on standard error or of a refusal
};

RunOutcome outcome_of(Ended const& ended) {
    RunOutcome outcome;
    auto error = ended.error;
    for (auto const& text : lines_of(ended.out)) {
        auto const line = json::parse(text);
        if (line.contains("print")) {
            outcome.history.push_back(line["print"]);
        } else if (line.contains("from")) {
            outcome.history.push_back(line["from"].get<std::string>() + " -> " + line["to"].get<std::string>() + "  " +
                                      line["by"].get<std::string>());
        } else {
            error += text;
        }
    }
    if (ended.exit_code == 0) {
        outcome.end = "ended";
    } else if (ended.exit_code == 130) {
        outcome.end = "stopped";
    } else {
        outcome.end = error.empty() ? "failed" : std::string{error_prefix} + error;
    }
    return outcome;
}

TEST(ScenarioCases, EachRunHasItsHistory) {
    for_each_case("runs.json", [](json const& one, std::string const& document) {
        Script script;
        script.steps = one["script"];
        asio::io_context io{1};
        bool played = false;  // by the first session
        command::Host host{io, [&](command::HostedSession& session, Connect const&) {
                               if (std::exchange(played, true)) script.steps = json::array();
                               script.subscribed.clear();  // the client subscribes again in a new session
                               return std::make_unique<Engine>(host, session, script);
                           }};
        command::Front front{host, schemas(), "127.0.0.1:0"};
        std::thread serving{[&] { front.run(); }};
        auto const needs_stop = one["script"].dump().find("\"stop\"") != std::string::npos;
        auto stop = script.stop.get_future();
        RoisProcess process{{"scenario", file_with("case.xml", document), "--json"}, {{"ROIS_URL", front.url()}}};
        if (needs_stop) {
            EXPECT_EQ(stop.wait_for(std::chrono::seconds{60}), std::future_status::ready);
            process.signal(SIGINT);
        }
        auto const outcome = outcome_of(process.wait());
        front.stop();
        serving.join();
        EXPECT_THAT(outcome.history, testing::ElementsAreArray(one["history"].get<std::vector<std::string>>())) << outcome.end;
        std::string const end = one["end"];
        if (end.starts_with(error_prefix)) {
            EXPECT_THAT(outcome.end, testing::StartsWith(error_prefix));
            EXPECT_THAT(outcome.end, testing::HasSubstr(end.substr(error_prefix.size())));
        } else {
            EXPECT_EQ(outcome.end, end);
        }
        EXPECT_THAT(script.problems, testing::IsEmpty());
        if (one.contains("subscribed")) {
            EXPECT_EQ(json(script.subscribed), one["subscribed"]);
        }
        if (one.contains("bound")) {
            EXPECT_EQ(json(script.bound), one["bound"]);
        }
    });
}

TEST(ScenarioCases, EachWrongDocumentIsExplained) {
    for_each_case("documents.json", [](json const& one, std::string const& document) {
        try {
            command::read_robot_scenario(schemas(), "case.xml", document);
            ADD_FAILURE() << "accepted";
        } catch (xml::BadDocument const& bad) {
            EXPECT_THAT(bad.what(), testing::StartsWith("case.xml:" + one["problem"].get<std::string>()));
        }
    });
}

}  // namespace
}  // namespace rois::test
