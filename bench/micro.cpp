// rois-micro FOLDER [--benchmark_...]: the cost of each step of a request by itself (ARCHITECTURE.md lists the steps), for those
// documents of the folder whose names end with their size, and the cost of the engine.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <pugixml.hpp>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "engine/commands/motion_lease.hpp"
#include "engine/conditions/filter.hpp"
#include "engine/engine.hpp"
#include "files/files.hpp"
#include "gateway/process/memory.hpp"
#include "net/http/routes.hpp"
#include "probe.hpp"
#include "types/identifier_length.hpp"
#include "xml/codec/codec.hpp"
#include "xml/codec/decoding.hpp"
#include "xml/tables/acceptor.hpp"
#include "xml/validation/schemas.hpp"
#include "xml/validation/validator.hpp"

namespace rois::bench {

namespace {

using Documents = std::map<std::string, std::string>;

Documents read_documents(std::filesystem::path const& folder) {
    Documents documents;
    for (auto const& entry : std::filesystem::directory_iterator{folder}) {
        if (entry.path().extension() != ".xml") continue;
        std::ifstream in{entry.path(), std::ios::binary};
        documents[entry.path().stem().string()] = {std::istreambuf_iterator<char>{in}, {}};
    }
    return documents;
}

// A document's tree, by pugixml.
xml::MessageTree tree_of(pugi::xml_document& parsed, std::string const& document) {
    parsed.load_string(document.c_str());
    xml::MessageTree tree;
    tree.read(parsed.document_element());
    return tree;
}

Request request_of(std::string const& document) {
    pugi::xml_document parsed;
    return xml::decode(tree_of(parsed, document)).value();
}

void count_bytes(benchmark::State& state, std::string const& document) {
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * document.size()));
}

// --- From text to an operation ---

void validate_with_xerces(benchmark::State& state, std::shared_ptr<xml::Schemas const> const& schemas,
                          std::string const& document) {
    xml::Validator validator{schemas};
    for (auto _ : state) {
        if (validator.objection_to(document)) state.SkipWithError("not valid");
    }
    count_bytes(state, document);
}

// Validation with the tables made from the schemas.
void validate(benchmark::State& state, std::shared_ptr<xml::Schemas const> const& schemas, std::string const& document) {
    xml::Acceptor acceptor{schemas, {}};
    for (auto _ : state) {
        if (!acceptor.accepts(document)) state.SkipWithError("left to xerces-c");
    }
    count_bytes(state, document);
}

// Validation and decoding, as in the gateway.
void read(benchmark::State& state, std::shared_ptr<xml::Schemas const> const& schemas, std::string const& document) {
    xml::RequestReader reader{schemas};
    for (auto _ : state) {
        auto const read = reader.read(document);
        if (std::holds_alternative<Fault>(read)) state.SkipWithError("the document was rejected");
    }
    count_bytes(state, document);
}

void parse(benchmark::State& state, std::string const& document) {
    for (auto _ : state) {
        pugi::xml_document tree;
        benchmark::DoNotOptimize(tree.load_buffer(document.data(), document.size()));
    }
    count_bytes(state, document);
}

void decode(benchmark::State& state, std::string const& document) {
    pugi::xml_document parsed;
    auto const tree = tree_of(parsed, document);
    for (auto _ : state) benchmark::DoNotOptimize(xml::decode(tree));
    count_bytes(state, document);
}

// --- The engine ---

class Nobody final : public Outbox {
    void notify(NotificationQueue&) override {}
};

class Question final : public Asked {
public:
    Question(std::shared_ptr<NotificationQueue> from, Operation const& operation)
        : Asked{std::move(from), 0}, operation_{operation} {}
    Operation const& operation() const override { return operation_; }
    void answer(Reply&& given) override { reply = std::move(given); }
    void refuse(Refusal) override {}

    std::optional<Reply> reply;

private:
    Operation const& operation_;
};

// An engine with probes, and one session that has bound the first of them.
class World {
public:
    explicit World(int probes)
        : engine_{{}, known_profiles(), settings(), nobody_, [this] { return "s" + std::to_string(++last_); }} {
        auto const profile = std::make_shared<ComponentProfile const>(probe_profile());
        for (int i = 0; i < probes; ++i) engine_.add(probe("probe" + std::to_string(i), profile));
        session = connect();
        ask<Bind>(session, Bind{{.code = "probe0", .authority = {}, .codebook_ref = {}, .version = {}}});
    }

    SessionId connect() { return ask<Connect>({}, Connect{}).session; }

    template <class Known>
    typename Known::Reply ask(SessionId const& asker, Operation const& operation) {
        now_.steady += std::chrono::microseconds{10};
        auto const question = std::make_shared<Question>(engine_.notifications(asker), operation);
        std::unique_lock lock{mutex_};
        engine_.handle(question, now_);
        engine_.work(lock, now_);
        if (!question->reply) throw std::runtime_error("refused");
        auto said = std::get<typename Known::Reply>(std::move(*question->reply));
        if (said.return_code != ReturnCode::ok) throw std::runtime_error(said.reason);
        return said;
    }

    // Takes the notifications, as a connection does.
    std::size_t take(SessionId const& asker, std::uint64_t& after) {
        auto const taken = engine_.notifications(asker)->read(after, 1'000);
        if (!taken.empty()) after = taken.back().sequence;
        return taken.size();
    }

    SessionId session;

private:
    static EngineSettings settings() {
        EngineSettings settings;
        settings.max_sessions = 100'000;
        return settings;
    }

    int last_ = 0;
    Nobody nobody_;
    Instant now_{};
    std::mutex mutex_;
    Engine engine_;
};

template <class Known>
void handle(benchmark::State& state, std::string const& document) {
    World world{static_cast<int>(state.range(0))};
    auto const operation = request_of(document).operation;
    std::uint64_t last_sequence = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(world.ask<Known>(world.session, operation));
        world.take(world.session, last_sequence);
    }
}

// An event to many sessions; each session takes it.
void fire(benchmark::State& state, std::string const& subscribe, std::string const& fire) {
    World world{10};
    auto const subscription = request_of(subscribe).operation;
    auto const firing = request_of(fire).operation;
    std::vector<std::pair<SessionId, std::uint64_t>> subscribers(static_cast<std::size_t>(state.range(0)));
    for (auto& [session, last_sequence] : subscribers) {
        session = world.connect();
        world.ask<Subscribe>(session, subscription);
    }
    std::uint64_t last_of_firing = 0;
    std::string text;
    for (auto _ : state) {
        world.ask<Execute>(world.session, firing);
        for (auto& [session, last_sequence] : subscribers) benchmark::DoNotOptimize(world.take(session, last_sequence));
        world.take(world.session, last_of_firing);
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * subscribers.size()));
}

// --- The protections (docs/safety.md) ---

// All checks of a query over HTTP that protect the robot and the gateway: Host, Origin and the rest of its head, the memory
// budget, the motion lease, the lengths of identifiers.
void protect(benchmark::State& state, std::string const& document) {
    net::Settings const settings;
    auto const text =
        "POST /rois HTTP/1.1\r\nHost: 127.0.0.1:8080\r\nRoIS-Session: df-04lB8n-u74iFBlfFjzY0QmzyrnfnR\r\n"
        "Content-Type: application/xml\r\nContent-Length: " +
        std::to_string(document.size()) + "\r\n\r\n";
    net::RequestHead head;
    if (net::read_head(text, settings, head)) throw std::runtime_error("the head was rejected");
    auto const route = net::route_of(head.path);
    auto const operation = request_of(document).operation;
    MemoryBudget memory{settings.memory_budget, resident_bytes};
    MotionLease lease{{.linked = std::chrono::seconds{2}, .http = std::chrono::seconds{10}}, {}};
    Steady now{};
    for (auto _ : state) {
        if (net::refusal(head, route, settings)) state.SkipWithError("refused");
        if (document.size() > memory.longest_document() || memory.full()) state.SkipWithError("no memory");
        memory.took(document.size());
        lease.request_received(now += std::chrono::microseconds{10});
        if (lease.end() <= now || why_too_long(operation)) state.SkipWithError("refused");
    }
}

// --- Conditions ---

// The condition of a subscription, and an event that matches it.
struct Conditioned {
    explicit Conditioned(std::string const& subscribe)
        : condition{std::get<Subscribe>(request_of(subscribe).operation).condition} {
        declared.add(find_message(probe_profile(), MessageKind::event, "probed")->results);
        results.parameters = {text("stamp", "t1"), integer("value", 42)};
    }
    Filter compile() const {
        auto made = Filter::compile(condition, {.places = &places, .parameters = nullptr, .results = &declared});
        if (auto const* problem = std::get_if<std::string>(&made)) throw std::runtime_error(*problem);
        return std::get<Filter>(std::move(made));
    }

    Places places;
    Declarations declared;
    QueryExpression condition;
    Results results;
};

void compile_filter(benchmark::State& state, std::string const& document) {
    Conditioned const conditioned{document};
    for (auto _ : state) benchmark::DoNotOptimize(conditioned.compile());
}

void match_filter(benchmark::State& state, std::string const& document) {
    Conditioned const conditioned{document};
    auto const filter = conditioned.compile();
    ResultsCandidate const candidate{conditioned.results, "e-1"};
    for (auto _ : state) {
        if (filter.match(candidate) != Match::yes) state.SkipWithError("no match");
    }
}

// --- From answers and notifications to text ---

void encode_answer(benchmark::State& state) {
    Query::Reply reply;
    reply.component_ref.code = "probe0";
    reply.results.parameters = {integer("value", 42), text("label", "in the hall, between the desk and the door to the garden")};
    Reply const whole{reply};
    for (auto _ : state) benchmark::DoNotOptimize(xml::encode(whole, "1"));
}

ReceiveEvent event() {
    ReceiveEvent event{{"e-1"}, "probed", {"s-1"}, {}, {.code = "probe0", .authority = {}, .codebook_ref = {}, .version = {}},
                       {}};
    event.results = std::make_shared<Results const>(Results{{text("stamp", "t1"), integer("value", 42)}, {}});
    return event;
}

void encode_notification(benchmark::State& state) {
    Notification const notification{event()};
    for (auto _ : state) benchmark::DoNotOptimize(xml::notification_tail(notification));
}

void register_all(Documents const& documents) {
    auto const schemas = std::make_shared<xml::Schemas const>(files::schemas());
    for (auto const& [name, document] : documents) {
        if (!name.ends_with("kB")) continue;
        auto const with_schemas = [&](std::string const& what, auto station) {
            benchmark::RegisterBenchmark((what + "/" + name).c_str(),
                                         [=](benchmark::State& s) { station(s, schemas, document); });
        };
        auto const with_document = [&](std::string const& what, auto station) {
            benchmark::RegisterBenchmark((what + "/" + name).c_str(), [=](benchmark::State& s) { station(s, document); });
        };
        with_schemas("xerces", validate_with_xerces);
        with_schemas("validate", validate);  // bench/report.py compares them
        with_schemas("read", read);
        with_document("parse", parse);
        with_document("decode", decode);
    }
    auto const of = [&](std::string const& name) { return documents.at(name); };
    auto const engine = [&](char const* name, auto station, std::string const& document) {
        benchmark::RegisterBenchmark(name, [=](benchmark::State& s) { station(s, document); })->Arg(10)->Arg(10'000);
    };
    engine("engine_query", handle<Query>, of("reading-by-ref"));
    engine("engine_set_parameter", handle<SetParameter>, of("set_parameter"));
    engine("engine_execute", handle<Execute>, of("execute"));
    benchmark::RegisterBenchmark("protections", [query = of("query-0.6kB")](benchmark::State& s) { protect(s, query); });
    auto const subscription = of("subscribe");
    auto const firing = of("fire-1");
    benchmark::RegisterBenchmark("engine_event", [=](benchmark::State& s) { fire(s, subscription, firing); })->Arg(1)->Arg(1'000);
    auto const conditioned = of("subscribe-conditioned");
    benchmark::RegisterBenchmark("filter_compile", [=](benchmark::State& s) { compile_filter(s, conditioned); });
    benchmark::RegisterBenchmark("filter_match", [=](benchmark::State& s) { match_filter(s, conditioned); });
    benchmark::RegisterBenchmark("encode_answer", encode_answer);
    benchmark::RegisterBenchmark("encode_notification", encode_notification);
}

}  // namespace

}  // namespace rois::bench

int main(int argc, char** argv) {
    try {
        rois::xml::Platform const platform;
        benchmark::Initialize(&argc, argv);
        if (argc != 2) throw std::runtime_error("usage: rois-micro FOLDER [--benchmark_...]");
        rois::bench::register_all(rois::bench::read_documents(argv[1]));
        benchmark::RunSpecifiedBenchmarks();
        benchmark::ClearRegisteredBenchmarks();
        return 0;
    } catch (std::exception const& error) {
        std::fprintf(stderr, "rois-micro: %s\n", error.what());
        return 1;
    }
}
